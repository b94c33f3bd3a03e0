"""`rths-diagnosis-pictures/1`: what there is to plot of a diagnosis."""

from __future__ import annotations

from typing import Literal

from rths_engine.diagnosis.schema.components import Kind
from rths_engine.diagnosis.schema.form import AS_STATED, NUMBERS, Form, field

Numbers = tuple[float | None, ...]
MEANING = "; a sample that is not finite is null"


class Named(Form):
    """A signal's label and unit."""

    label: str = field("Label of the signal for people")
    unit: str = field("SI unit of the samples")
    shown: str = field("Unit for people")
    factor: float = field("SI value of one unit for people: samples = factor * samples for people", AS_STATED)


class OverTime(Form):
    """The residual of the planned model in successive windows."""

    time_s: Numbers = field("Middle of each window", "s")
    level: Numbers = field(
        "RMS residual over the standard deviation of the noise; null where the simulation runs away", NUMBERS
    )
    beyond: float = field("Level above which a window exceeds the noise", NUMBERS)


class Signals(Form):
    """Recorded and simulated signal; every bucket keeps its minimum and its maximum."""

    time_s: Numbers = field("Time", "s")
    measured: Numbers = field(f"Recorded signal{MEANING}", AS_STATED)
    before: Numbers = field("Simulation with the planned model, its numbers refitted", AS_STATED)
    after: Numbers = field("Simulation with the extended model", AS_STATED)


class Residuals(Form):
    """Recorded minus simulated signal, decimated likewise."""

    time_s: Numbers = field("Time", "s")
    before: Numbers = field("Residual of the planned model, its numbers refitted", AS_STATED)
    after: Numbers = field("Residual of the extended model", AS_STATED)


class Spectra(Form):
    """One-sided power spectral densities of the residuals by Welch's method, beside that of the noise."""

    frequency_hz: Numbers = field("Frequency", "Hz")
    before: Numbers = field("Residual of the planned model, its numbers refitted", "square of `unit` per Hz")
    after: Numbers = field("Residual of the extended model", "square of `unit` per Hz")
    noise: Numbers = field("Model of the noise", "square of `unit` per Hz")


class Channel(Named):
    """One recorded signal of a component."""

    signals: Signals = field("Recorded and simulated signal")
    residuals: Residuals = field("Residuals over time")
    spectra: Spectra = field("Residuals over frequency")


class Axis(Named):
    """Displacement or velocity of a component."""

    values: Numbers = field("Samples, every n-th", AS_STATED)


class State(Form):
    """Signal and residuals against displacement and velocity, every n-th sample."""

    axes: tuple[Axis, Axis] = field("Displacement and velocity")
    output: Named = field("The signal")
    measured: Numbers = field("Recorded signal", "stated in `output.unit`")
    before: Numbers = field("Simulation with the planned model, its numbers refitted", "stated in `output.unit`")
    after: Numbers = field("Simulation with the extended model", "stated in `output.unit`")
    residual_before: Numbers = field("Residual of the planned model, its numbers refitted", "stated in `output.unit`")
    residual_after: Numbers = field("Residual of the extended model", "stated in `output.unit`")


class HeldOut(Form):
    """Errors on a recording that was never fitted."""

    before: float | None = field("NRMSE of the planned model, its numbers refitted; null where it runs away", NUMBERS)
    after: float | None = field("NRMSE of the extended model; null likewise", NUMBERS)


class Block(Form):
    """Errors on one tenth of the recording, over the RMS of the whole about its mean."""

    from_s: float = field("Begin", "s")
    to_s: float = field("End", "s")
    held_out: bool = field("True where the block was never fitted")
    before: float | None = field(
        "NRMSE of the planned model, its numbers refitted; null where it runs away or the block is too short", NUMBERS
    )
    after: float | None = field("NRMSE of the extended model; null likewise", NUMBERS)


class Detail(Form):
    """One component in detail."""

    channels: tuple[Channel, ...] = field("Recorded signals of the component, at most four: those with the largest residual")
    state: State = field("The first of them against displacement and velocity")
    blocks: tuple[Block, ...] = field("Errors over ten successive blocks of the recording")
    held_out_recordings: tuple[HeldOut, ...] = field("Errors on each recording held out")
    noise_nrmse: float | None = field("RMS of the noise over the RMS of the recorded signal about its mean", NUMBERS)


class PicturedComponent(Form):
    """One component that was simulated alone."""

    component: str = field("Component by kind and number, such as specimen:1")
    title: str = field("Its name for people")
    output: str = field("The signal that is compared")
    verdict: Kind = field("Verdict on this component")
    mismatch: bool = field("True where the verdict is neither consistent nor recalibrate")
    over_time: OverTime = field("Residual of the planned model over time")
    detail: Detail | None = field("Signals, residuals and errors; null for a component that agrees and is not the worst")


class Pictures(Form):
    """Recording, simulation before and after, and residuals, as `rths-diagnosis-pictures/1`: decimated, six digits."""

    version: Literal["rths-diagnosis-pictures/1"] = field(
        "Name and version of this form", default="rths-diagnosis-pictures/1", alias="schema"
    )
    components: tuple[PicturedComponent, ...] = field("Every component that was simulated")
