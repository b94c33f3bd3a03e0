"""What a diagnosis says of each component, and where the worst of them differs from its recording."""

from __future__ import annotations

from typing import Literal

from rths_engine.diagnosis.schema.form import NUMBERS, Form, field

Kind = Literal["consistent", "recalibrate", "undetermined", "mismatch", "configuration_error"]


class ComponentVerdict(Form):
    """One component, simulated alone on the signals recorded at its ends."""

    component: str = field("Component by kind and number, such as specimen:1")
    residual_nrmse: float | None = field(
        "RMS error of the component as planned over the RMS of the recorded signal about its mean; "
        "null where the simulation runs away",
        NUMBERS,
    )
    noise_nrmse: float | None = field(
        "RMS of the measurement noise over the same RMS; null for a computed part, which has no noise", NUMBERS
    )
    p_value: float | None = field(
        "Probability of a residual as large as this where nothing was left out, 0 where it is below 1e-307; "
        "null for a computed part, which must replay to rounding and is not tested",
        NUMBERS,
        ge=0,
        le=1,
    )
    mismatch: bool = field(
        "True where the p-value is at or below the component's share of the false-alarm rate, "
        "or where a computed part does not replay to rounding"
    )
    verdict: Kind = field("Verdict on this component")


class Where(Form):
    """Where the residual of the planned model exceeds the noise."""

    component: str = field("Place of the first named effect, such as specimen:1 or sensor:x_meas.1, else the worst component")
    times_s: tuple[tuple[float, float], ...] = field(
        "Time spans, each [begin, end], in which the residual exceeds three standard deviations of the noise", "s"
    )
    bands_hz: tuple[tuple[float, float], ...] = field(
        "Frequency bands, each [low, high], that hold the middle 90 % of the power of the residual", "Hz"
    )
    state: str = field("Region of displacement and velocity in which the residual is largest, in words; may be empty")
