"""Time of whole tests: warm, as a new process, and on two cores; and their memory."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from statistics import median
from time import perf_counter, process_time
from typing import Any

from benchmarks.plans import LIBRARY
from rths_engine.planning import templates
from rths_engine.planning.reading import plan_to_yaml
from rths_engine.recordings import run_file as recording
from rths_engine.running.run import Run, simulate
from rths_engine.running.warm import warm

ROUNDS = 7
TWO_STOREYS = "two-storeys"
BATCH = 30  # runs of each process in the two-core benchmark


def table3() -> dict[str, float]:
    """Time of a 40 s test of two storeys at 1024 Hz with all channels recorded: in memory, and with its file."""
    plan = templates.template(TWO_STOREYS)
    simulate(plan)
    runs, stored = [], []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(ROUNDS):
            start = perf_counter()
            result = simulate(plan)
            runs.append(perf_counter() - start)
            recording.save(Path(folder) / "test.h5", result)
            stored.append(perf_counter() - start)
    return {"table3_run_s": median(runs), "table3_run_and_store_s": median(stored)}


def cold() -> dict[str, float]:
    """Time of `rths run` of the same plan in a new process, with the engine compiled before."""
    rths = Path(sys.executable).with_name("rths")
    plan = plan_to_yaml(templates.template(TWO_STOREYS))
    seconds = []
    for _ in range(ROUNDS + 1):
        start = perf_counter()
        subprocess.run([rths, "run", "-", "--json"], input=plan, text=True, check=True, capture_output=True)
        seconds.append(perf_counter() - start)
    return {"cold_run_s": median(seconds[1:])}


def _batch(_: int) -> float:
    """CPU time (s) of BATCH runs."""
    plan = templates.template(TWO_STOREYS)
    start = process_time()
    for _ in range(BATCH):
        simulate(plan, LIBRARY)
    return process_time() - start


def two_cores() -> dict[str, float]:
    """Speed-up of two processes over one process.

    By wall time, which needs both cores free, and by CPU time, which shows only how much the processes slow each other down.
    """
    by_clock, by_cpu = [], []
    with ProcessPoolExecutor(2, get_context("spawn"), initializer=warm) as pool:
        list(pool.map(_batch, range(4)))
        for _ in range(ROUNDS):
            start = perf_counter()
            cpu = pool.submit(_batch, 0).result()
            one = perf_counter() - start
            start = perf_counter()
            both = list(pool.map(_batch, range(2)))
            by_clock.append(2 * one / (perf_counter() - start))
            by_cpu.append(2 * cpu / max(both))
    return {"two_core_speedup": median(by_clock), "two_core_speedup_by_cpu_time": median(by_cpu)}


def memory() -> dict[str, Any]:
    """Resident memory (kB) during a test of 1600 s; the recording is allocated and written once before the test."""
    run = Run(templates.template(TWO_STOREYS).model_copy(update={"duration": 1600.0}), LIBRARY)
    run.signals[:] = 0.0
    run.history[:] = 0.0
    resident = []
    for _ in range(4):
        run.advance(run.total // run.plan.substeps // 4)
        resident.append(_resident_kb())
    return {"memory_kb_at_quarters": resident, "memory_growth_kb": resident[-1] - resident[0]}


def _resident_kb() -> int:
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") // 1024
