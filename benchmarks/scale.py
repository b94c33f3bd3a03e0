"""`python -m benchmarks.scale [--workers 100] [--runs 1000000]`: what limits many workers and many runs.

It follows from intervals in the code, and from measured costs and sizes, each with its source. See docs/scale.md.
"""

from __future__ import annotations

import argparse

from app.diagnoses.job import DIAGNOSES
from app.runs.job import RUNS
from app.sweeps.job import SHARDS
from app.worker.executor import PROGRESS_S
from app.worker.link import SHORTEST_GAP_S
from app.worker.main import LOOK_S

KINDS = (RUNS, DIAGNOSES, SHARDS)
RUN_S = 0.18  # of a core for a run of 40 s with two dampers: docs/benchmarks.md, "A sweep beside the bare engine"
POINT_S = 0.110  # the same for a point of a sweep: 55.3 s for 1000 points on two busy cores
WRITES_A_RUN = 4  # submitted, claimed, started, ended
SQLITE_WRITES = 1353  # transactions a second of one queue on SQLite: docs/decisions/0003
RECORDING_MB = 7.9  # 40 960 samples of 30 channels, compressed
ROW_KB = 9.4  # database of 100 000 runs: benchmarks.run_table, 941 MB
POINT_ROW_B = 360  # measures of a point of a sweep: 36 MB for 100 000 points, docs/decisions/0042
SKIP_US = 0.045  # an entry of an index that a page far down skips, SQLite: docs/decisions/0073


def figures(workers: int, runs: int) -> list[tuple[str, float, str]]:
    """What `workers` workers, each with one test at a time, ask of the service, and what `runs` runs leave."""
    polls = sum(1 / kind.polling_s for kind in KINDS)
    return [
        ("questions of waiting workers to the queue", workers * polls, "a second"),
        ("heartbeats", workers / LOOK_S, "a second"),
        ("looks for a cancel of running tests", workers / RUNS.polling_s, "a second"),
        ("writes of progress of running tests", workers / PROGRESS_S, "a second"),
        ("frames to the web, at most", workers / SHORTEST_GAP_S, "a second"),
        ("runs that end", workers / RUN_S, "a second"),
        ("writes of these runs", WRITES_A_RUN * workers / RUN_S, "a second"),
        ("workers that keep SQLite's writer busy", SQLITE_WRITES * RUN_S / WRITES_A_RUN, "workers"),
        ("points of sweeps that end", workers / POINT_S, "a second"),
        ("time for the runs", runs * RUN_S / workers / 3600, "h"),
        ("time for as many points", runs * POINT_S / workers / 3600, "h"),
        ("recordings", runs * RECORDING_MB / 1e6, "TB"),
        ("recordings written", workers / RUN_S * RECORDING_MB, "MB a second"),
        ("rows of runs", runs * ROW_KB / 1e6, "GB"),
        ("rows of as many points", runs * POINT_ROW_B / 1e9, "GB"),
        ("page in the middle of the list of runs", runs / 2 * SKIP_US / 1e3, "ms"),
    ]


def main() -> None:
    """Compute and print."""
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("--workers", type=int, default=100)
    given.add_argument("--runs", type=int, default=1_000_000)
    asked = given.parse_args()
    print(f"{asked.workers} workers, {asked.runs} runs")
    for label, value, unit in figures(asked.workers, asked.runs):
        print(f"{label:48s} {value:12,.1f} {unit}")


if __name__ == "__main__":
    main()
