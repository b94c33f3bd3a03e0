"""Plots of recording, planned model and extended model together: displacement and force of stations, displacement of floors."""

from __future__ import annotations

import numpy as np

from app.reports.diagnosis_figures import trace
from app.reports.figures import Panel
from rths_engine.recordings.measured import Measured
from rths_engine.recordings.measured.roles import shown
from rths_engine.results.decimate import extremes

BUCKETS = 700
MOST = 8  # panels
ROLES = {"x_meas": "Displacement of station", "f_meas": "Force of station", "x_floor": "Displacement of floor"}


def overlay(recording: Measured, before: Measured, after: Measured) -> list[Panel]:
    """One panel for each signal that the recording and both simulations have."""
    keys = [
        (role, number)
        for role in ROLES
        for number in sorted({one.number or 1 for one in recording.channels if one.role == role})
        if before.has(role, number) and after.has(role, number)
    ]
    named = {"measured": recording, "before": before, "after": after}
    return [_panel(role, number, named) for role, number in keys[:MOST]]


def _panel(role: str, number: int, named: dict[str, Measured]) -> Panel:
    traces, said = [], []
    unit = ""
    for name, one in named.items():
        channel = next(channel for channel in one.channels if channel.role == role and (channel.number or 1) == number)
        values, unit = shown(channel.values, channel.unit)
        kept = extremes(values[:, None], BUCKETS)
        begin = one.dt if one.of_run else 0.0  # both time axes begin at the start of the test
        traces.append(trace(name, begin + kept * one.dt, values[kept]))
        said.append(f"{traces[-1]['name'].lower()} {np.min(values):.3g} to {np.max(values):.3g} {unit}")
    title = f"{ROLES[role]} {number}"
    spec = {"traces": traces, "x": "Time, s", "y": f"{ROLES[role].split()[0]}, {unit}", "from_zero": ""}
    return Panel(title, f"{title}: {', '.join(said)}.", spec, wide=True)
