"""The verdict on each component, and the location of the mismatch of the worst component."""

from __future__ import annotations

from typing import Literal

from rths_engine.diagnosis.schema.form import NUMBERS, Form, field

Kind = Literal["consistent", "recalibrate", "undetermined", "mismatch", "configuration_error"]


class ComponentVerdict(Form):
    """The verdict on one component, simulated alone with the recorded signals at its ends."""

    component: str = field("Kind and number of the component, such as specimen:1")
    residual_nrmse: float | None = field(
        "RMS error of the planned model over the RMS of the recorded signal about its mean; null where the simulation diverges",
        NUMBERS,
    )
    noise_nrmse: float | None = field(
        "RMS of the measurement noise over the RMS of the recorded signal about its mean; "
        "null for a computed part, which has no noise",
        NUMBERS,
    )
    p_value: float | None = field(
        "Probability of a residual at least this large if the model leaves nothing out; 0 where it is below 1e-307; "
        "null for a computed part, which is not tested because its replay must agree to rounding",
        NUMBERS,
        ge=0,
        le=1,
    )
    mismatch: bool = field(
        "True where the p-value is at most the component's share of the false-alarm rate, "
        "or where the replay of a computed part differs by more than rounding"
    )
    verdict: Kind = field("Verdict on the component")


class Where(Form):
    """Location of the residual of the planned model that exceeds the noise."""

    component: str = field(
        "Located component: the place of the first named effect, such as specimen:1 or sensor:x_meas.1; "
        "without a named effect, the worst component"
    )
    times_s: tuple[tuple[float, float], ...] = field(
        "Time spans, each [begin, end], in which the residual exceeds three standard deviations of the noise", "s"
    )
    bands_hz: tuple[tuple[float, float], ...] = field(
        "Frequency bands, each [low, high], that hold the middle 90 % of the power of the residual", "Hz"
    )
    state: str = field("Region of displacement and velocity where the residual is largest, in words; may be empty")
