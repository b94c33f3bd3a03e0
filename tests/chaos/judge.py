"""What must be true after chaos: none lost, none twice, none stuck, every file whole, every run with a reason."""

from __future__ import annotations

import hashlib
from collections import Counter
from pathlib import Path
from typing import Any

from tests.chaos.load import ENDED, SWEEP_POINTS, Load


def judged(load: Load, data: Path) -> tuple[list[str], dict[str, int]]:
    """The broken promises, and the runs by state and reason."""
    runs = load.runs()
    wrong = [*_counted(load.names, runs), *_stored(runs, data), *_ended_once(load, runs), *_swept(load)]
    return wrong, dict(Counter(f"{run['state']}: {_short(run)}" for run in runs))


def _counted(names: list[str], runs: list[dict[str, Any]]) -> list[str]:
    stored = Counter(run["name"] for run in runs)
    lost = [f"{name} is lost" for name in names if not stored[name]]
    twice = [f"{name} is stored {count} times" for name, count in stored.items() if count > 1]
    return [*lost, *twice]


def _stored(runs: list[dict[str, Any]], data: Path) -> list[str]:
    wrong, known = [], set()
    for run in runs:
        if run["state"] not in ENDED:
            wrong.append(f"run {run['number']} has not ended: it is {run['state']}, attempt {run['attempt']}")
        elif not run["reason"]:
            wrong.append(f"run {run['number']} ended without a reason")
        kept = run["recording"]
        if run["state"] in ("completed", "tripped") and not kept:
            wrong.append(f"run {run['number']} has no recording")
        if not kept:
            continue
        path = data / "recordings" / f"{run['id']}.h5"
        known.add(path.name)
        if not path.exists():
            wrong.append(f"the recording of run {run['number']} is missing")
        elif hashlib.sha256(path.read_bytes()).hexdigest() != kept["sha256"] or path.stat().st_size != kept["size"]:
            wrong.append(f"the recording of run {run['number']} does not match its checksum")
    others = {path.name for path in (data / "recordings").iterdir()} - known
    return [*wrong, *(f"the file {name} belongs to no run" for name in sorted(others))]


def _ended_once(load: Load, runs: list[dict[str, Any]]) -> list[str]:
    """Every run has one event of its end."""
    wrong = []
    for run in runs:
        events = load.get(f"/events?run_id={run['id']}&limit=500")["events"]
        ends = sum(event["kind"] in ENDED for event in events)
        if run["state"] in ENDED and ends != 1:
            wrong.append(f"run {run['number']} has {ends} ends")
    return wrong


def _swept(load: Load) -> list[str]:
    sweep = load.get(f"/sweeps/{load.sweep}")
    points = load.get(f"/sweeps/{load.sweep}/results")["values"]["point"]
    if sweep["state"] != "completed" or sorted(points) != list(range(1, SWEEP_POINTS + 1)):
        return [f"the sweep is {sweep['state']} with {len(points)} results for {len(set(points))} of {SWEEP_POINTS} points"]
    return []


def _short(run: dict[str, Any]) -> str:
    reason = (run["reason"] or "").replace(run["id"], "ID")
    return reason if run["state"] != "tripped" else "a limit"
