"""`python -m benchmarks.crowd [--viewers 100] [--clients 20] [--seconds 30] [--runs 10000]`: a crowd before one service.

A scripted worker tells a run in real time, 50 frames a second with 24 channels. Viewers in a process of their own watch it, and
clients in another submit short tests, which the service's own worker executes, and wait for them. Measured are

- the age of the oldest bucket of a frame when it reaches a viewer, from the moment at which the worker sent it;
- the longest gap between two frames of a viewer;
- the time of a submission;
- the memory (RSS) of the web process: while the scripted worker tells of `--runs` further runs, and while the service's own
  worker executes tests.

The ages include waiting for a core in the processes of the benchmark itself: all of them share the machine.
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
import time
import uuid
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from benchmarks.control_room import control_room
from benchmarks.crowd_processes import EVERY_S, Worker, at, submit, view
from tests.browser.service import Service

TOKEN = "token-of-the-benchmark"  # of no other service
PARTS = 10  # looks at the memory


def rss(pid: int) -> float:
    """Resident memory of a process (MB)."""
    fields = dict(line.split(":", 1) for line in Path(f"/proc/{pid}/status").read_text().splitlines())
    return int(fields["VmRSS"].split()[0]) / 1024


def cpu_s(pid: int) -> float:
    """Processor time of a process without its children (s)."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def watched(service: Service, viewers: int, clients: int, seconds: float) -> dict[str, Any]:
    """Viewers and clients at the same time."""
    context = get_context("spawn")
    frames, run_id = int(seconds / EVERY_S), str(uuid.uuid4())
    sent, ready = context.Array("d", frames, lock=False), context.Event()
    seen, submitted = context.Queue(), context.Queue()
    worker = Worker(service.url, TOKEN)
    worker.begin(run_id, frames)
    time.sleep(0.5)
    watching = context.Process(target=view, args=(service.url, run_id, viewers, sent, ready, seen))
    watching.start()
    ready.wait(120)
    plan = service.plan(duration=1.0)
    started = context.Event()
    args = (service.url, plan, clients, seconds, 10**6, started, submitted)
    submitting = context.Process(target=submit, args=args)
    submitting.start()
    started.wait(120)
    begun, cpu = time.monotonic(), cpu_s(service.pid)
    worker.tell(run_id, sent, frames)
    told_s, cpu = time.monotonic() - begun, cpu_s(service.pid) - cpu
    found, times = seen.get(timeout=300), submitted.get(timeout=300)
    watching.join()
    submitting.join()
    worker.socket.close()
    ages = [age for each, _ in found for age in each]
    return {
        "viewers": viewers,
        "frames": len(ages),
        "frames_each_s": len(ages) / viewers / told_s,
        "age_p50_ms": 1e3 * at(ages, 0.5),
        "age_p95_ms": 1e3 * at(ages, 0.95),
        "age_largest_ms": 1e3 * max(ages),
        "longest_gap_ms": 1e3 * max(gap for _, gaps in found for gap in gaps),
        "viewers_with_a_gap_over_1_s": sum(max(gaps) > 1 for _, gaps in found),
        "submitted": len(times),
        "submit_p50_ms": 1e3 * at(times, 0.5),
        "submit_p95_ms": 1e3 * at(times, 0.95),
        "seconds": told_s,
        "web_cpu_share": cpu / told_s,
        "web_cpu_ms_a_frame": 1e3 * cpu / len(ages),
    }


def remembered(service: Service, runs: int) -> dict[str, Any]:
    """Memory of the web process while runs begin and end; the first tenth warms up."""
    worker, memory = Worker(service.url, TOKEN), []
    for _ in range(PARTS):
        for _ in range(runs // PARTS):
            worker.tell_short(str(uuid.uuid4()))
        service.get("/queue")  # after the frames: the service has taken most of them
        memory.append(rss(service.pid))
    worker.socket.close()
    return {"told": runs, "rss_mb": memory, "growth": memory[-1] / memory[0] - 1}


def executed(service: Service, runs: int, seconds: float) -> dict[str, Any]:
    """Memory of the web process while short tests are submitted, executed and stored."""
    context = get_context("spawn")
    answers, plan = context.Queue(), service.plan(duration=0.3)
    begin = rss(service.pid)
    started = context.Event()
    submitting = context.Process(target=submit, args=(service.url, plan, 20, seconds, runs, started, answers))
    submitting.start()
    started.wait(120)
    memory = [begin]
    while submitting.is_alive():
        submitting.join(max(1.0, seconds / PARTS))
        memory.append(rss(service.pid))
        if not answers.empty():
            break
    count = len(answers.get(timeout=120))
    submitting.join()
    return {"executed": count, "rss_mb": memory, "growth": memory[-1] / memory[0] - 1}


def main() -> None:
    """Measure and print."""
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("--viewers", type=int, default=100)
    given.add_argument("--clients", type=int, default=20)
    given.add_argument("--seconds", type=float, default=30)
    given.add_argument("--runs", type=int, default=10_000, help="runs that the scripted worker tells")
    given.add_argument("--executed-seconds", type=float, default=60, help="time in which tests are executed")
    asked = given.parse_args()
    with tempfile.TemporaryDirectory() as folder, control_room(Path(folder) / "data", RTHS_WORKER_TOKEN=TOKEN) as service:
        service.warm_up()
        print(json.dumps({"load": os.getloadavg(), "cores": os.cpu_count()}), flush=True)
        for clients in (0, asked.clients):
            print(json.dumps({"clients": clients} | watched(service, asked.viewers, clients, asked.seconds)), flush=True)
        print(json.dumps(remembered(service, asked.runs)), flush=True)
        print(json.dumps(executed(service, asked.runs, asked.executed_seconds)), flush=True)


if __name__ == "__main__":
    main()
