"""CPU time per step of the paper's frame in this engine and in OpenSees, measured in turns.

CPU time depends little on other work on the machine.
"""

from __future__ import annotations

from statistics import median
from time import process_time
from typing import Any

import numpy as np

from benchmarks.plans import LIBRARY, STEP, alone, frame, ground
from rths_engine.parts.structures.moment_frame import MomentFrame
from rths_engine.planning.plan import Plan
from rths_engine.running.run import Run
from tests.opensees import peer

ROUNDS = 7
SYSTEMS = ("BandGeneral", "ProfileSPD", "SparseGeneral")
DURATION = 30.0


def our_step(plan: Plan, repeats: int = 5) -> tuple[float, np.ndarray]:
    """Seconds per step of whole runs, and the last displacements of the floors (m)."""
    runs = [Run(plan, LIBRARY) for _ in range(repeats)]
    start = process_time()
    for run in runs:
        run.advance(run.total)
    return (process_time() - start) / sum(run.total for run in runs), runs[0].history[-1, 0]


def frame_ratios() -> dict[str, Any]:
    """Time of a step of the frame in both programs, and their ratio, elastic and inelastic.

    OpenSees uses operator splitting (AlphaOS), factored once, with the fastest of its equation systems. Without OpenSees the
    result has the times of this engine only.
    """
    results: dict[str, Any] = {}
    for name, inelastic in (("elastic", False), ("inelastic", True)):
        plan = alone(frame(2, 4, inelastic), DURATION)
        assert isinstance(plan.structure, MomentFrame)
        acceleration = ground(plan)
        our_step(plan)
        ours: list[float] = []
        theirs: dict[str, list[float]] = {system: [] for system in SYSTEMS}
        for _ in range(ROUNDS):
            seconds, last = our_step(plan)
            ours.append(seconds)
            for system in [] if peer.missing() else SYSTEMS:
                more = {"acceleration": acceleration, "dt": STEP, "scheme": "alpha_os", "system": system}
                answer = peer.ask("timing", plan.structure, inelastic=inelastic, **more)
                if answer["failed"] or not np.allclose(answer["last"], last, rtol=0.02, atol=1e-4):
                    raise RuntimeError(f"OpenSees ({system}) ends at {answer['last']}, the engine at {last}: not the same test")
                theirs[system].append(answer["seconds"] / answer["steps"])
        results[f"frame_{name}_step_us"] = median(ours) * 1e6
        if theirs[SYSTEMS[0]]:
            steps = {system: median(seconds) for system, seconds in theirs.items()}
            fastest = min(steps, key=lambda system: steps[system])
            results[f"opensees_{name}_step_us"] = steps[fastest] * 1e6
            results[f"opensees_{name}_system"] = fastest
            ratios = [one / other for one, other in zip(theirs[fastest], ours, strict=True)]
            results[f"frame_{name}_ratio"] = median(ratios)
            results[f"frame_{name}_ratio_range"] = [min(ratios), max(ratios)]
    return results
