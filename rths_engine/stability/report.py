"""What is told of a plan's stability."""

from __future__ import annotations

from typing import Any

from rths_engine.plan import Plan
from rths_engine.stability.closed_loop import ClosedLoop, Mode, stable
from rths_engine.stability.margins import Map, delay_map, margin


def summary(plan: Plan) -> dict[str, Any]:
    """Radius, verdict, modes and delay margins as one JSON object (SI)."""
    loop = ClosedLoop(plan)
    radius, modes = loop.radius(), loop.modes()
    return {
        "radius": radius,
        "stable": stable(radius),
        "least_damped": _mode(modes[0]) if modes else None,
        "modes": [_mode(mode) for mode in modes],
        "stations": [_station(loop, j) for j in range(len(plan.stations))],
        "notes": loop.notes(),
    }


def mapped(plan: Plan, points: int) -> dict[str, Any] | None:
    """The radius over the delays of the first two stations; None for fewer."""
    if len(plan.stations) < 2:
        return None
    found: Map = delay_map(ClosedLoop(plan), points=points)
    axes = [
        {"station": axis.station + 1, "label": axis.label, "present": axis.present, "values": axis.values.tolist()}
        for axis in (found.first, found.second)
    ]
    return {"axes": axes, "radius": found.radius.tolist()}


def warning(plan: Plan) -> str | None:
    """Sentences for a plan whose closed loop is predicted unstable about rest; None for any other."""
    loop = ClosedLoop(plan)
    radius = loop.radius()
    if stable(radius):
        return None
    fastest = max(loop.modes(), key=lambda mode: mode.radius, default=None)
    oscillates = fastest is not None and fastest.radius > radius - 1e-9
    how = f"oscillates at {fastest.frequency:.3g} Hz and grows" if fastest and oscillates else "grows"
    found = f"Predicted unstable about rest: the closed loop {how} by {100 * (radius - 1):.2g} % a step."
    return " ".join([found, *loop.notes()])


def _mode(mode: Mode) -> dict[str, float]:
    return {"frequency_hz": mode.frequency, "damping_ratio": mode.damping, "radius": mode.radius}


def _station(loop: ClosedLoop, j: int) -> dict[str, Any]:
    steps = margin(loop, j)
    return {
        "name": loop.plan.stations[j].name,
        "delay_margin_steps": steps,
        "delay_margin_s": None if steps is None else steps * loop.plan.substep,
    }
