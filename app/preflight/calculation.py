"""Dry runs and identifications, each in a process of its own: the web process imports neither the loop nor numba."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

from app.calculations.bound import Bound
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import templates
from rths_engine.planning.reading import read_model

MODULE = "rths_engine.preflight"
IDENTIFYING = "rths_engine.identification"
DRY_RUN = Bound(
    "dry run", seconds=30, megabytes=3000, mend="shorten the test, or run `rths preflight` on the plan", long=True, where="plan"
)
IDENTIFICATION = Bound(
    "identification", seconds=120, megabytes=3000, mend="shorten the random test, or run `rths identify PLAN`", long=True
)
Capacities = tuple[float | None, float | None, float | None]
"""Stroke (m), velocity (m/s) and force (N) of an actuator."""


def load() -> None:
    """Load the compiled loop, so that processes share it."""
    dry_run(templates.template("linear-damper").model_copy(update={"duration": 0.01}).as_dict(), None, [])


def dry_run(plan: dict[str, Any], motions: Path | None, capacities: list[Capacities | None]) -> dict[str, Any]:
    """The preflight of a checked plan; `motions` is the folder of records. Raises PlanError."""
    engine = importlib.import_module(MODULE)
    bounds = [None if one is None else engine.Capacity(*one) for one in capacities]
    found: dict[str, Any] = engine.preflight(read_model(plan), MotionLibrary(motions), bounds)
    return found


def identified(plan: dict[str, Any], station: int, settings: dict[str, Any]) -> dict[str, Any]:
    """The delay of a station (from 1) of a checked plan by a random test. Raises PlanError."""
    engine = importlib.import_module(IDENTIFYING)
    test = engine.RandomTest.model_validate(settings)
    found: dict[str, Any] = engine.identify(read_model(plan).plan, station, test)
    return found
