"""How well the models fit, and what they leave unexplained."""

from __future__ import annotations

from rths_engine.diagnosis.schema.form import NUMBERS, Form, field


class Errors(Form):
    """Errors of one model of the worst component, over the RMS of the recorded signal about its mean."""

    fit_nrmse: float | None = field("RMS error on the data that were fitted; null where the simulation runs away", NUMBERS)
    heldout_nrmse: float | None = field("RMS error on data that were never fitted; null likewise", NUMBERS)


class Fit(Form):
    """The planned and the extended model of the worst component."""

    baseline: Errors = field("The planned model, its own numbers refitted within their tolerances")
    extended: Errors = field("The model with the effects; equal to the baseline where no effect was added")
    noise_floor_nrmse: float | None = field("The error that the measurement noise alone leaves", NUMBERS)


class Unexplained(Form):
    """What the extended model leaves beyond the noise."""

    fraction: float | None = field(
        "RMS of the residual beyond the noise over the RMS of the recorded signal about its mean; null where it is not finite",
        NUMBERS,
    )
    formula: str | None = field(
        "Law of what remains; null where none was fitted. Coefficients in the SI unit of the compared signal, of a structure "
        "in 1 % of the storey's largest elastic force; x, v, a and f over their largest values; E and t are the shares of the "
        "dissipated energy and of the duration"
    )
    words: str = field("The same in words")
