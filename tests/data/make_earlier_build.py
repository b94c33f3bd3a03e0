"""Fill a data folder with an installed build and pack it: `python tests/data/make_earlier_build.py RTHS ARCHIVE`.

RTHS is the `rths` command of the build whose files are to be kept, ARCHIVE the `.tar.xz` to write.
"""

from __future__ import annotations

import json
import math
import socket
import sqlite3
import subprocess
import sys
import tarfile
import tempfile
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import httpx

BY = {"submitted_by": "Ana Ruiz"}
PATIENCE_S = 300
DAMPER: dict[str, Any] = {
    "name": "Damper",
    "compensator": {"kind": "none"},
    "actuator": {"kind": "first_order_delay", "alpha": 4},
    "specimen": {"kind": "linear", "stiffness": 2.0e6, "damping": 8.0e5},
    "noise": {"displacement": 1e-5, "force": 1500.0},
}
SPECIMEN: dict[str, Any] = {
    "test": "specimen",
    "name": "Damper with play",
    "controller_rate": 128.0,
    "seed": 3,
    "drive": {
        "amplitude": 0.03,
        "shape": {"kind": "band_noise", "low_frequency": 0.2, "high_frequency": 2.0, "duration": 6.0},
    },
    "stations": [DAMPER],
}
PLAYED = {**SPECIMEN, "stations": [{**DAMPER, "specimen_physics": [{"kind": "backlash", "gap": 0.002}]}]}


def fill(api: httpx.Client) -> None:
    """One row of each kind, by REST."""
    hybrid = _hybrid(api)
    _run(api, {**hybrid, "name": "Completed"})
    first, *others = hybrid["stations"]
    low = {**first, "limits": {**first["limits"], "displacement": 2e-5}}
    _run(api, {**hybrid, "name": "Tripped", "stations": [low, *others]})
    paced = {**hybrid, "name": "Cancelled", "duration": 20.0, "pace": {"kind": "real_time", "factor": 0.3}}
    slow = _post(api, "/runs", {"plan": paced, **BY})
    cancelled = slow["runs"][0]["id"]
    _until(api, f"/runs/{cancelled}", "running")
    time.sleep(1)
    _post(api, f"/runs/{cancelled}/cancel", {"by": "Ana Ruiz"})
    _until(api, f"/runs/{cancelled}", "cancelled")
    played = _run(api, PLAYED)
    _import(api)
    asked = {"recording": {"run": played}, "plan": SPECIMEN, "name": "Worn damper", **BY}
    diagnosis = _post(api, "/diagnoses", asked)["id"]
    verdict = _until(api, f"/diagnoses/{diagnosis}", "completed")["verdict"]
    print("verdict:", verdict["verdict"], [one["id"] for one in verdict["effects"]])
    simulations = _post(api, f"/diagnoses/{diagnosis}/simulations", {"by": "Ana Ruiz"})
    for one in simulations.values():
        _until(api, f"/runs/{one['id']}", "completed")


def queue(api: httpx.Client) -> None:
    """A test and a diagnosis that wait; no worker is there to take them."""
    _post(api, "/runs", {"plan": {**_hybrid(api), "name": "Queued"}, **BY})
    played = next(run for run in _get(api, "/runs")["runs"] if run["name"] == PLAYED["name"])
    _post(api, "/diagnoses", {"recording": {"run": played["id"]}, "plan": SPECIMEN, "name": "Queued", **BY})


def _hybrid(api: httpx.Client) -> dict[str, Any]:
    """Simulation 4 of Table III, the start of it, in coarse steps: small files."""
    plan = _get(api, "/templates/table3-04")["plan"]
    rate = 512.0
    integrator = {**plan["integrator"], "dt": plan["integrator"]["substeps"] / rate}
    return {**plan, "controller_rate": rate, "integrator": integrator, "duration": 0.6}


def _import(api: httpx.Client) -> None:
    rows = ["Time (s),Disp (mm),Force (kN)"]
    for step in range(300):
        t = step / 100
        x, v = 25 * math.sin(2 * math.pi * t), 50 * math.pi * math.cos(2 * math.pi * t)
        rows.append(f"{t:.2f},{x:.4f},{0.4 * x + 0.1 * v:.4f}")
    answer = api.post("/recordings/files", files={"file": ("sine.csv", "\n".join(rows).encode())}).raise_for_status().json()
    asked = {"file": answer["sha256"], "mapping": answer["guess"], "name": "Sine test", "imported_by": "Ana Ruiz"}
    _post(api, "/recordings", asked)


def _run(api: httpx.Client, plan: dict[str, Any]) -> str:
    run: str = _post(api, "/runs", {"plan": plan, **BY})["runs"][0]["id"]
    _until(api, f"/runs/{run}", "completed", "tripped")
    return run


def _until(api: httpx.Client, path: str, *states: str) -> Any:
    deadline = time.monotonic() + PATIENCE_S
    while (found := _get(api, path))["state"] not in states:
        assert time.monotonic() < deadline and found["state"] != "failed", found
        time.sleep(0.1)
    return found


def _get(api: httpx.Client, path: str) -> Any:
    return api.get(path).raise_for_status().json()


def _post(api: httpx.Client, path: str, body: Any) -> Any:
    answer = api.post(path, json=body)
    assert answer.is_success, answer.text
    return answer.json()


@contextmanager
def _served(rths: str, data: Path, *options: str) -> Iterator[httpx.Client]:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    command = [rths, "serve", "--data", str(data), "--port", str(port), *options]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    api = httpx.Client(base_url=f"http://127.0.0.1:{port}/api/v1", timeout=60)
    try:
        deadline = time.monotonic() + PATIENCE_S
        while True:
            try:
                _get(api, "/queue")
                break
            except httpx.HTTPError:
                assert process.poll() is None and time.monotonic() < deadline, "the service did not start"
                time.sleep(0.2)
        yield api
    finally:
        api.close()
        process.terminate()
        process.wait(30)


def _without_machine(database: Path) -> None:
    """Take this machine's names out: workers' heartbeats and the queue's records of work that has ended."""
    with closing(sqlite3.connect(database)) as connection:
        connection.execute("pragma foreign_keys=on")
        connection.execute("delete from worker_heartbeat")
        connection.execute("update run set worker = 'worker-1' where worker is not null")
        connection.execute("update diagnosis set worker = 'worker-1' where worker is not null")
        connection.execute("delete from workflow_status where status in ('SUCCESS', 'ERROR', 'CANCELLED')")
        connection.commit()
        connection.execute("pragma journal_mode=delete")
        connection.execute("vacuum")


def _nameless(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    return entry


def main(rths: str, archive: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / "rths"
        with _served(rths, data) as api:
            fill(api)
        with _served(rths, data, "--no-worker") as api:
            queue(api)
            print(json.dumps([(run["name"], run["state"]) for run in _get(api, "/runs")["runs"]]))
        _without_machine(data / "rths.sqlite")
        (data / "worker-token").unlink(missing_ok=True)
        with tarfile.open(archive, "w:xz") as packed:
            packed.add(data, "rths", filter=_nameless)


if __name__ == "__main__":
    main(*sys.argv[1:])
