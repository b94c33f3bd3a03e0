"""The errors of the planned and the extended model, and the unexplained residual."""

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


class Unexplained(Form):
    """The residual that the extended model leaves beyond the noise."""

    fraction: float | None = field(
        "RMS of the residual beyond the noise over the RMS of the recorded signal about its mean; null where it is not finite",
        NUMBERS,
    )
    formula: str | None = field(
        "Law of the unexplained residual; null where none was fitted. The coefficients are in the SI unit of the compared "
        "signal; for a structure, in 1 % of the storey's largest elastic force. x, v, a and f are divided by their largest "
        "values. E and t are the shares of the dissipated energy and of the duration"
    )
    words: str = field("The unexplained residual in words")
