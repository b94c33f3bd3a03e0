"""The data of the plots of a diagnosis, as `rths-diagnosis-pictures/1`.

"Before" is the planned model with refitted parameters, "after" the selected model.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.signal import welch

from rths_engine.diagnosis.components.structure import StructureData
from rths_engine.diagnosis.ends import inner
from rths_engine.diagnosis.judge import BLOCKS, HELD_OUT, Judged
from rths_engine.diagnosis.locate import BEYOND, place
from rths_engine.diagnosis.noise import FREQUENCY, Noise
from rths_engine.diagnosis.remaining import Remaining
from rths_engine.diagnosis.result import ORDER
from rths_engine.diagnosis.schema import pictures as form
from rths_engine.diagnosis.surface import Surface
from rths_engine.diagnosis.verdict import Diagnosis
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured.roles import SHOWN, dimension, to_si
from rths_engine.results.decimate import extremes

# chosen; see docs/decisions/0023
POINTS = 3000  # of a plot
MOST_CHANNELS = 4  # of a component
SEGMENTS = 8  # of a spectrum
DIGITS = 6
WELL = ("consistent", "recalibrate")
MOTIONS = {"x": ("displacement", "m"), "v": ("velocity", "m/s"), "a": ("acceleration", "m/s^2")}


def pictures(diagnosis: Diagnosis) -> form.Pictures:
    """The plots of all components; components with a mismatch, and at least the worst component, in detail."""
    worst = max(diagnosis.judged, key=lambda one: (ORDER.index(one.verdict), one.gain))
    left = diagnosis.left
    found = (_component(one, one is worst or one.verdict not in WELL, left.get(one.component.name)) for one in diagnosis.judged)
    return form.Pictures(components=tuple(found))


def _component(one: Judged, detailed: bool, left: Remaining | None) -> form.PicturedComponent:
    found = place(one)
    return form.PicturedComponent(
        component=one.component.name,
        title=one.name,
        output=one.component.output,
        verdict=one.verdict,
        mismatch=one.verdict not in WELL,
        over_time=form.OverTime(time_s=_numbers(found.middle), level=_numbers(found.level), beyond=BEYOND),
        detail=_detail(one, left) if detailed else None,
    )


def _detail(one: Judged, left: Remaining | None) -> form.Detail:
    data = one.recordings.data[0]
    before, after = (one.recordings.predicted(model.parts)[0] for model in (one.selection.baseline, one.selection.chosen))
    missed = np.mean((data.measured - before) ** 2, axis=1) / np.maximum(np.var(data.measured, axis=1), 1e-300)
    shown = sorted(np.argsort(-missed)[:MOST_CHANNELS])
    weights = one.recordings.weights[0]
    return form.Detail(
        channels=tuple(
            _channel(
                _named(one, row),
                data,
                (data.measured[row], before[row], after[row]),
                (one.recordings.noises[row], weights[row]),
            )
            for row in shown
        ),
        state=_state(one, data, shown[0], before[shown[0]], after[shown[0]]),
        blocks=_blocks(data, before, after, not one.heldout),
        held_out_recordings=tuple(_whole(one, other) for other in one.heldout),
        noise_nrmse=_number(one.noise),
        surfaces=tuple(_surface(surface, left.unit) for surface in left.surfaces) if left else (),
    )


def _surface(one: Surface, unit: str) -> form.Surface:
    """The unexplained residual in the cells of displacement and velocity."""
    label = "unexplained displacement" if unit == "m" else "unexplained storey force" if one.place else "unexplained force"
    x, v = (form.Cells(label=axis.label, **_unit(axis.unit), edges=_numbers(axis.values)) for axis in (one.x, one.v))
    return form.Surface(
        place=one.place,
        output=form.Named(label=label, **_unit(unit)),
        displacement=x,
        velocity=v,
        mean=tuple(_numbers(row) for row in one.mean),
        error=tuple(_numbers(row) for row in one.error),
        samples=tuple(tuple(int(count) for count in row) for row in one.samples),
        visits=tuple(tuple(int(count) for count in row) for row in one.visits),
    )


def _named(one: Judged, row: int) -> dict[str, Any]:
    """Label and unit of one channel of the output."""
    data = one.recordings.data[0]
    if isinstance(data, StructureData):
        kind, floor, _ = data.floors[row]
        name, unit = MOTIONS[kind]
        return {"label": f"{name} of floor {floor}", **_unit(unit)}
    return {"label": one.component.output, **_unit("N" if one.component.output == "force" else "m")}


def _unit(unit: str) -> dict[str, Any]:
    shown = SHOWN[dimension(unit)]
    return {"unit": unit, "shown": shown, "factor": to_si(shown)[0]}


def _channel(named: dict[str, Any], data: Any, signals: tuple[Array, Array, Array], noise: tuple[Noise, Array]) -> form.Channel:
    measured, before, after = signals
    residuals = np.array([measured - before, measured - after])
    return form.Channel(
        **named,
        signals=form.Signals(**_over_time(data.time, ("measured", "before", "after"), np.array(signals))),
        residuals=form.Residuals(**_over_time(data.time, ("before", "after"), residuals)),
        spectra=_spectra(residuals, *noise, data.step),
    )


def _over_time(time: Array, names: Sequence[str], signals: Array) -> dict[str, form.Numbers]:
    kept = extremes(signals.T, POINTS // (2 * len(names)))
    return {"time_s": _numbers(time[kept]), **{name: _numbers(row[kept]) for name, row in zip(names, signals, strict=True)}}


def _spectra(residuals: Array, noise: Noise, weights: Array, step: float) -> form.Spectra:
    """Power spectral densities (unit^2/Hz) of the residuals by Welch's method, and of the noise model over the weights."""
    length = max(16, residuals.shape[1] // SEGMENTS)
    frequency, power = welch(np.nan_to_num(residuals), 1 / step, nperseg=min(length, residuals.shape[1]))
    modelled = 2 * step * np.interp(step * frequency, FREQUENCY, noise.spectrum) * np.mean(weights**-2.0)
    before, after, known = (_numbers(line[1:]) for line in (*power, modelled))
    return form.Spectra(frequency_hz=_numbers(frequency[1:]), before=before, after=after, noise=known)


def _state(one: Judged, data: Any, row: int, before: Array, after: Array) -> form.State:
    """Output and residuals against displacement and velocity, every n-th sample."""
    every = slice(None, None, -(-data.measured.shape[1] // POINTS))
    displacement, velocity = (
        form.Axis(label=signal.label, **_unit(signal.unit), values=_numbers(signal.values[every]))
        for signal in one.component.signals(data)
    )
    measured = data.measured[row]
    return form.State(
        axes=(displacement, velocity),
        output=form.Named(**_named(one, row)),
        measured=_numbers(measured[every]),
        before=_numbers(before[every]),
        after=_numbers(after[every]),
        residual_before=_numbers((measured - before)[every]),
        residual_after=_numbers((measured - after)[every]),
    )


def _blocks(data: Any, before: Array, after: Array, reserved: bool) -> tuple[form.Block, ...]:
    """Errors of each block, over the RMS of the whole signal about its mean; `reserved` where some blocks are held out."""
    count = data.measured.shape[1]
    number, used = np.arange(count) * BLOCKS // count, inner(count, data.step)
    found = []
    for block in range(BLOCKS):
        rows = np.flatnonzero(number == block)
        here = rows[used[rows]]
        off, left = (_nrmse(data.measured, model, here) if len(here) else None for model in (before, after))
        found.append(
            form.Block(
                from_s=_rounded(data.time[rows[0]]),
                to_s=_rounded(data.time[rows[-1]] + data.step),
                held_out=reserved and block in HELD_OUT,
                before=off,
                after=left,
            )
        )
    return tuple(found)


def _whole(one: Judged, other: Any) -> form.HeldOut:
    rows = np.flatnonzero(inner(other.measured.shape[1], other.step))
    before, after = (
        _nrmse(other.measured, one.component.predicted(model.parts, other), rows)
        for model in (one.selection.baseline, one.selection.chosen)
    )
    return form.HeldOut(before=before, after=after)


def _nrmse(measured: Array, simulated: Array, rows: Any) -> float | None:
    spread = np.maximum(np.var(measured, axis=1), 1e-300)
    return _number(float(np.sqrt(np.mean(np.mean((measured - simulated)[:, rows] ** 2, axis=1) / spread))))


def _numbers(values: Array) -> form.Numbers:
    return tuple(_number(float(value)) for value in values)


def _number(value: float) -> float | None:
    """The value rounded to DIGITS digits; None where it is not finite."""
    return _rounded(value) if np.isfinite(value) else None


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
