"""The durable queue: DBOS on the database of the application. It delivers a job at least once; the row of the job decides."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from typing import Any

import sqlalchemy as sa
from dbos import DBOS, DBOSClient, EnqueueOptions
from sqlalchemy.orm import Session

from app.jobs.kind import Kind

APPLICATION = "rths"
VERSION = "1"  # pinned: jobs in the queue must still start after the workflow is edited
KEEP = timedelta(days=7)
MOST_PURGED = 5000


def migrate(url: str) -> None:
    """Create or update the tables of the queue."""
    DBOS.migrate(url)


class DurableQueue:
    """The queue for the web service: it enqueues the workflow of a job in the transaction that inserts the row of the job."""

    def __init__(self, engine: sa.Engine):
        self.client = DBOSClient(system_database_engine=engine, application_name=APPLICATION)

    def __reduce__(self) -> tuple[type[None], tuple[()]]:
        """A calculation gets None: its process queues nothing."""
        return type(None), ()

    def enqueue(self, session: Session, kind: Kind[Any, Any, Any], ids: Sequence[str]) -> None:
        """Queue a turn for each id: the id of a job, or of a further turn of an ordered kind."""
        for job_id in ids:
            options: EnqueueOptions = {
                "workflow_name": kind.workflow,
                "queue_name": kind.queue,
                "workflow_id": job_id,
                "app_version": VERSION,
            }
            self.client.enqueue_in_transaction(session, options, job_id)

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
