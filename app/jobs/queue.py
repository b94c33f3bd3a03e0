"""The durable queue: DBOS on the database of the application. It delivers a job at least once; the row of the job decides."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from typing import Any, NamedTuple

import sqlalchemy as sa
from dbos import DBOS, DBOSClient, EnqueueOptions
from sqlalchemy.orm import Session

from app.jobs.kind import Kind

APPLICATION = "rths"
VERSION = "1"  # pinned: jobs in the queue must still start after the workflow is edited
KEEP = timedelta(days=7)
MOST_PURGED = 5000
AGAIN = "/"  # between a turn and the number of its further delivery


def migrate(url: str) -> None:
    """Create or update the tables of the queue."""
    DBOS.migrate(url)


class Held(NamedTuple):
    """A delivery that a worker holds, and its queue."""

    delivery: str
    worker: str
    queue: str

    @property
    def turn(self) -> str:
        return self.delivery.partition(AGAIN)[0]


class DurableQueue:
    """The queue without the execution of its turns: what the web service and the net of a worker do with it.

    A turn is enqueued in the transaction that inserts the row of its job. Its workflow has the same id; the workflow of a turn
    that is delivered again has this id with a number, as in `TURN/1`.
    """

    def __init__(self, engine: sa.Engine):
        self.client = DBOSClient(system_database_engine=engine, application_name=APPLICATION, retry_connection_errors=False)

    def __reduce__(self) -> tuple[type[None], tuple[()]]:
        """A calculation gets None: its process queues nothing."""
        return type(None), ()

    def enqueue(self, session: Session, kind: Kind[Any, Any, Any], ids: Sequence[str]) -> None:
        """Queue a turn for each id: the id of a job, or of a further turn of an ordered kind."""
        for turn in ids:
            self._enqueue(session, kind, turn, turn)

    def deliver_again(self, session: Session, kind: Kind[Any, Any, Any], turns: Sequence[str]) -> None:
        """Queue turns again whose workflows have ended or are lost. Of two callers at the same time, one does it."""
        for turn in turns:
            known = self.client.list_workflows(workflow_id_prefix=f"{turn}{AGAIN}", load_input=False, load_output=False)
            last = max((int(one.workflow_id.rpartition(AGAIN)[2]) for one in known), default=0)
            self._enqueue(session, kind, f"{turn}{AGAIN}{last + 1}", turn)

    def held(self) -> list[Held]:
        """The deliveries that workers hold, of all kinds."""
        found = self.client.list_workflows(status="PENDING", load_input=False, load_output=False)
        return [Held(one.workflow_id, one.executor_id or "", one.queue_name or "") for one in found]

    def holder(self, delivery: str) -> str | None:
        """The worker that holds a delivery; None where nobody does."""
        found = self.client.list_workflows(workflow_ids=[delivery], status="PENDING", load_input=False, load_output=False)
        return found[0].executor_id if found else None

    def waits(self, kind: Kind[Any, Any, Any], turn: str = "") -> bool:
        """Whether a turn waits for a worker: any of this kind, or this one."""
        waiting = ["ENQUEUED", "DELAYED"]
        found = self.client.list_workflows(
            status=waiting, queue_name=kind.queue, workflow_id_prefix=turn or None, limit=1, load_input=False, load_output=False
        )
        return bool(found)

    def give_back(self, held: Held) -> bool:
        """Put a delivery back into the queue unless another worker holds it by now: one statement that names the holder."""
        return self.client._sys_db.reenqueue_for_recovery(held.delivery, [held.worker], held.queue)

    def purge(self) -> int:
        """Delete the records of workflows that ended before KEEP; returns the number deleted."""
        before = (datetime.now(UTC) - KEEP).isoformat()
        ended = ["SUCCESS", "ERROR", "CANCELLED"]
        old = self.client.list_workflows(
            status=ended, completed_before=before, limit=MOST_PURGED, load_input=False, load_output=False
        )
        if old:
            self.client.delete_workflows([workflow.workflow_id for workflow in old])
        return len(old)

    def close(self) -> None:
        self.client.destroy()

    def _enqueue(self, session: Session, kind: Kind[Any, Any, Any], delivery: str, turn: str) -> None:
        options: EnqueueOptions = {
            "workflow_name": kind.workflow,
            "queue_name": kind.queue,
            "workflow_id": delivery,
            "app_version": VERSION,
        }
        self.client.enqueue_in_transaction(session, options, turn)
