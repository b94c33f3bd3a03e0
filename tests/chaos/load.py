"""What runs in a chaos run: many short tests under names of their own, and one sweep. Clients try again after an error.

Every CLIENT_EVERY-th test is driven by a client in a thread of its own.
"""

from __future__ import annotations

import random
import threading
import time
from functools import partial
from typing import Any

import httpx

from rths_engine.planning import templates
from tests.chaos import client

SWEEP_POINTS = 60
CLIENT_EVERY = 6
ENDED = frozenset({"completed", "tripped", "cancelled", "failed"})


def plan(**changes: Any) -> dict[str, Any]:
    """Simulation 4 of Table III with some of it changed."""
    return {**templates.template("two-storeys").as_dict(), **changes}


class Load:
    """Submits tests one after another in a thread, as fast as tests end: `ahead` of them wait or run at a time."""

    def __init__(self, url: str, runs: int, draw: random.Random, ahead: int = 12):
        self.url, self.count, self.draw, self.ahead = url, runs, draw, ahead
        self.names: list[str] = []
        self.sweep: str | None = None
        self.errors = 0
        self.unclear = 0
        self._thread = threading.Thread(target=self._submit_all, daemon=True, name="load")

    def start(self) -> None:
        self._thread.start()

    @property
    def done(self) -> bool:
        return not self._thread.is_alive()

    def runs(self) -> list[dict[str, Any]]:
        """All runs; asks until the service answers."""
        found: list[dict[str, Any]] = []
        while True:
            answer = self._ask("GET", f"/runs?limit=500&sort=number&order=asc&offset={len(found)}").json()
            found += answer["runs"]
            if len(found) >= answer["total"]:
                return found

    def get(self, path: str) -> Any:
        return self._ask("GET", path).json()

    def post(self, path: str) -> Any:
        return self._ask("POST", path, {}).json()

    def _submit_all(self) -> None:
        self.sweep = self._sweep()
        for number in range(self.count):
            while self._open() >= self.ahead:
                time.sleep(0.3)
            name = f"Test {number}"
            if number % CLIENT_EVERY == CLIENT_EVERY - 1:
                self._submit(client.plan(name))
                look, steps = partial(self._named, name), self.draw.randint(20, 150)
                threading.Thread(target=client.drive, args=(look, ENDED, steps), daemon=True, name=f"client of {name}").start()
            else:
                self._submit(self._short(name))
            self.names.append(name)

    def _open(self) -> int:
        queue = self.get("/queue")
        return int(queue["queued"]) + len(queue["running"])

    def _named(self, name: str) -> dict[str, Any]:
        """The run of this name."""
        return next(run for run in self.runs() if run["name"] == name)

    def _short(self, name: str) -> dict[str, Any]:
        quick = self.draw.random() < 0.5
        pace = {"kind": "fastest"} if quick else {"kind": "real_time", "factor": 4.0}
        return plan(name=name, duration=1.0 if quick else self.draw.uniform(2.0, 8.0), pace=pace)

    def _submit(self, data: dict[str, Any]) -> None:
        """Queue a test once: where an answer did not come, look before asking again."""
        while True:
            try:
                answer = httpx.post(f"{self.url}/api/v1/runs", json={"plan": data}, timeout=30)
                if answer.status_code == 201:
                    return
                self._refused(answer)
            except httpx.HTTPError:
                self.unclear += 1
                if any(run["name"] == data["name"] for run in self.runs()):
                    return
            time.sleep(0.3)

    def _sweep(self) -> str:
        distribution = {"kind": "uniform", "lower": 20, "upper": 40}
        fields = [{"path": "stations.*.compensator.alpha_es", "distribution": distribution}]
        sweep = {"plan": plan(duration=4.0), "method": "latin_hypercube", "samples": SWEEP_POINTS, "fields": fields}
        found: str = self._ask("POST", "/sweeps", {"sweep": sweep}).json()["id"]
        return found

    def _refused(self, answer: httpx.Response) -> None:
        """The same request may succeed later: the database is away (503), or the disk is full (507)."""
        assert answer.status_code in (503, 507), f"{answer.request.url}: {answer.status_code}: {answer.text}"
        self.errors += 1

    def _ask(self, method: str, path: str, data: Any = None) -> httpx.Response:
        while True:
            try:
                answer = httpx.request(method, f"{self.url}/api/v1{path}", json=data, timeout=30)
                if answer.status_code < 400:
                    return answer
                self._refused(answer)
            except httpx.HTTPError:
                pass
            time.sleep(0.3)
