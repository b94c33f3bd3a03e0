"""The heartbeat of this worker, and the take-over of what dead workers hold."""

from __future__ import annotations

import logging
import secrets

from dbos import DBOS
from sqlalchemy.orm import Session, sessionmaker

from app.db import unit_of_work
from app.jobs.workers import Watch, Workers
from app.worker.contact import Contact
from rths_engine.foundation.errors import Issue, RthsError

log = logging.getLogger("rths.worker")
LONGEST_NAME = 60


def unique(name: str, boot: str | None = None) -> str:
    """The identity of a worker: its name and a word for this start of its process, so that no two workers have the same.

    `boot` is the word where the starter of the process chose it. Raises RthsError for a name that is blank or too long.
    """
    if not 0 < len(name.strip()) <= LONGEST_NAME:
        raise RthsError(Issue("name", f"needs 1 to {LONGEST_NAME} characters", name, "give the worker another --name"))
    return f"{name.strip()}-{boot or secrets.token_hex(3)}"


class Peers:
    """The workers of one database as this worker sees them: it tells them that it lives, and takes over from the dead."""

    def __init__(self, maker: sessionmaker[Session], worker: str, tests_at_a_time: int, contact: Contact | None = None):
        self.maker, self.worker, self.tests_at_a_time = maker, worker, tests_at_a_time
        self.contact = contact or Contact()
        self._watch = Watch()

    def beat(self) -> None:
        """Tell the others that this worker lives. The first time is before it takes anything from the queue."""
        begun = self.contact.now()
        with unit_of_work(self.maker) as session:
            Workers(session).beat(self.worker, self.tests_at_a_time)
        self.contact.beaten(begun)

    def look(self) -> set[str]:
        """Beat, and give back to the queue what workers hold that are dead, or that have no heartbeat; returns who lives.

        The step of the queue is atomic: it takes a turn from the dead worker that holds it, so of two workers that see the
        same death one gives the turn back, and a turn that a living worker has taken up meanwhile stays there.
        """
        self.beat()
        with unit_of_work(self.maker) as session:
            beats = Workers(session).beats()
        dead = self._watch.look(beats) - {self.worker}
        holders = {one.executor_id for one in DBOS.list_workflows(status="PENDING", load_input=False, load_output=False)}
        for gone in sorted(holder for holder in holders if holder and (holder in dead or holder not in beats)):
            log.warning("worker %s is dead: its tests are taken over", gone)
            DBOS._recover_pending_workflows([gone])
        if dead:
            with unit_of_work(self.maker) as session:
                Workers(session).forget_old(dead)
        return beats.keys() - dead

    def leave(self) -> None:
        """Tell the others that this worker ends, so that they take over at once."""
        with unit_of_work(self.maker) as session:
            Workers(session).forget(self.worker)
