"""Small plans for tests."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.foundation.part import validated
from rths_engine.parts.compensators import Compensator
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.parts.compensators.inverse import InverseCompensation
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan, Station
from rths_engine.planning.reading import read_plan
from rths_engine.planning.templates import template
from rths_engine.running.run import Run

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


def followed(station: dict[str, Any]) -> dict[str, Any]:
    """The station with NO_LIMITS lowered to what its actuator can follow, as a plan has to."""
    capacity = validated(Station, {key: station[key] for key in ("actuator",) if key in station}).actuator.velocity_limit
    limits = station.get("limits", {})
    wide = limits.get("velocity") == NO_LIMITS["velocity"] and capacity < NO_LIMITS["velocity"]
    return {**station, "limits": {**limits, "velocity": capacity}} if wide else station


def make(
    structure: dict[str, Any], motion: dict[str, Any], dt: float, substeps: int = 1, kind: str = "cr", **more: Any
) -> Plan:
    rho = {"rho": more.pop("rho")} if "rho" in more else {}
    integrator = {"kind": kind, "dt": dt, "substeps": substeps, **rho}
    more["stations"] = [followed(station) for station in more.get("stations", [])]
    return read_plan(
        {"structure": structure, "motion": motion, "integrator": integrator, "controller_rate": substeps / dt, **more}
    )


def two_storeys(alpha_es: tuple[float, float], kp: float = 0.0) -> Plan:
    """The template of two storeys with delay estimates (controller steps), and adaptation kp (1/mm^2) or none."""
    plan = template("two-storeys")
    stations = tuple(
        station.model_copy(update={"compensator": _compensator(alpha, kp * 1e6)})
        for station, alpha in zip(plan.stations, alpha_es, strict=True)
    )
    return plan.model_copy(update={"stations": stations})


def _compensator(alpha_es: float, kp: float) -> Compensator:
    if kp:
        return AdaptiveInverseCompensation(alpha_es=alpha_es, kp=kp, ki=kp / 10)
    return InverseCompensation(alpha_es=alpha_es) if alpha_es > 1 else NoCompensation()


def completed(plan: Plan, **more: Any) -> Run:
    run = Run(plan, LIBRARY, **more)
    run.advance(run.total)
    assert run.trip is None, run.trip.sentence
    return run
