"""Plots of recording, planned model and extended model together: displacement and force of stations, displacement of floors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.reports.diagnosis_figures import trace
from app.reports.figures import Panel
from rths_engine.recordings.measured import Measured
from rths_engine.recordings.measured.roles import shown
from rths_engine.results.decimate import extremes

BUCKETS = 700
MOST = 8  # panels
ROLES = {"x_meas": "Displacement of station", "f_meas": "Force of station", "x_floor": "Displacement of floor"}


@dataclass(frozen=True, slots=True)
class Overlaid:
    """A recording and the recordings of both runs; the runs take `lead` (s) before the recording begins."""

    recording: Measured
    before: Measured
    after: Measured
    lead: float = 0.0


def overlay(found: Overlaid) -> list[Panel]:
    """One panel for each signal that the recording and both simulations have, over the time of the recording."""
    recording, before, after = found.recording, found.before, found.after
    keys = [
        (role, number)
        for role in ROLES
        for number in sorted({one.number or 1 for one in recording.channels if one.role == role})
        if before.has(role, number) and after.has(role, number)
    ]
    return [_panel(role, number, found) for role, number in keys[:MOST]]


def _panel(role: str, number: int, found: Overlaid) -> Panel:
    traces, said = [], []
    unit = ""
    for name, one in (("measured", found.recording), ("before", found.before), ("after", found.after)):
        channel = next(channel for channel in one.channels if channel.role == role and (channel.number or 1) == number)
        late = 0.0 if name == "measured" else found.lead
        first = round(late / one.dt)  # a run and its recording begin at the start of the test, or behind the ramp to it
        values, unit = shown(channel.values[first:], channel.unit)
        kept = extremes(values[:, None], BUCKETS)
        begin = one.dt if one.of_run else 0.0
        traces.append(trace(name, begin + first * one.dt - late + kept * one.dt, values[kept]))
        said.append(f"{traces[-1]['name'].lower()} {np.min(values):.3g} to {np.max(values):.3g} {unit}")
    title = f"{ROLES[role]} {number}"
    spec = {"traces": traces, "x": "Time, s", "y": f"{ROLES[role].split()[0]}, {unit}", "from_zero": ""}
    return Panel(title, f"{title}: {', '.join(said)}.", spec, wide=True)
