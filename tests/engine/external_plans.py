"""Plans with external rigs for tests: two storeys, each with a spring of 2 kN/mm, shaken for half a second."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.planning.connections import modelled
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.running.opening import opened
from rths_engine.running.run import Run
from tests.engine.plans import LIBRARY, building, completed, make, shaking

RATE = 256.0
FAST = {"kind": "real_time", "factor": 1000.0}
REAL = {"kind": "real_time", "factor": 1.0}
DIRECT = {"kind": "first_order_delay", "alpha": 1.0, "velocity_limit": 10.0, "force_limit": 1e8}
SPRING = {"kind": "linear", "stiffness": 2e6, "damping": 0.0}


def station(number: int, connection: dict[str, Any] | None = None, **more: Any) -> dict[str, Any]:
    """A station with a spring in a storey, and a start of at most 1 mm from zero."""
    return {
        "name": f"Spring {number}",
        "storey": number,
        "compensator": {"kind": "none"},
        "actuator": DIRECT,
        "specimen": SPRING,
        "limits": {"displacement": 0.03, "velocity": 2.0, "force": 5e5},
        "connection": connection or {"kind": "emulated"},
        **more,
    }


def fastest(*stations: dict[str, Any]) -> dict[str, Any]:
    """The fastest pace at which the rigs of stations may be driven: a machine is not moved faster than in real time."""
    return FAST if all(one["connection"]["kind"] in ("emulated", "fmu") for one in stations) else REAL


def hybrid(*stations: dict[str, Any], pace: Any = None, duration: float = 0.5, peak: float = 1.5) -> Plan:
    """Two storeys under a burst of ground acceleration."""
    ground = peak * np.sin(2 * np.pi * 2.0 * np.arange(0.0, duration, 0.01))
    return make(
        building([20e3, 20e3], [3e6, 3e6], 0.02),
        shaking(ground, 0.01),
        1 / RATE,
        stations=list(stations),
        pace=pace or fastest(*stations),
        duration=duration,
    )


def driven(one: dict[str, Any], shape: dict[str, Any], pace: Any = None, amplitude: float = 0.01) -> Plan:
    """A test of the specimen alone at RATE."""
    from rths_engine.planning.reading import read_plan

    alone = {key: value for key, value in one.items() if key != "storey"}
    return read_plan(
        {
            "test": "specimen",
            "drive": {"amplitude": amplitude, "shape": shape},
            "controller_rate": RATE,
            "stations": [alone],
            "pace": pace or fastest(one),
        }
    )


def executed(plan: Plan) -> Run:
    """The run of a plan to its end, with its rigs."""
    with opened(plan, LIBRARY) as run:
        while not run.finished:
            run.advance(run.total)
    return run


def emulated(plan: Plan) -> Run:
    """The run of the plan on its models."""
    return completed(modelled(Model(plan)).plan)
