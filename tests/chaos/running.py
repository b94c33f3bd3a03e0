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
from tests.chaos.judge import judged
from tests.chaos.load import ENDED, Load
from tests.chaos.world import World

STUCK_S = 60.0  # without any progress after a fault
LONGEST_GAP_S = 1.25 * STUCK_S  # between two faults, so that a longer stand-still is seen
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
    between_s: float = 0.0
    after_s: float = 0.0
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
                f"After the last fault all ended within {self.drained_s:.0f} s",
                f"Longest time without progress (at most {STUCK_S:.0f} s): {self.between_s:.0f} s between two faults,"
                f" {self.after_s:.0f} s after the last",
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
                told.write(f"--- {fault.__name__} after {progress.said()}\n")
            fault(world, draw)
            report.faults[fault.__name__] += 1
        report.between_s = progress.still_s
        _drain(world, report, progress)
        report.wrong, report.states = judged(load, world.data)
        report.refused, report.unclear = load.errors, load.unclear
        report.wrong += [
            f"nothing went on for {still:.0f} s {when}"
            for still, when in ((report.between_s, "between two faults"), (report.after_s, "after the last fault"))
            if still > STUCK_S
        ]
    finally:
        world.close()
    report.took_s, report.load = time.monotonic() - begun, os.getloadavg()[2]
    return report


class Progress:
    """How many runs have ended and how many points of the sweep are done, and how long nothing has changed."""

    def __init__(self, url: str, load: Load):
        self.http, self.load = httpx.Client(base_url=f"{url}/api/v1", timeout=10), load
        self.ended, self.points, self.sweeping = 0, 0, False
        self.fresh()

    def fresh(self) -> None:
        """Measure from now on."""
        self.moved, self.still_s = time.monotonic(), 0.0

    def fault_over(self) -> None:
        """A fault has ended: what stood still during it does not count."""
        self.moved = time.monotonic()

    def said(self) -> str:
        """What is known, for the log."""
        sweep = "a sweep that goes on" if self.sweeping else "no sweep that goes on"
        return f"{self.ended} tests and {self.points} points, {sweep}, still for {self.idle_s:.0f} s"

    @property
    def idle_s(self) -> float:
        return time.monotonic() - self.moved

    @property
    def over(self) -> bool:
        """Whether nothing is left that could go on."""
        return self.load.done and self.ended >= self.load.count and not self.sweeping

    def look(self) -> int:
        """Ended runs; the last known while the service does not answer."""
        before = self.ended, self.points
        try:
            self.ended = self.http.get("/runs", params={"limit": 1, "state": sorted(ENDED)}).raise_for_status().json()["total"]
            if self.load.sweep:
                sweep = self.http.get(f"/sweeps/{self.load.sweep}").raise_for_status().json()
                self.points, self.sweeping = sweep["done"], sweep["state"] in ("queued", "running")
        except httpx.HTTPError:
            pass
        if not self.over:
            self.still_s = max(self.still_s, self.idle_s)
        if (self.ended, self.points) != before:
            self.moved = time.monotonic()
        return self.ended


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
    """Wait until `more` runs have ended since, until everything has ended, or LONGEST_GAP_S."""
    progress.fault_over()
    before, begun = progress.look(), time.monotonic()
    while progress.look() < before + more and not progress.over and time.monotonic() - begun < LONGEST_GAP_S:
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
    begun = time.monotonic()
    progress.fresh()
    while progress.idle_s < 2 * STUCK_S:
        report.revived += revive(world)
        if progress.look() >= report.runs and not _sweeping(report, progress.load):
            time.sleep(2)  # the last files go to their places, temporary files go
            break
        time.sleep(0.3)
    report.after_s, report.drained_s = progress.still_s, time.monotonic() - begun
