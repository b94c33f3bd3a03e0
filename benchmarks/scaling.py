"""Time of a step against degrees of freedom, beside the time to read the tables of a step once.

Each time is the fastest of several rounds, because other work on the machine uses the caches and only adds time.
"""

from __future__ import annotations

from collections.abc import Iterator
from time import perf_counter, process_time
from typing import Any

import numpy as np

from benchmarks.one_frame import touched
from benchmarks.plans import LIBRARY, STEP, alone, frame, shear_building
from rths_engine.foundation.kernel import compiled
from rths_engine.parts.structures.moment_frame import MomentFrame
from rths_engine.running.run import Run

ROUNDS = 15
FRAMES = ((1, 1), (1, 3), (2, 4), (4, 5), (8, 4), (10, 7), (20, 7))


@compiled
def _sum_all(table: np.ndarray, repeats: int) -> np.int64:
    total = np.int64(0)
    for again in range(repeats):
        for k in range(table.size):  # in vectors, unlike a loop over the values
            total += table[k]
        table[again % table.size] += 1  # otherwise the compiler reads the table once
    return total


def read_seconds(size: int) -> float:
    """Seconds to read a table of `size` bytes again: from the smallest cache that holds it, or from memory."""
    table, repeats = np.ones(max(size // 8, 8), dtype=np.int64), max(1, 4_000_000 // size)
    _sum_all(table, repeats)
    seconds = []
    for _ in range(9):
        start = process_time()
        _sum_all(table, repeats)
        seconds.append((process_time() - start) / repeats)
    return min(seconds)


def structures() -> Iterator[tuple[str, dict[str, Any]]]:
    """Structures of increasing size, each with its kind."""
    yield "shear building", shear_building(10)
    for inelastic in (False, True):
        for storeys, bays in FRAMES:
            yield "inelastic frame" if inelastic else "elastic frame", frame(storeys, bays, inelastic)


def step_by_dof() -> dict[str, list[dict[str, Any]]]:
    """Time of a step and of the set-up of a run, by degrees of freedom."""
    rows = []
    for kind, structure in structures():
        start = perf_counter()
        plan = alone(structure, duration=1.0)
        run = Run(plan, LIBRARY)
        built = perf_counter() - start
        setup = run._setup
        dof = plan.structure.model().size if isinstance(plan.structure, MomentFrame) else setup.loads.shape[1]
        size = touched(run)
        steps = max(100, min(5_000, 200_000 // dof))
        long = alone(structure, duration=steps * STEP)
        seconds = []
        for _ in range(ROUNDS):
            run = Run(long, LIBRARY)
            start = process_time()
            run.advance(run.total)
            seconds.append((process_time() - start) / run.total)
        rows.append(
            {
                "structure": kind,
                "dof": dof,
                "equations": setup.loads.shape[1],  # fewer where an elastic frame is condensed
                "step_us": min(seconds) * 1e6,
                "read_us": read_seconds(size) * 1e6,
                "table_kb": size / 1024,
                "set_up_s": built,
            }
        )
    return {"step_us_by_dof": rows}
