"""The plots of a report as data: titles, axes with units and packed traces. The script of the page draws them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.reports.packed import Samples, packed
from rths_engine.planning.plan import Station
from rths_engine.results.channels import CHANNELS, key
from rths_engine.results.decimate import extremes

POINTS = 130_000  # of all traces together: 2 x 4 bytes a point in base64 make 1.4 MB
MOST_BUCKETS = 1200
DETAIL = 1.5  # s on each side


@dataclass(frozen=True, slots=True)
class Panel:
    """One plot. The script draws `spec`; a screen reader reads `alt`."""

    title: str
    alt: str
    spec: dict[str, Any]
    wide: bool = False
    tall: bool = False


class Figures:
    """Makes panels of a recording's channels in shown units. All panels share the POINTS."""

    def __init__(self, recording: Any):
        self.time: Samples = recording.time
        self.column = {channel.key: index for index, channel in enumerate(recording.channels)}
        self.channels = recording.channels
        self.signals: Samples = recording.signals
        stations = [channel for channel in recording.channels if channel.role == "x_cmd"]
        traces = 12 * len(stations) + 8
        self.buckets = max(60, min(MOST_BUCKETS, POINTS // (2 * traces)))

    def shown(self, key: str) -> Samples:
        """A channel in its shown unit."""
        index = self.column[key]
        values: Samples = self.signals[:, index] / self.channels[index].factor
        return values

    def unit(self, key: str) -> str:
        label: str = self.channels[self.column[key]].shown_label
        return label

    def against_time(
        self,
        title: str,
        quantity: str,
        keys: Sequence[tuple[str, str]],
        of: str = "",
        part: slice | None = None,
        wide: bool = False,
    ) -> Panel:
        """A panel of channels against time. `keys`: channel and name of each trace; `part`: the shown rows, all by default."""
        rows = part or slice(None)
        time, unit = self.time[rows], self.unit(keys[0][0])
        signals = np.column_stack([self.shown(key)[rows] for key, _ in keys])
        kept = extremes(signals, self.buckets)
        traces = [
            {"name": name, "x": packed(time[kept]), "y": packed(signals[kept, index]), "colour": index}
            for index, (_, name) in enumerate(keys)
        ]
        spec = {"traces": traces, "x": "Time, s", "y": _labelled(quantity, unit), "from_zero": "" if part else "x"}
        return Panel(title, _sentence(title, of, time, signals, unit), spec, wide)

    def work(self, title: str, number: int, of: str) -> Panel:
        """A panel of the energy that a station's specimen absorbed, the integral of f dx (kN m), against time."""
        x, force = self.shown(key("x_meas", number)) * 1e-3, self.shown(key("f_meas", number))
        energy = np.cumsum(0.5 * (force + np.append(0.0, force[:-1])) * np.diff(x, prepend=0.0))
        kept = extremes(energy[:, None], self.buckets)
        trace = {"name": of, "x": packed(self.time[kept]), "y": packed(energy[kept]), "colour": 0}
        spec = {"traces": [trace], "x": "Time, s", "y": "Energy, kN·m", "from_zero": "x"}
        return Panel(title, _sentence(title, of, self.time, energy, "kN·m"), spec)

    def against(
        self, title: str, x: tuple[str, str], y: tuple[str, str], of: str, large: bool = False, equal: bool = False
    ) -> Panel:
        """A panel of one channel against another, for example a hysteresis loop. `equal` adds the line where both are equal."""
        pair = np.column_stack([self.shown(x[0]), self.shown(y[0])])
        kept = extremes(pair, self.buckets)
        traces = [{"name": "Measured" if equal else of, **_line(pair[kept]), "colour": 0, "thin": True}]
        if equal and len(pair):
            known = np.nan_to_num(pair)
            ends = np.array([known.min(), known.max()])
            traces.append({"name": "Equal", **_line(np.column_stack([ends, ends])), "colour": 1, "thin": True})
        spec = {
            "traces": traces,
            "x": _labelled(x[1], self.unit(x[0])),
            "y": _labelled(y[1], self.unit(y[0])),
            "from_zero": "",
        }
        alt = f"{title}, {of}: {_range(pair[:, 1], self.unit(y[0]))} over {_range(pair[:, 0], self.unit(x[0]))}."
        return Panel(title, alt, spec, large, large)


def station_panels(figures: Figures, number: int, station: Station, test: str) -> list[Panel]:
    """The panels of a station in a kind of test; for a hybrid test those of Figures 8 and 9 of the paper."""
    name = station.name

    def alone(role: str) -> Panel:
        title = CHANNELS[role].label
        return figures.against_time(title, title, [(key(role, number), title)], name)

    def axis(role: str) -> tuple[str, str]:
        return key(role, number), CHANNELS[role].label

    pair = [(key("x_cmd", number), "Command"), (key("x_meas", number), "Measured")]
    moved = figures.against_time("Command and measured displacement", "Displacement", pair, name, wide=True)
    detail = figures.against_time("Detail around the largest command", "Displacement", pair, name, _detail(figures, number))
    loop = figures.against("Force against displacement", axis("x_meas"), axis("f_meas"), name, large=test == "specimen")
    subspace = figures.against("Synchronisation subspace", axis("x_cmd"), axis("x_meas"), name, equal=True)
    error, indicator, force = alone("error"), alone("ti"), alone("f_meas")
    adapted = [alone("d_alpha")] if station.compensator.kind != "none" else []
    driven = [alone("current")] if station.controller.kind != "none" else []
    if test == "specimen":
        return [loop, moved, force, *driven, figures.work("Energy dissipated", number, name), error]
    if test == "actuator":
        return [moved, detail, subspace, error, indicator, force, *driven, *adapted]
    return [moved, detail, loop, *driven, subspace, error, indicator, alone("energy_error"), *adapted]


def spectrum_panel(periods: Samples, sa_g: Samples, t1: float, sa_t1_g: float, damping: float) -> Panel:
    """The panel of a response spectrum: Sa (g) against period (s), with T1 marked."""
    title = f"Response spectrum, {damping * 100:g} % damping"
    mark = {"x": t1, "y": sa_t1_g, "text": f"T₁ = {t1:.3g} s, Sa = {sa_t1_g:.3f} g"}
    trace = {"name": "Sa", "x": packed(periods), "y": packed(sa_g), "colour": 0}
    spec = {"traces": [trace], "x": "Period, s", "y": "Spectral acceleration Sa, g", "from_zero": "xy", "mark": mark}
    peak = int(np.argmax(sa_g))
    alt = f"{title}: largest {sa_g[peak]:.3g} g at {periods[peak]:.3g} s; {sa_t1_g:.3g} g at T1 = {t1:.3g} s."
    return Panel(title, alt, spec)


def _detail(figures: Figures, number: int) -> slice:
    command, time = np.nan_to_num(figures.shown(key("x_cmd", number))), figures.time
    if not len(time):
        return slice(None)
    centre = time[int(np.argmax(np.abs(command)))]
    start = max(float(time[0]), min(centre - DETAIL, float(time[-1]) - 2 * DETAIL))
    first, last = np.searchsorted(time, [start, start + 2 * DETAIL])
    return slice(int(first), int(last) + 1)


def _line(points: Samples) -> dict[str, Any]:
    return {"x": packed(points[:, 0]), "y": packed(points[:, 1])}


def _labelled(quantity: str, unit: str) -> str:
    return f"{quantity}, {unit}" if unit else quantity


def _sentence(title: str, of: str, time: Samples, signals: Samples, unit: str) -> str:
    whose = f" of {of}" if of else ""
    if not len(time):
        return f"{title}{whose}: no samples."
    return f"{title}{whose} from {time[0]:.1f} to {time[-1]:.1f} s: {_range(signals, unit)}."


def _range(values: Samples, unit: str) -> str:
    known = values[np.isfinite(values)]
    if not len(known):
        return "no finite value"
    return f"{known.min():.3g} to {known.max():.3g} {unit}".strip()
