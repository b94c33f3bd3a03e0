"""One chaos run: faults one after another while tests run, and then the judgement."""

from __future__ import annotations

import os
import random
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import httpx

from tests.chaos.faults import FAULTS, revive
from tests.chaos.judge import ENDED, judged
from tests.chaos.load import Load
from tests.chaos.world import World

STUCK_S = 60.0  # without any progress after the last fault
LONGEST_GAP_S = 60.0  # between two faults
STARTED_WITHIN_S = 240.0


@dataclass
class Report:
    """The figures of one chaos run. `wrong` lists the broken promises."""

    store: str
    seed: int
    runs: int
    faults: Counter[str] = field(default_factory=Counter)
    revived: int = 0
    refused: int = 0
    unclear: int = 0
    resumed: int = 0
    load: float = 0.0
    states: dict[str, int] = field(default_factory=dict)
    wrong: list[str] = field(default_factory=list)
    longest_wait_s: float = 0.0
    drained_s: float = 0.0
    took_s: float = 0.0
    notes: list[str] = field(default_factory=list)

    def text(self) -> str:
        faults = [f"  {name.replace('_', ' ')}: {count}" for name, count in sorted(self.faults.items())]
        states = [f"  {count} {state}" for state, count in sorted(self.states.items(), key=lambda one: -one[1])]
        wrong = [f"  {one}" for one in self.wrong[:40]] or ["  none"]
        return "\n".join(
            [
                f"Chaos on {self.store}, seed {self.seed}: {self.runs} runs and a sweep in {self.took_s:.0f} s,"
                f" load of the machine {self.load:.1f}",
                *(f"Note: {note}" for note in self.notes),
                f"Faults: {self.faults.total()}",
                *faults,
                f"Processes that ended by themselves and were started again: {self.revived}",
                f"Requests answered 503 or 507: {self.refused}; without an answer: {self.unclear}",
                f"Times that the sweep had failed and was resumed: {self.resumed}",
                "Runs by state and reason:",
                *states,
                f"After the last fault: all ended within {self.drained_s:.0f} s, longest time without progress"
                f" {self.longest_wait_s:.0f} s (at most {STUCK_S:.0f} s)",
                f"Broken promises: {len(self.wrong)}",
                *wrong,
            ]
        )


def chaos(store: str, seed: int, runs: int, faults: int, log: Path) -> Report:
    """Execute `runs` short tests and a sweep on a store while `faults` faults happen; `log` takes what the processes say."""
    report, draw, begun = Report(store, seed, runs), random.Random(seed), time.monotonic()
    world = World(store, log)
    try:
        if not world.small_disk:
            report.notes.append("the disk was not filled: only root may mount a small one")
        if world.clock_library is None:
            report.notes.append("no clock jumped: there is no C compiler")
        load = Load(world.url, runs, random.Random(seed + 1))
        _start(world)
        load.start()
        progress = Progress(world.url, load)
        bag: list[int] = []
        while report.faults.total() < faults or not load.done:
            _wait(world, report, progress, draw.randint(1, max(2, 2 * runs // max(faults, 1))))
            bag = bag or draw.sample(range(len(FAULTS)), len(FAULTS))
            fault = FAULTS[bag.pop()]
            with log.open("a") as told:
                told.write(f"--- {fault.__name__}\n")
            fault(world, draw)
            report.faults[fault.__name__] += 1
        _drain(world, report, progress)
        report.wrong, report.states = judged(load, world.data)
        report.refused, report.unclear = load.errors, load.unclear
        if report.longest_wait_s > STUCK_S:
            report.wrong.append(f"nothing went on for {report.longest_wait_s:.0f} s after the last fault")
    finally:
        world.close()
    report.took_s, report.load = time.monotonic() - begun, os.getloadavg()[2]
    return report


class Progress:
    """How many runs have ended, how many points of the sweep are done, and how many runs there are."""

    def __init__(self, url: str, load: Load):
        self.http, self.load = httpx.Client(base_url=f"{url}/api/v1", timeout=10), load
        self.last = (0, 0)

    def look(self) -> tuple[int, int]:
        """Ended runs and done points; the last known while the service does not answer."""
        try:
            ended = self.http.get("/runs", params={"limit": 1, "state": sorted(ENDED)}).raise_for_status().json()["total"]
            done = self.http.get(f"/sweeps/{self.load.sweep}").raise_for_status().json()["done"] if self.load.sweep else 0
            self.last = ended, done
        except httpx.HTTPError:
            pass
        return self.last


def _start(world: World) -> None:
    world.start_web()
    deadline = time.monotonic() + STARTED_WITHIN_S
    while True:
        try:
            if httpx.get(f"{world.url}/api/v1/queue", timeout=5).status_code == 200:
                break
        except httpx.HTTPError:
            pass
        assert time.monotonic() < deadline, "the service did not start"
        time.sleep(0.2)
    for name in world.networks:
        world.start_worker(name)


def _wait(world: World, report: Report, progress: Progress, more: int) -> None:
    """Wait until `more` runs have ended since, or LONGEST_GAP_S."""
    before, begun = progress.look()[0], time.monotonic()
    while progress.look()[0] < before + more and time.monotonic() - begun < LONGEST_GAP_S:
        report.revived += revive(world)
        time.sleep(0.2)


def _sweeping(report: Report, load: Load) -> bool:
    """Whether the sweep goes on. One that has failed is resumed, as a person does."""
    state = load.get(f"/sweeps/{load.sweep}")["state"]
    if state == "failed":
        report.resumed += 1
        load.post(f"/sweeps/{load.sweep}/resume")
        return True
    return bool(state != "completed")


def _drain(world: World, report: Report, progress: Progress) -> None:
    """Wait after the last fault until everything has ended, or nothing goes on for twice STUCK_S."""
    begun = moved = time.monotonic()
    last = progress.look()
    while time.monotonic() - moved < 2 * STUCK_S:
        report.revived += revive(world)
        now, seen = time.monotonic(), progress.look()
        if seen != last:
            report.longest_wait_s = max(report.longest_wait_s, now - moved)
            last, moved = seen, now
        if seen[0] >= report.runs and not _sweeping(report, progress.load):
            report.drained_s = now - begun
            time.sleep(2)  # the last files go to their places, temporary files go
            return
        time.sleep(0.3)
    report.longest_wait_s = time.monotonic() - moved
    report.drained_s = time.monotonic() - begun
