"""The errors of the planned and the extended model."""

from __future__ import annotations

from rths_engine.diagnosis.schema.form import NUMBERS, Form, field


class Errors(Form):
    """Errors of one model of the worst component, over the RMS of the recorded signal about its mean."""

    fit_nrmse: float | None = field("RMS error on fitted data; null where the simulation diverges", NUMBERS)
    heldout_nrmse: float | None = field("RMS error on held-out data; null where the simulation diverges", NUMBERS)


class Fit(Form):
    """Errors of the planned and the extended model of the worst component, and the noise floor."""

    baseline: Errors = field("Errors of the planned model; its parameters are refitted within their tolerances")
    extended: Errors = field("Errors of the extended model; equal to the baseline where no effect was added")
    noise_floor_nrmse: float | None = field("Noise floor: the error that the measurement noise alone leaves", NUMBERS)
