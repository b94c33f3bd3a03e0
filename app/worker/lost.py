"""A net under the durable queue: what it lost is queued again, so that no job stands still while workers live.

DBOS loses a delivery where the answer to its claim was lost with the connection, or where a full disk refused its records:
the delivery stays claimed by a worker that does not know of it, or it ends with an error while its job has not ended.
"""

from __future__ import annotations

import logging
import time
import uuid
from collections.abc import Hashable, Iterable, Sequence
from typing import Any, TypeVar

from app.db import unit_of_work
from app.jobs.hold import Hold
from app.jobs.kind import Kind
from app.jobs.queue import DurableQueue, Held
from app.jobs.repository import Begun, JobRepository
from app.jobs.states import State
from app.worker.executor import Executor

log = logging.getLogger("rths.worker")
LOOK_S = 5.0
LOOKS = 3  # looks in a row that find the same: a delivery on its way between two transactions is not lost
CLAIM_LOOKS = 5  # more: DBOS itself waits up to 20 s for a connection that was cut
MOST = 100  # turns queued again in one look
Key = TypeVar("Key", bound=Hashable)


class Lost:
    """What the queue lost, as one worker sees it. It answers for its own deliveries, and for the jobs of the dead."""

    def __init__(self, executor: Executor, queue: DurableQueue, kinds: Sequence[Kind[Any, Any, Any]]):
        self.executor, self.queue, self.kinds = executor, queue, kinds
        self.maker, self.worker = executor.maker, executor.name
        self._looked = -LOOK_S
        self._seen: dict[Hashable, int] = {}

    def look(self, living: set[str]) -> None:
        """Look for lost deliveries and jobs every LOOK_S, and queue what is lost. `living`: the workers with a heartbeat."""
        if time.monotonic() - self._looked < LOOK_S:
            return
        self._looked = time.monotonic()
        before, self._seen = self._seen, {}
        held = self.queue.held()
        for kind in self.kinds:
            own = [one for one in held if one.queue == kind.queue]
            self._give_back(kind, own, before)
            begun = self._begun(kind)
            self._deliver_running(kind, own, begun, living, before)
            self._deliver_queued(kind, own, begun, before)

    def _give_back(self, kind: Kind[Any, Any, Any], held: list[Held], before: dict[Hashable, int]) -> None:
        """Put deliveries back into the queue that this worker has claimed and does not execute."""
        executed = self.executor.busy_with(kind)
        idle = [one for one in held if one.worker == self.worker and one.delivery not in executed]
        for one in self._still(idle, before, CLAIM_LOOKS):
            if self.queue.give_back(one):
                log.warning("delivery %s of %s was claimed and lost: it is queued again", one.delivery, one.queue)

    def _begun(self, kind: Kind[Any, Any, Any]) -> list[Begun]:
        table: Any = kind.table
        with unit_of_work(self.maker) as session:
            return JobRepository(session, table).running()

    def _deliver_running(
        self, kind: Kind[Any, Any, Any], held: list[Held], begun: list[Begun], living: set[str], before: dict[Hashable, int]
    ) -> None:
        """Queue the turns of jobs that are running by their row, but that nobody executes and no delivery will end."""
        turns = {one.turn for one in held}
        left = [one for one in begun if one.turn not in turns and self._abandoned(one, living)]
        self._again(kind, [one.turn for one in self._still(left, before, LOOKS)])

    def _abandoned(self, one: Begun, living: set[str]) -> bool:
        return not self.executor.executes(one.job) if one.worker == self.worker else one.worker not in living

    def _deliver_queued(
        self, kind: Kind[Any, Any, Any], held: list[Held], begun: list[Begun], before: dict[Hashable, int]
    ) -> None:
        """Queue turns for jobs that wait while this worker has a free place, and no delivery waits for a worker."""
        free = len(self.executor.busy_with(kind)) < kind.at_a_time(self.executor.settings)
        if not free or self.queue.waits(kind):
            return
        table: Any = kind.table
        with unit_of_work(self.maker) as session:
            if kind.waits_while_held:
                Hold(session).locked()  # of two workers that see the same, the second sees what the first has queued
            queued = JobRepository(session, table).first_ids(State.QUEUED, MOST)
            if not queued or not self._still([kind.name], before, LOOKS) or self.queue.waits(kind):
                return
            if not kind.ordered:
                turns = {one.turn for one in held}
                lost = [job for job in queued if job not in turns]
                self.queue.deliver_again(session, kind, lost)
            else:
                started = {one.turn for one in begun}
                lost = [str(uuid.uuid4()) for _ in queued[sum(one.turn not in started for one in held) :]]
                self.queue.enqueue(session, kind, lost)
        if lost:
            log.warning("%d jobs of %s had no turn: turns are queued for them", len(lost), kind.queue)

    def _again(self, kind: Kind[Any, Any, Any], turns: list[str]) -> None:
        lost = [turn for turn in turns if not self.queue.waits(kind, turn)]
        if lost:
            log.warning("nobody executes running jobs of %s: their turns are queued again: %s", kind.queue, ", ".join(lost))
            with unit_of_work(self.maker) as session:
                self.queue.deliver_again(session, kind, lost)

    def _still(self, found: Iterable[Key], before: dict[Hashable, int], looks: int) -> list[Key]:
        """What `looks` looks in a row have found."""
        still = []
        for one in found:
            self._seen[one] = before.get(one, 0) + 1
            if self._seen[one] >= looks:
                still.append(one)
        return still
