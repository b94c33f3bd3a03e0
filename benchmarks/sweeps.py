"""`python -m benchmarks.sweeps [POINTS] [TEMPLATE]`: a sweep through the queue beside the bare engine on the same cores.

The bare engine is one process for each core that calls `simulate` on the same plans. Both have the same niceness and take
turns for ROUNDS rounds. CPU times are those of all processes of the service, web and worker too.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from statistics import median
from typing import Any

from app.jobs.kind import Kind
from app.sweeps.job import SHARDS
from benchmarks.plans import LIBRARY
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.running.run import simulate
from rths_engine.running.warm import warm
from rths_engine.sweeps.design import read_design
from tests.browser.service import Service, running

ROUNDS = 1
POINTS = 1000
TEMPLATE = "two-storeys"  # 40 s at 1024 Hz, two MR dampers
ORDINARY = 30  # tests of the comparison with ordinary runs
POLL_S = 0.25  # as a page or a script that waits
TICK = os.sysconf("SC_CLK_TCK")


def definition(points: int, template: str) -> dict[str, Any]:
    """Estimated delay against damping, `points` combinations; none of them trips."""
    return {
        "name": "Benchmark",
        "plan": template,
        "method": "latin_hypercube",
        "samples": points,
        "fields": [
            {"path": "stations.*.compensator.alpha_es", "distribution": {"kind": "uniform", "lower": 25, "upper": 35}},
            {"path": "structure.damping_ratio", "distribution": {"kind": "uniform", "lower": 0.01, "upper": 0.05}},
        ],
    }


def prepare(niceness: int) -> None:
    """Make a process of the bare engine ready."""
    os.nice(niceness)
    os.environ.update({"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    warm()


def simulated(plans: list[Plan]) -> float:
    """CPU time (s) of the bare engine for some plans."""
    start = time.process_time()
    for plan in plans:
        simulate(plan, LIBRARY)
    return time.process_time() - start


def bare(pool: ProcessPoolExecutor, plans: list[Plan], cores: int) -> tuple[float, float]:
    """Wall-clock and CPU time (s) of the bare engine."""
    start = time.perf_counter()
    cpu = sum(pool.map(simulated, [plans[core::cores] for core in range(cores)]))
    return time.perf_counter() - start, cpu


def swept(service: Service, data: dict[str, Any]) -> dict[str, float]:
    """Time to queue, wall-clock time from the request to the last result, and CPU time of the service (s)."""
    before, start = _cpu(service.pid), time.perf_counter()
    sweep = service.post("/sweeps", {"sweep": data})
    queued = time.perf_counter() - start
    while (ended := service.get(f"/sweeps/{sweep['id']}"))["state"] in ("queued", "running"):
        time.sleep(POLL_S)
    whole = time.perf_counter() - start
    assert ended["completed"] == ended["points"], ended
    return {"queued_s": queued, "whole_s": whole, "cpu_s": _cpu(service.pid) - before}


def ordinary(service: Service, plans: list[dict[str, Any]]) -> float:
    """Wall-clock time (s) of ordinary runs, queued in one request, each with its recording."""
    start = time.perf_counter()
    runs = service.post("/runs", {"plans": plans})["runs"]
    for run in runs:
        service.wait(run["id"], within_s=600)
    return time.perf_counter() - start


def sweeps(points: int = POINTS, template: str = TEMPLATE) -> dict[str, Any]:
    """Rates and times of all rounds, and their medians."""
    cores, kind = os.cpu_count() or 1, SHARDS
    data = definition(points, template)
    design = read_design(data)
    plans = [read_plan(design.data(point)) for point in range(points)]
    rounds = []
    with tempfile.TemporaryDirectory() as folder, running(Path(folder)) as service:
        swept(service, definition(4 * cores, template))  # starts the processes, which are then kept
        with ProcessPoolExecutor(cores, get_context("spawn"), initializer=prepare, initargs=(_niceness(kind),)) as pool:
            bare(pool, plans[: 2 * cores], cores)
            for _ in range(ROUNDS):
                wall, cpu = bare(pool, plans, cores)
                found = swept(service, data)
                one = {"bare_s": wall, "bare_cpu_s": cpu, **found}
                rounds.append(one | {"ratio": wall / found["whole_s"], "ratio_by_cpu_time": cpu / found["cpu_s"]})
                print(json.dumps(rounds[-1]), file=sys.stderr, flush=True)
        runs = ordinary(service, [design.data(point) for point in range(min(points, ORDINARY))])
    return {
        "sweep": {name: round(median(one[name] for one in rounds), 4) for name in rounds[0]},
        "sweep_rounds": rounds,
        "sweep_points": points,
        "sweep_template": template,
        "ordinary_runs": min(points, ORDINARY),
        "ordinary_runs_s": round(runs, 3),
    }


def _niceness(kind: Kind[Any, Any, Any]) -> int:
    return kind.niceness


def _cpu(pid: int) -> float:
    """CPU time (s) of a process and of its present descendants."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    children = [int(one) for thread in Path(f"/proc/{pid}/task").glob("*/children") for one in thread.read_text().split()]
    return (int(fields[11]) + int(fields[12])) / TICK + sum(_cpu(child) for child in children)


if __name__ == "__main__":
    points, *rest = [*sys.argv[1:], str(POINTS)][:1]
    print(json.dumps(sweeps(int(points), *sys.argv[2:3]), indent=2))
