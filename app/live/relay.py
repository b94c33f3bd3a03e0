"""The second way of a worker to the database: through a web service that both of them reach."""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from sqlalchemy.orm import Session, sessionmaker

from app.abort.links import WorkerLink
from app.db import DATABASE_SILENT, unit_of_work
from app.jobs.kind import Kind
from app.jobs.service import JobService
from app.jobs.workers import Workers

log = logging.getLogger(__name__)
THREADS = 2  # of its own, so that a database that does not answer holds up no request


class Relay:
    """Beats for workers that reach this service and not the database, and tells them which of their jobs are to stop."""

    def __init__(self, maker: sessionmaker[Session], kinds: Sequence[Kind[Any, Any, Any]]):
        self._maker, self._kinds = maker, {kind.name: kind for kind in kinds}
        self._threads = ThreadPoolExecutor(THREADS, "rths-relay")
        self._busy: dict[WorkerLink, asyncio.Task[None]] = {}

    def close(self) -> None:
        self._threads.shutdown(wait=False, cancel_futures=True)

    async def take(self, link: WorkerLink, question: dict[str, Any]) -> None:
        """Answer a worker at once that it is known to live; the rest follows when the database has answered."""
        await link.send(json.dumps({"contact": {"number": question["number"]}}))
        if link.name and link not in self._busy:
            self._busy[link] = asyncio.create_task(self._look(link, question))

    async def _look(self, link: WorkerLink, question: dict[str, Any]) -> None:
        try:
            found = await asyncio.get_running_loop().run_in_executor(self._threads, self.beat, link.name, question)
            if found:
                await link.send(json.dumps({"contact": {"number": question["number"], "stop": found}}))
        except DATABASE_SILENT as error:
            log.warning("no heartbeat is stored for worker %s: %s", link.name, error)
        except RuntimeError:
            return  # the worker has gone meanwhile
        finally:
            del self._busy[link]

    def beat(self, worker: str, question: dict[str, Any]) -> list[dict[str, Any]]:
        """Store the heartbeat of a worker; returns its jobs that were cancelled, or taken over while it was silent."""
        with unit_of_work(self._maker) as session:
            Workers(session).beat(worker, question["tests_at_a_time"])
            return [
                {"id": one["id"], "attempt": one["attempt"]}
                for one in question["executing"]
                if one["kind"] in self._kinds
                and JobService(session, self._kinds[one["kind"]]).to_stop(one["id"], one["attempt"])
            ]
