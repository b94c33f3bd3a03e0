"""`python benchmarks/one_frame.py FRAMES`: time of a step of inelastic frames in the build on PYTHONPATH, as JSON.

FRAMES is a JSON list of pairs of storeys and bays. `frame_beside` starts this script with several builds.
"""

from __future__ import annotations

import json
import sys
from time import process_time
from typing import Any

import numpy as np

from benchmarks.plans import LIBRARY, STEP, alone, frame
from rths_engine.parts.structures.moment_frame import MomentFrame
from rths_engine.running.run import Run

DURATION = 30.0
RUNS_S = 0.5  # processor time of the runs of one frame

# what an integration step reads and writes, where a build has it: tables of the run, and its state
TABLES = ("factor", "damping", "elastic", "members", "points")
STATE = ("x", "v", "plastic", "points")


def touched(run: Any) -> int:
    """Bytes that an integration step without yielding touches. L is read twice; the effects of one point on another are not."""
    setup, state = run._setup, run._state
    parts = [getattr(setup, name, ()) for name in TABLES] + [getattr(state, name, ()) for name in STATE]
    points = getattr(setup, "points", None)
    unread = 0 if points is None else points.bent.nbytes + points.pushed.nbytes
    return int(sum(_bytes(part) for part in parts) + _bytes((setup.factor.value, setup.factor.row)) - unread)


def _bytes(part: Any) -> int:
    if isinstance(part, tuple):
        return sum(_bytes(one) for one in part)
    return int(part.nbytes) if isinstance(part, np.ndarray) else 0


def measured(storeys: int, bays: int) -> dict[str, Any]:
    """The fastest run of one frame: microseconds of processor time for a step, and what it computed."""
    plan = alone(frame(storeys, bays, inelastic=True), DURATION)
    assert isinstance(plan.structure, MomentFrame)
    run = Run(plan, LIBRARY)
    run.advance(run.total)
    seconds: list[float] = []
    while sum(seconds) < RUNS_S:
        again = Run(plan, LIBRARY)
        start = process_time()
        again.advance(again.total)
        seconds.append(process_time() - start)
    return {
        "dof": plan.structure.model().size,
        "equations": len(run._state.x),
        "step_us": min(seconds) / run.total * 1e6,
        "touched_bytes": touched(run),
        "last_m": run.history[-1, 0].tolist(),
        "step_s": STEP,
    }


if __name__ == "__main__":
    print(json.dumps([measured(*size) for size in json.loads(sys.argv[1])]))
