"""The plots of a diagnosis from its pictures, as specifications that the page's script draws."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from app.reports.figures import Panel
from app.reports.packed import Samples, packed

ROW, MARGIN, LOWEST = 44, 84, 170  # pixels of the map
SCALE = {  # decades of standard deviations; a third of the way noise ends, about 3
    "from": 0.0,
    "to": 1.5,
    "at": [0.0, 0.5, 1.0, 1.5],
    "said": ["≤ 1", "3", "10", "≥ 30"],
    "title": "Residual over noise",
}
MEASURED, BEFORE, AFTER, NOISE = 0, 1, 2, 3
MODELS = ("before", "after", "simulated")
NAMES = {"measured": "Recording", "before": "Before", "after": "After", "simulated": "Simulation", "noise": "Noise"}
COLOURS = {"measured": MEASURED, "before": BEFORE, "after": AFTER, "simulated": BEFORE, "noise": NOISE}


class Section(NamedTuple):
    title: str
    panels: list[Panel]


def over_time(pictures: dict[str, Any]) -> Panel:
    """Components against time: the residual of the planned model in standard deviations of the noise."""
    components = pictures["components"]
    rows = []
    for one in components:
        level = _array(one["over_time"]["level"])
        decades = np.log10(np.clip(np.nan_to_num(level, nan=1e9), 0.5, 1e9))
        rows.append(
            {
                "name": one["component"],
                "x": one["over_time"]["time_s"],
                "z": decades.round(3).tolist(),
                "said": one["over_time"]["level"],
            }
        )
    said = "; ".join(f"{one['title']} ({one['component']}) {_beyond(one)}" for one in components)
    spec = {
        "rows": rows,
        "scale": SCALE,
        "x": "Time, s",
        "y": "",
        "from_zero": "",
        "height": max(LOWEST, MARGIN + ROW * len(rows)),
    }
    return Panel("Residual of each component over time", f"Residual of each component over time: {said}.", spec, wide=True)


def details(pictures: dict[str, Any]) -> list[Section]:
    """One section for each component that is shown in detail."""
    return [_section(_capital(one["title"]), one["detail"]) for one in pictures["components"] if one["detail"]]


def _section(title: str, detail: dict[str, Any]) -> Section:
    return Section(title, _panels(_as_one(detail))) if _alike(detail) else Section(f"{title} before and after", _panels(detail))


def _panels(detail: dict[str, Any]) -> list[Panel]:
    spans = [{"from": one["from_s"], "to": one["to_s"], "text": "held out"} for one in detail["blocks"] if one["held_out"]]
    found = []
    for channel in detail["channels"]:
        label, unit = channel["label"], channel["shown"]
        name = _capital(label)
        found.append(_lines(f"{name}: recording and simulation", channel, "signals", f"{name}, {unit}", spans))
        found.append(_lines(f"Residual of the {label}", channel, "residuals", f"Residual, {unit}", spans))
        found.append(_spectrum(channel))
    return [*found, *_planes(detail["state"]), _blocks(detail, spans)]


def _alike(detail: dict[str, Any]) -> bool:
    """Where nothing was selected, after is before."""
    return all(channel["signals"]["before"] == channel["signals"]["after"] for channel in detail["channels"])


def _as_one(detail: dict[str, Any]) -> dict[str, Any]:
    """With one simulation instead of two that are alike."""

    def one(given: dict[str, Any]) -> dict[str, Any]:
        return {name.replace("before", "simulated"): value for name, value in given.items() if "after" not in name}

    groups = ("signals", "residuals", "spectra")
    channels = [{**channel, **{group: one(channel[group]) for group in groups}} for channel in detail["channels"]]
    blocks = [one(block) for block in detail["blocks"]]
    return {**detail, "channels": channels, "state": one(detail["state"]), "blocks": blocks}


def _lines(title: str, channel: dict[str, Any], group: str, axis: str, spans: list[dict[str, Any]]) -> Panel:
    given = channel[group]
    time = _array(given["time_s"])
    values = {name: _array(row) / channel["factor"] for name, row in given.items() if name != "time_s"}
    traces = [trace(name, time, row) for name, row in values.items()]
    said = ", ".join(f"{NAMES[name].lower()} {_range(row, channel['shown'])}" for name, row in values.items())
    spec = {"traces": traces, "x": "Time, s", "y": axis, "from_zero": "", "spans": spans}
    return Panel(title, f"{title}: {said}. Shaded spans were held out of the fit.", spec, wide=True)


def _spectrum(channel: dict[str, Any]) -> Panel:
    given, unit = channel["spectra"], channel["shown"]
    frequency = _array(given["frequency_hz"])
    lines = {name: _array(given[name]) / channel["factor"] ** 2 for name in (*MODELS, "noise") if name in given}
    traces = [trace(name, frequency, np.where(row > 0, row, np.nan), name == "noise") for name, row in lines.items()]
    title = f"Spectrum of the residual of the {channel['label']}"
    top = {name: frequency[int(np.argmax(np.nan_to_num(row)))] for name, row in lines.items()}
    peaks = ", ".join(f"{NAMES[name].lower()} at {top[name]:.3g} Hz" for name in MODELS if name in top)
    said = f"largest {peaks}; the noise is dashed"
    density = f"Density, {unit}²/Hz" if unit.isalpha() else f"Density, ({unit})²/Hz"
    spec = {"traces": traces, "x": "Frequency, Hz", "y": density, "from_zero": "", "log": "xy"}
    return Panel(title, f"{title}: {said}.", spec)


def _planes(state: dict[str, Any]) -> list[Panel]:
    """Output against displacement, then the residual against displacement and velocity."""
    output = state["output"]
    name, unit, factor = output["label"], output["shown"], output["factor"]
    moved, speed = state["axes"]
    whole = [(key, _array(state[key]) / factor) for key in ("measured", *MODELS) if key in state]
    left = [(key, _array(state[f"residual_{key}"]) / factor) for key in MODELS if key in state]
    return [
        _plane(f"{_capital(name)} against {moved['label']}", moved, whole, f"{_capital(name)}, {unit}", unit),
        _plane(f"Residual against {moved['label']}", moved, left, f"Residual, {unit}", unit),
        _plane(f"Residual against {speed['label']}", speed, left, f"Residual, {unit}", unit),
    ]


def _plane(title: str, axis: dict[str, Any], lines: Sequence[tuple[str, Samples]], y: str, unit: str) -> Panel:
    x = _array(axis["values"]) / axis["factor"]
    traces = [{**trace(name, x, row), "thin": True} for name, row in lines]
    said = ", ".join(f"{NAMES[name].lower()} {_range(row, unit)}" for name, row in lines)
    spec = {"traces": traces, "x": f"{_capital(axis['label'])}, {axis['shown']}", "y": y, "from_zero": ""}
    return Panel(title, f"{title}, over {_range(x, axis['shown'])}: {said}.", spec)


def _blocks(detail: dict[str, Any], spans: list[dict[str, Any]]) -> Panel:
    blocks = detail["blocks"]
    middle = np.array([0.5 * (one["from_s"] + one["to_s"]) for one in blocks])
    errors = {name: 100 * _array([one[name] for one in blocks]) for name in MODELS if name in blocks[0]}
    floor = 100 * (detail["noise_nrmse"] or 0.0)
    traces = [{**trace(name, middle, row), "bars": True} for name, row in errors.items()]
    ends = np.array([blocks[0]["from_s"], blocks[-1]["to_s"]])
    traces.append(trace("noise", ends, np.full(2, floor), True))
    spec = {"traces": traces, "x": "Time, s", "y": "Error, %", "from_zero": "", "spans": spans}
    kept = [place for place, one in enumerate(blocks) if one["held_out"]]
    said = ", ".join(f"{NAMES[name].lower()} {_range(row[kept], '%')}" for name, row in errors.items())
    title = "Error block by block"
    return Panel(title, f"{title}; on the blocks held out of the fit {said}; noise floor {floor:.3g} %.", spec)


def trace(name: str, x: Samples, y: Samples, dash: bool = False) -> dict[str, Any]:
    known = {"name": NAMES[name], "x": packed(x), "y": packed(y), "colour": COLOURS[name], "dash": dash}
    return {**known, "width": 2.4} if name == "measured" else known


def _beyond(one: dict[str, Any]) -> str:
    level = _array(one["over_time"]["level"])
    above = int(np.sum(level > one["over_time"]["beyond"]))
    return f"beyond the noise in {above} of {len(level)} spans" if above else "within the noise throughout"


def _range(values: Samples, unit: str) -> str:
    known = values[np.isfinite(values)]
    return f"{known.min():.3g} to {known.max():.3g} {unit}" if len(known) else "no finite value"


def _array(values: Sequence[float | None]) -> Samples:
    """Null is NaN, which a plot leaves out."""
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
