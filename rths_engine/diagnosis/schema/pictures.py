"""`rths-diagnosis-pictures/1`: the data of the plots of a diagnosis."""

from __future__ import annotations

from typing import Literal

from rths_engine.diagnosis.schema.components import Kind
from rths_engine.diagnosis.schema.form import AS_STATED, NUMBERS, Form, field

Numbers = tuple[float | None, ...]
MEANING = "; a sample that is not finite is null"
BEFORE = "Residual of the planned model with refitted parameters"
SIMULATED = "Simulation by the planned model with refitted parameters"


class Named(Form):
    """Label and unit of a signal."""

    label: str = field("Label of the signal, as shown on pages")
    unit: str = field("SI unit of the samples")
    shown: str = field("Unit shown on pages")
    factor: float = field("SI value of one shown unit: sample = factor * shown sample", AS_STATED)


class OverTime(Form):
    """The residual of the planned model in successive windows."""

    time_s: Numbers = field("Middle of each window", "s")
    level: Numbers = field("RMS residual over the standard deviation of the noise; null where the simulation diverges", NUMBERS)
    beyond: float = field("Level above which a residual exceeds the noise", NUMBERS)


class Signals(Form):
    """Recorded and simulated signal, decimated: every bucket of samples keeps its minimum and its maximum."""

    time_s: Numbers = field("Time", "s")
    measured: Numbers = field(f"Recorded signal{MEANING}", AS_STATED)
    before: Numbers = field(SIMULATED, AS_STATED)
    after: Numbers = field("Simulation by the extended model", AS_STATED)


class Residuals(Form):
    """Recorded minus simulated signal, decimated in the same way as the signals."""

    time_s: Numbers = field("Time", "s")
    before: Numbers = field(BEFORE, AS_STATED)
    after: Numbers = field("Residual of the extended model", AS_STATED)


class Spectra(Form):
    """One-sided power spectral densities of the residuals by Welch's method, and the density of the noise."""

    frequency_hz: Numbers = field("Frequency", "Hz")
    before: Numbers = field(BEFORE, "square of `unit` per Hz")
    after: Numbers = field("Residual of the extended model", "square of `unit` per Hz")
    noise: Numbers = field("Model of the noise", "square of `unit` per Hz")


class Channel(Named):
    """One recorded signal of a component."""

    signals: Signals = field("Recorded and simulated signal")
    residuals: Residuals = field("Residuals over time")
    spectra: Spectra = field("Residuals over frequency")


class Axis(Named):
    """Displacement or velocity of a component."""

    values: Numbers = field("Every n-th sample", AS_STATED)


class State(Form):
    """Signal and residuals against displacement and velocity, every n-th sample."""

    axes: tuple[Axis, Axis] = field("Displacement and velocity")
    output: Named = field("Label and unit of the signal")
    measured: Numbers = field("Recorded signal", "stated in `output.unit`")
    before: Numbers = field(SIMULATED, "stated in `output.unit`")
    after: Numbers = field("Simulation by the extended model", "stated in `output.unit`")
    residual_before: Numbers = field(BEFORE, "stated in `output.unit`")
    residual_after: Numbers = field("Residual of the extended model", "stated in `output.unit`")


class Cells(Named):
    """Edges of the cells along displacement or velocity."""

    edges: Numbers = field("Edges of the cells, one more than there are cells", AS_STATED)


class Surface(Form):
    """The unexplained residual in cells of displacement and velocity: one row for each cell of displacement."""

    place: str = field("Storey of a structure, such as storey 2; empty for other components")
    output: Named = field("Label and unit of the unexplained residual")
    displacement: Cells = field("Cells of displacement")
    velocity: Cells = field("Cells of velocity")
    mean: tuple[Numbers, ...] = field(
        "Mean of recorded minus simulated in each cell; null without a sample", "stated in `output.unit`"
    )
    error: tuple[Numbers, ...] = field(
        "Standard error of the mean from the scatter between visits of the cell; null with fewer than two visits",
        "stated in `output.unit`",
    )
    samples: tuple[tuple[int, ...], ...] = field("Number of samples in each cell", NUMBERS)
    visits: tuple[tuple[int, ...], ...] = field("Number of times that the motion enters each cell", NUMBERS)


class HeldOut(Form):
    """Errors on one held-out recording."""

    before: float | None = field(
        "NRMSE of the planned model with refitted parameters; null where the simulation diverges", NUMBERS
    )
    after: float | None = field("NRMSE of the extended model; null where the simulation diverges", NUMBERS)


class Block(Form):
    """Errors on one tenth of the recording, over the RMS of the whole recorded signal about its mean."""

    from_s: float = field("Begin", "s")
    to_s: float = field("End", "s")
    held_out: bool = field("True where the block is held out")
    before: float | None = field(
        "NRMSE of the planned model with refitted parameters; null where the simulation diverges or the block is too short",
        NUMBERS,
    )
    after: float | None = field(
        "NRMSE of the extended model; null where the simulation diverges or the block is too short", NUMBERS
    )


class Detail(Form):
    """One component in detail."""

    channels: tuple[Channel, ...] = field("The recorded signals of the component with the largest residuals, at most four")
    state: State = field("The first of these signals against displacement and velocity")
    blocks: tuple[Block, ...] = field("Errors over ten successive blocks of the recording")
    held_out_recordings: tuple[HeldOut, ...] = field("Errors on each held-out recording")
    noise_nrmse: float | None = field("RMS of the noise over the RMS of the recorded signal about its mean", NUMBERS)
    surfaces: tuple[Surface, ...] = field(
        "The unexplained residual over displacement and velocity, for a structure in each storey; empty where nothing is left "
        "to describe",
        default=(),
    )


class PicturedComponent(Form):
    """The plots of one component."""

    component: str = field("Kind and number of the component, such as specimen:1")
    title: str = field("Name of the component, as shown on pages")
    output: str = field("Compared signal")
    verdict: Kind = field("Verdict on the component")
    mismatch: bool = field("True where the verdict is neither consistent nor recalibrate")
    over_time: OverTime = field("Residual of the planned model over time")
    detail: Detail | None = field(
        "Signals, residuals and errors; null for a component that agrees with its recording and is not the worst component"
    )


class Pictures(Form):
    """Recording, simulations before and after, and residuals; decimated, with six digits, as `rths-diagnosis-pictures/1`."""

    version: Literal["rths-diagnosis-pictures/1"] = field(
        "Name and version of this form", default="rths-diagnosis-pictures/1", alias="schema"
    )
    components: tuple[PicturedComponent, ...] = field("All simulated components")
