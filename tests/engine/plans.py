"""Small plans for tests."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.ground_motions import MotionLibrary
from rths_engine.plan import Plan
from rths_engine.run import Run

NO_LIMITS = {"displacement": 10.0, "velocity": 10.0, "force": 1e9}
LIBRARY = MotionLibrary(None)


def quiet(duration: float) -> dict[str, Any]:
    """A ground that does not move."""
    return {"kind": "inline", "dt": duration / 50, "acceleration": [0.0] * 51}


def shaking(acceleration: np.ndarray, dt: float) -> dict[str, Any]:
    return {"kind": "inline", "dt": dt, "acceleration": acceleration.tolist()}


def building(masses: list[float], stiffnesses: list[float], ratio: float = 0.0) -> dict[str, Any]:
    storeys = [{"mass": m, "stiffness": k} for m, k in zip(masses, stiffnesses, strict=True)]
    return {"kind": "shear_building", "storeys": storeys, "damping_ratio": ratio}


def make(
    structure: dict[str, Any], motion: dict[str, Any], dt: float, substeps: int = 1, kind: str = "cr", **more: Any
) -> Plan:
    rho = {"rho": more.pop("rho")} if "rho" in more else {}
    integrator = {"kind": kind, "dt": dt, "substeps": substeps, **rho}
    return Plan.read(
        {"structure": structure, "motion": motion, "integrator": integrator, "controller_rate": substeps / dt, **more}
    )


def completed(plan: Plan, **more: Any) -> Run:
    run = Run(plan, LIBRARY, **more)
    run.advance(run.total)
    assert run.trip is None, run.trip.sentence
    return run
