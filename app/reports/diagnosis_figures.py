"""The plots of a diagnosis, as specifications that the script of the page draws."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from app.reports.diagnosis_names import capital
from app.reports.diagnosis_surface import surface_panel
from app.reports.figures import Panel
from app.reports.packed import Samples, packed
from rths_engine.diagnosis.schema import Pictures
from rths_engine.diagnosis.schema.pictures import Axis, Channel, Detail, Numbers, OverTime, Residuals, Signals, Spectra, State

ROW, MARGIN, LOWEST = 44, 84, 170  # pixels of the map
SCALE = {  # decades of standard deviations; noise ends at about 3, a third of the scale
    "from": 0.0,
    "to": 1.5,
    "at": [0.0, 0.5, 1.0, 1.5],
    "said": ["≤ 1", "3", "10", "≥ 30"],
    "title": "Residual over noise",
}
MEASURED, BEFORE, AFTER, NOISE = 0, 1, 2, 3
Models = dict[str, str]  # name of a shown simulation -> its field in the pictures
Lines = Sequence[tuple[str, Numbers]]
NAMES = {
    "measured": "Recording",
    "before": "Planned model",
    "after": "Extended model",
    "simulated": "Simulation",
    "noise": "Noise",
}
COLOURS = {"measured": MEASURED, "before": BEFORE, "after": AFTER, "simulated": BEFORE, "noise": NOISE}


class Section(NamedTuple):
    """A heading of a report and the plots under it."""

    title: str
    panels: list[Panel]


def over_time(pictures: Pictures) -> Panel:
    """The map of components against time: the residual of the planned model in standard deviations of the noise."""
    components = pictures.components
    rows = []
    for one in components:
        level = _array(one.over_time.level)
        decades = np.log10(np.clip(np.nan_to_num(level, nan=1e9), 0.5, 1e9))
        rows.append(
            {
                "name": capital(one.title),
                "x": one.over_time.time_s,
                "z": decades.round(3).tolist(),
                "said": one.over_time.level,
            }
        )
    said = "; ".join(f"{one.title} {_beyond(one.over_time)}" for one in components)
    spec = {
        "rows": rows,
        "scale": SCALE,
        "x": "Time, s",
        "y": "",
        "from_zero": "",
        "height": max(LOWEST, MARGIN + ROW * len(rows)),
    }
    return Panel("Residual of each component over time", f"Residual of each component over time: {said}.", spec, wide=True)


def details(pictures: Pictures) -> list[Section]:
    """One section for each component that is shown in detail."""
    return [_section(capital(one.title), one.detail) for one in pictures.components if one.detail]


def _section(title: str, detail: Detail) -> Section:
    """The section of one component. Without a selected effect both models are equal, and only one simulation is shown."""
    if all(channel.signals.before == channel.signals.after for channel in detail.channels):
        return Section(title, _panels(detail, {"simulated": "before"}))
    return Section(f"{title}: planned and extended model", _panels(detail, {"before": "before", "after": "after"}))


def _panels(detail: Detail, models: Models) -> list[Panel]:
    spans = [{"from": one.from_s, "to": one.to_s, "text": "held out"} for one in detail.blocks if one.held_out]
    found = []
    for channel in detail.channels:
        name = capital(channel.label)
        signals = [("measured", channel.signals.measured), *_of(channel.signals, models)]
        left = _of(channel.residuals, models)
        axes = (f"{name}, {channel.shown}", f"Residual, {channel.shown}")
        found.append(_lines(f"{name}: recording and simulation", channel, channel.signals.time_s, signals, axes[0], spans))
        found.append(_lines(f"Residual of the {channel.label}", channel, channel.residuals.time_s, left, axes[1], spans))
        found.append(_spectrum(channel, models))
    surfaces = [surface_panel(one) for one in detail.surfaces]
    return [*surfaces, *found, *_planes(detail.state, models), _blocks(detail, models, spans)]


def _of(signals: Signals | Residuals | Spectra | State, models: Models, group: str = "") -> list[tuple[str, Numbers]]:
    """The values of each shown model in a group, by the model's name."""
    return [(name, getattr(signals, f"{group}{place}")) for name, place in models.items()]


def _lines(title: str, channel: Channel, time: Numbers, lines: Lines, axis: str, spans: list[dict[str, Any]]) -> Panel:
    values = [(name, _array(row) / channel.factor) for name, row in lines]
    traces = [trace(name, _array(time), row) for name, row in values]
    said = ", ".join(f"{NAMES[name].lower()} {_range(row, channel.shown)}" for name, row in values)
    spec = {"traces": traces, "x": "Time, s", "y": axis, "from_zero": "", "spans": spans}
    return Panel(title, f"{title}: {said}. Shaded spans are held out of the fit.", spec, wide=True)


def _spectrum(channel: Channel, models: Models) -> Panel:
    unit, frequency = channel.shown, _array(channel.spectra.frequency_hz)
    given = [*_of(channel.spectra, models), ("noise", channel.spectra.noise)]
    lines = {name: _array(row) / channel.factor**2 for name, row in given}
    traces = [trace(name, frequency, np.where(row > 0, row, np.nan), name == "noise") for name, row in lines.items()]
    title = f"Spectrum of the residual of the {channel.label}"
    top = {name: frequency[int(np.argmax(np.nan_to_num(lines[name])))] for name in models}
    peaks = ", ".join(f"{NAMES[name].lower()} at {at:.3g} Hz" for name, at in top.items())
    said = f"largest {peaks}; the noise is dashed"
    density = f"Density, {unit}²/Hz" if unit.isalpha() else f"Density, ({unit})²/Hz"
    spec = {"traces": traces, "x": "Frequency, Hz", "y": density, "from_zero": "", "log": "xy"}
    return Panel(title, f"{title}: {said}.", spec)


def _planes(state: State, models: Models) -> list[Panel]:
    """Plots of the output against displacement, and of the residual against displacement and velocity."""
    name, unit, factor = state.output.label, state.output.shown, state.output.factor
    moved, speed = state.axes
    given = [("measured", state.measured), *_of(state, models)]
    whole = [(key, _array(row) / factor) for key, row in given]
    left = [(key, _array(row) / factor) for key, row in _of(state, models, "residual_")]
    return [
        _plane(f"{capital(name)} against {moved.label}", moved, whole, f"{capital(name)}, {unit}", unit),
        _plane(f"Residual against {moved.label}", moved, left, f"Residual, {unit}", unit),
        _plane(f"Residual against {speed.label}", speed, left, f"Residual, {unit}", unit),
    ]


def _plane(title: str, axis: Axis, lines: Sequence[tuple[str, Samples]], y: str, unit: str) -> Panel:
    x = _array(axis.values) / axis.factor
    traces = [{**trace(name, x, row), "thin": True} for name, row in lines]
    said = ", ".join(f"{NAMES[name].lower()} {_range(row, unit)}" for name, row in lines)
    spec = {"traces": traces, "x": f"{capital(axis.label)}, {axis.shown}", "y": y, "from_zero": ""}
    return Panel(title, f"{title}, over {_range(x, axis.shown)}: {said}.", spec)


def _blocks(detail: Detail, models: Models, spans: list[dict[str, Any]]) -> Panel:
    blocks = detail.blocks
    middle = np.array([0.5 * (one.from_s + one.to_s) for one in blocks])
    errors = {name: 100 * _array([getattr(one, place) for one in blocks]) for name, place in models.items()}
    floor = np.nan if detail.noise_nrmse is None else 100 * detail.noise_nrmse
    traces = [{**trace(name, middle, row), "bars": True} for name, row in errors.items()]
    ends = np.array([blocks[0].from_s, blocks[-1].to_s])
    traces.append(trace("noise", ends, np.full(2, floor), True))
    spec = {"traces": traces, "x": "Time, s", "y": "Error, %", "from_zero": "", "spans": spans}
    kept = [place for place, one in enumerate(blocks) if one.held_out]
    said = ", ".join(f"{NAMES[name].lower()} {_range(row[kept], '%')}" for name, row in errors.items())
    title = "Error of each block"
    noise = "unknown" if detail.noise_nrmse is None else f"{floor:.3g} %"
    return Panel(title, f"{title}; on the held-out blocks {said}; noise floor {noise}.", spec)


def trace(name: str, x: Samples, y: Samples, dash: bool = False) -> dict[str, Any]:
    """A line of a plot; `name` gives its label and colour."""
    known = {"name": NAMES[name], "x": packed(x), "y": packed(y), "colour": COLOURS[name], "dash": dash}
    return {**known, "width": 2.4} if name == "measured" else known


def _beyond(one: OverTime) -> str:
    level = _array(one.level)
    above = int(np.sum(np.nan_to_num(level, nan=np.inf) > one.beyond))
    return f"above the noise in {above} of {len(level)} spans" if above else "within the noise everywhere"


def _range(values: Samples, unit: str) -> str:
    known = values[np.isfinite(values)]
    return f"{known.min():.3g} to {known.max():.3g} {unit}" if len(known) else "no finite value"


def _array(values: Sequence[float | None]) -> Samples:
    """The values as an array; null becomes NaN, which a plot leaves out."""
    return np.array([np.nan if value is None else value for value in values], dtype=float)
