"""The structures and plans of the benchmarks."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.running.run import Run

LIBRARY = MotionLibrary(None)
RECORD = "imperial-valley-1940-el-centro-ns"
STEP = 10 / 1024


def frame(storeys: int, bays: int, inelastic: bool) -> dict[str, Any]:
    """The paper's frame, extended to any number of storeys and bays."""
    columns, floors = ("W14x120",) * 2, ("W24x55", "W18x40")
    rows = [
        {
            "height": 4.57 if level == 0 else 3.96,
            "mass": 662.9e3 * bays / 4 / max(1, storeys / 2) ** 2,  # light enough for the lower columns to carry all storeys
            "column": columns[0],
            "beam": floors[level == storeys - 1],
            "brace_stiffness": 4e8 if bays > 1 else 0.0,
        }
        for level in range(storeys)
    ]
    return {"kind": "moment_frame", "bays": [9.15] * bays, "storeys": rows, "inelastic": inelastic}


def shear_building(storeys: int) -> dict[str, Any]:
    """A shear building of equal storeys."""
    return {"kind": "shear_building", "storeys": [{"mass": 2e5, "stiffness": 1e8}] * storeys}


def alone(structure: dict[str, Any], duration: float) -> Plan:
    """A plan of the structure under the record, without stations, with one substep per step."""
    return read_plan(
        {
            "motion": {"kind": "record", "record": RECORD},
            "structure": structure,
            "integrator": {"kind": "cr", "dt": STEP, "substeps": 1},
            "controller_rate": 1 / STEP,
            "duration": duration,
        }
    )


def ground(plan: Plan) -> list[float]:
    """The ground acceleration (m/s^2) of a run at its steps."""
    run = Run(plan, LIBRARY)
    record = run.motion
    times = np.arange(run.total + 1) * STEP
    shaken = np.interp(times, np.arange(len(record.acceleration)) * record.dt, record.acceleration, right=0.0)
    return [float(one) for one in shaken]
