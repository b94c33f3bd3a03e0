"""The durable queue: DBOS on the application's own database. Delivery is at least once; a job's row decides what counts."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from typing import Any

import sqlalchemy as sa
from dbos import DBOS, DBOSClient, EnqueueOptions
from sqlalchemy.orm import Session

from app.jobs.kind import Kind

APPLICATION = "rths"
VERSION = "1"  # pinned: editing the workflow must not strand jobs that wait in the queue
POLLING_S = 0.1
KEEP = timedelta(days=7)
MOST_PURGED = 5000


def migrate(url: str) -> None:
    """Create or bring up to date the queue's own tables."""
    DBOS.migrate(url)


class DurableQueue:
    """The web's side of the queue: a job's workflow is enqueued in the transaction that inserts its row."""

    def __init__(self, engine: sa.Engine):
        self.client = DBOSClient(system_database_engine=engine, application_name=APPLICATION)

    def enqueue(self, session: Session, kind: Kind[Any, Any, Any], ids: Sequence[str]) -> None:
        for job_id in ids:
            options: EnqueueOptions = {
                "workflow_name": kind.workflow,
                "queue_name": kind.queue,
                "workflow_id": job_id,
                "app_version": VERSION,
            }
            self.client.enqueue_in_transaction(session, options, job_id)

    def purge(self) -> int:
        """Delete the records of workflows that ended long ago; returns how many."""
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
