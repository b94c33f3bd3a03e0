"""JSON forms of Abort."""

from __future__ import annotations

from datetime import datetime

from pydantic import BaseModel, Field


class WorkerOut(BaseModel):
    """A worker that is connected, and what it said of Abort."""

    name: str
    acknowledged: bool = Field(description="the worker holds all starts and stops its tests")
    stopping: list[str] = Field(description="ids of tests that its engines still execute")


class AbortOut(BaseModel):
    """What is known of Abort at this moment. Ask again with GET until it is complete."""

    held: bool = Field(description="the latch of this service is set: it starts no test and tells every worker to stop")
    by: str | None = Field(description="who pressed Abort; null where it is not pressed")
    at: datetime | None = Field(description="when Abort was pressed")
    stopping: list[str] = Field(description="ids of the tests that stop because of Abort, as far as known")
    running: list[str] = Field(description="ids of the tests that engines of connected workers still execute")
    workers: list[WorkerOut] = Field(description="the workers that are connected to this service")
    acknowledged: bool = Field(description="a worker is connected, and every connected worker has acknowledged")
    recorded: bool = Field(description="the database holds the queue, so that workers without a connection stop too")
    sentence: str = Field(description="the same in words")
