"""The process of sweeps: executes the points of a shard one after another, and sends their results in parts."""

from __future__ import annotations

import math
import time
from functools import lru_cache
from typing import Any

from app.sweeps.order import ShardEnd, ShardOrder, ShardPart
from app.worker.child import Line, Refused

PART_S = 1.0  # between two parts: what a killed worker loses at most, beside the present point


def prepare() -> None:
    """Compile the engine, or load the compiled code from the cache."""
    from rths_engine.running.warm import warm

    warm()


def execute(order: ShardOrder, line: Line) -> ShardEnd:
    """Execute the points of a shard. Raises Refused if the definition of the sweep cannot be read."""
    from rths_engine.foundation.errors import RthsError

    try:
        points = _points(_Sweep(order))
    except RthsError as error:
        raise Refused(str(error)) from None
    for first, end in order.spans:
        if not _span(points, first, end, line):
            line.stopping()
            return ShardEnd(cancelled=True)
    return ShardEnd(cancelled=False)


class _Sweep:
    """The sweep of an order, compared by its id, so that its points are read once for all of its shards."""

    def __init__(self, order: ShardOrder):
        self.order = order

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Sweep) and other.order.sweep_id == self.order.sweep_id

    def __hash__(self) -> int:
        return hash(self.order.sweep_id)


@lru_cache(maxsize=2)
def _points(sweep: _Sweep) -> Any:
    from app.store.motions import motions_of
    from rths_engine.sweeps.columns import from_dict
    from rths_engine.sweeps.design import read_design
    from rths_engine.sweeps.running import Points

    order = sweep.order
    columns = tuple(from_dict(one) for one in order.columns)
    return Points(read_design(order.definition), columns, motions_of(order.settings))


def _span(points: Any, first: int, end: int, line: Line) -> bool:
    """Execute points and send their results; False where the shard was cancelled before the last."""
    rows: list[Any] = []
    sent = time.monotonic()
    for point in range(first, end):
        row = None if line.cancelled() else points.row(point, line.cancelled)
        if row is not None:
            rows.append(row)
        if rows and (row is None or point == end - 1 or time.monotonic() - sent >= PART_S):
            line.part(_part(points, point + (row is not None) - len(rows), rows))
            rows, sent = [], time.monotonic()
        if row is None:
            return False
    return True


def _part(points: Any, first: int, rows: list[Any]) -> ShardPart:
    import numpy as np

    from rths_engine.sweeps.columns import STATUSES

    values = np.array([row.values for row in rows], dtype="<f8")
    columns = {column.key: values[:, place] for place, column in enumerate(points.columns)}
    reasons = {str(place): row.reason for place, row in enumerate(rows) if row.reason}
    counts = {one: int(np.sum(columns["status"] == STATUSES.index(one))) for one in ("tripped", "invalid", "failed")}
    elapsed, simulated = (math.fsum(np.nan_to_num(columns[key])) for key in ("elapsed_s", "simulated_s"))
    return ShardPart(
        first=first,
        count=len(rows),
        values=values.tobytes(),
        reasons=reasons,
        elapsed_s=elapsed,
        simulated_s=simulated,
        **counts,
    )
