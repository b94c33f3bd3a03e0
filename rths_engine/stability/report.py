"""Summary, map and warning about the stability of a plan."""

from __future__ import annotations

from typing import Any

from rths_engine.foundation.errors import PlanError
from rths_engine.planning.connections import predicted
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.stability.closed_loop import ClosedLoop, Mode, stable
from rths_engine.stability.margins import Map, delay_map, margin

ARTICLE = {"specimen": "a", "actuator": "an"}
NO_LOOP: dict[str, Any] = {"radius": None, "stable": None, "least_damped": None, "modes": [], "stations": []}
CLIENT = "A client computes the structure. The plan does not describe it, so that the stability of the loop is not predicted."
SHARED = (
    "Stability is not predicted, because stations share a specimen. The dry run of the preflight shows whether limits hold."
)
ALONE = "The plan has no station. These are the modes of the structure, with the damping that its integrator adds."


def summary(planned: Plan | Model) -> dict[str, Any]:
    """Radius, verdict, modes and delay margins as one JSON object (SI); no radius and verdict for a plan without a loop."""
    model = Model.of(planned)
    plan = model.plan
    if plan.test == "client":
        return {**NO_LOOP, "notes": [CLIENT]}
    if plan.driven:
        return {
            **NO_LOOP,
            "notes": [
                f"A test of {ARTICLE[plan.test]} {plan.test} follows its drive. It has no closed loop that can become unstable."
            ],
        }
    if plan.couplings:
        return {**NO_LOOP, "notes": [SHARED]}
    loop = ClosedLoop(model)
    radius, modes = loop.radius(), loop.modes()
    return {
        "radius": radius,
        "stable": stable(radius),
        "least_damped": _mode(modes[0]) if modes else None,
        "modes": [_mode(mode) for mode in modes],
        "stations": [_station(loop, j) for j in range(len(plan.stations))],
        "notes": [*predicted(plan), *loop.notes()] if plan.stations else [ALONE],
    }


def mapped(planned: Plan | Model, points: int) -> dict[str, Any] | None:
    """The radius over the delays of the first two stations; None for a plan with fewer stations."""
    model = Model.of(planned)
    if model.plan.driven or len(model.plan.stations) < 2 or model.plan.couplings:
        return None
    found: Map = delay_map(ClosedLoop(model), points=points)
    axes = [
        {"station": axis.station + 1, "label": axis.label, "present": axis.present, "values": axis.values.tolist()}
        for axis in (found.first, found.second)
    ]
    return {"axes": axes, "radius": found.radius.tolist()}


def warning(planned: Plan | Model) -> str | None:
    """Warning for a plan whose closed loop is predicted unstable about rest or cannot be predicted; None for all others."""
    model = Model.of(planned)
    if not model.plan.stations or model.plan.driven:
        return None
    if model.plan.couplings:
        return SHARED
    try:
        loop = ClosedLoop(model)
    except PlanError as error:
        return unpredicted(error)
    radius = loop.radius()
    if stable(radius):
        return None
    fastest = max(loop.modes(), key=lambda mode: mode.radius, default=None)
    oscillates = fastest is not None and fastest.radius > radius - 1e-9
    how = f"oscillates at {fastest.frequency:.3g} Hz and grows" if fastest and oscillates else "grows"
    found = f"Predicted unstable about rest: the closed loop {how} by {100 * (radius - 1):.2g} % a step."
    return " ".join([found, *loop.notes()])


def unpredicted(error: PlanError) -> str:
    """Why the stability of a plan is not predicted, in a sentence."""
    issue = error.issues[0]
    return f"Stability is not predicted: {f'the {issue.where} ' if issue.where else ''}{issue.problem}."


def _mode(mode: Mode) -> dict[str, float]:
    return {"frequency_hz": mode.frequency, "damping_ratio": mode.damping, "radius": mode.radius}


def _station(loop: ClosedLoop, j: int) -> dict[str, Any]:
    steps = margin(loop, j)
    return {
        "name": loop.plan.stations[j].name,
        "delay_margin_steps": steps,
        "delay_margin_s": None if steps is None else steps * loop.plan.substep,
    }
