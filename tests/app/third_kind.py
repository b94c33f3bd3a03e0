"""A third kind of job, declared in this one file: it counts, and stores what it counted. For tests of the job machine."""

from __future__ import annotations

import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from sqlalchemy.orm import DeclarativeBase, Mapped

from app.config import Settings, from_environment
from app.db import Base
from app.jobs.kind import Ending, Kind
from app.jobs.order import Order
from app.jobs.states import State
from app.jobs.tables import Job
from app.worker.child import Line, Refused


class Other(DeclarativeBase):
    """Apart from the service's tables, which migrations make."""

    type_annotation_map: ClassVar = Base.type_annotation_map


class Count(Job, Other):
    __tablename__ = "count"

    wanted: Mapped[int]
    counted: Mapped[int | None]


@dataclass(frozen=True, slots=True)
class CountOrder(Order):
    wanted: int


class CountKind(Kind[Count, CountOrder, int]):
    name = noun = "count"
    table = Count
    queue, workflow = "counts", "count"
    process = "tests.app.third_kind"

    def order(self, job: Count, settings: Settings) -> CountOrder:
        return CountOrder(job.id, job.attempt, job.wanted)

    def store(self, job: Count, result: int) -> Ending:
        job.counted = result
        return Ending(State.COMPLETED, f"Counted to {result}.")


COUNTS = CountKind()
DIES, REFUSED = 13, -1
STEP_S = 0.02


def prepare() -> None: ...


def execute(order: CountOrder, line: Line) -> int:
    """Count to `wanted`; one number kills the process, another is refused."""
    if order.wanted == DIES:
        os._exit(1)
    if order.wanted == REFUSED:
        raise Refused("Nobody counts to -1.")
    for number in range(order.wanted):
        line.progress(f"at {number}", number / order.wanted)
        time.sleep(STEP_S)
    return order.wanted


def main(data: str, name: str) -> None:
    """A worker that executes this kind."""
    from app.worker.main import work

    kinds: list[Kind[Any, Any, Any]] = [COUNTS]
    work(from_environment(data=Path(data)).prepared(), "ws://127.0.0.1:1", name, kinds)


if __name__ == "__main__":
    from tests.app.third_kind import main as run  # as the module that processes import

    run(*sys.argv[1:])
