"""Execution of a league: each compensator on the nominal plant, without noise and with it, and on the perturbed plants."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from multiprocessing import get_context
from pathlib import Path

from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.foundation.fingerprint import fingerprint
from rths_engine.league.entries import Entry, entries
from rths_engine.league.table import League, Outcome, Row, outcome, ranked, spread
from rths_engine.parts import compensators
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import vrths
from rths_engine.planning.plan import Plan
from rths_engine.running import loop
from rths_engine.running.run import simulate

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}  # the processes share the cores
QUIET, NOMINAL = -2, -1  # by definition: numbers of the tests on the nominal plant; perturbed plants count from 0
_motions: list[MotionLibrary] = []


@dataclass(frozen=True, slots=True)
class Wanted:
    """What a league runs: a partitioning case, a record of the library, the number of perturbed plants, the compensators."""

    case: int = 1
    record: str = vrths.EL_CENTRO
    plants: int = 20
    only: tuple[str, ...] = ()

    def check(self, motions: MotionLibrary) -> None:
        """Raises RthsError for a case, a record, a number of plants or a compensator that does not exist."""
        if self.case not in vrths.CASES:
            raise RthsError(Issue("--case", "is not a partitioning case", self.case, f"choose 1 to {len(vrths.CASES)}"))
        if not 0 <= self.plants <= vrths.MOST_PLANTS:
            raise RthsError(Issue("--plants", f"needs 0 to {vrths.MOST_PLANTS}", self.plants, "the benchmark has 20"))
        kinds = [kind.model_fields["kind"].default for kind in compensators.KINDS]
        for name in self.only:
            if name not in kinds:
                raise RthsError(Issue("--only", "is not a compensator", name, "choose from " + ", ".join(kinds)))
        motions.get(self.record)

    @property
    def tests(self) -> list[int]:
        return [QUIET, NOMINAL, *range(self.plants)]


def plan(wanted: Wanted, entry: Entry, test: int) -> Plan:
    """The plan of a test of an entry."""
    rig = vrths.plants(wanted.plants)[test] if test >= 0 else None
    return vrths.benchmark(
        wanted.case, entry.compensator, rig, record=wanted.record, noisy=test != QUIET, seed=max(test, NOMINAL) + 2
    )


def league(
    wanted: Wanted, motions: Path | None, processes: int, command: str, progress: Callable[[int, int], None] = lambda *_: None
) -> League:
    """Run a league. `progress` gets the number of tests that are done and the number of all tests.

    Raises RthsError where `Wanted.check` does.
    """
    wanted.check(MotionLibrary(motions))
    start, every = time.perf_counter(), entries(wanted.case, wanted.only)
    places = [(number, test) for number in range(len(every)) for test in wanted.tests]
    found: dict[tuple[int, int], Outcome] = {}
    for place, one in _outcomes(wanted, places, motions, processes):
        found[place] = one
        progress(len(found), len(places))
    rows = [_row(wanted, entry, {test: found[number, test] for test in wanted.tests}) for number, entry in enumerate(every)]
    return League(
        made=datetime.now(UTC).isoformat(timespec="seconds"),
        command=command,
        code=fingerprint(loop.advance.py_func),
        case=wanted.case,
        template=vrths.name(wanted.case),
        record=wanted.record,
        intensity=vrths.INTENSITY,
        plants=wanted.plants,
        seed=vrths.PLANTS_SEED,
        elapsed_s=time.perf_counter() - start,
        processes=processes,
        rows=ranked(rows),
    )


def _row(wanted: Wanted, entry: Entry, outcomes: dict[int, Outcome]) -> Row:
    plants = [outcomes[test] for test in range(wanted.plants)]
    return Row(
        kind=entry.kind,
        title=entry.title,
        published=entry.published,
        settings=entry.compensator.model_dump(mode="json"),
        digest=plan(wanted, entry, NOMINAL).digest,
        quiet=outcomes[QUIET],
        nominal=outcomes[NOMINAL],
        plants=plants,
        spread=spread(plants),
    )


def _outcomes(
    wanted: Wanted, places: list[tuple[int, int]], motions: Path | None, processes: int
) -> Iterator[tuple[tuple[int, int], Outcome]]:
    given = [(wanted, place) for place in places]
    if processes < 2:
        _prepare(motions, alone=True)
        yield from map(_outcome, given)
        return
    os.environ.update(ONE_THREAD)  # read where the processes load numpy
    with get_context("spawn").Pool(min(processes, len(places)), _prepare, (motions,)) as pool:
        yield from pool.imap_unordered(_outcome, given)


def _prepare(motions: Path | None, alone: bool = False) -> None:
    if not alone:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C also reaches the parent, which ends this process
    _motions[:] = [MotionLibrary(motions)]


def _outcome(given: tuple[Wanted, tuple[int, int]]) -> tuple[tuple[int, int], Outcome]:
    wanted, (number, test) = given
    entry = entries(wanted.case, wanted.only)[number]
    result = simulate(plan(wanted, entry, test), _motions[0])
    return (number, test), outcome(result.summary())
