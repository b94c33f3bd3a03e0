"""TracerDAQ text: lines `key: value`, a heading, rows with sample number, date and time, values."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timedelta


def written(
    names: Sequence[str],
    rows: Sequence[Sequence[float]],
    interval: float = 0.004,
    *,
    start: datetime = datetime(2003, 1, 2, 23, 59, 59, 500_000),
    header: bool = True,
    more: Sequence[str] = (),
) -> bytes:
    head = [f"Header Size:  {3 + len(more)}", f"Sampling Interval:  {interval:g}", *more] if header else []
    lines = [*head, ", ".join(["Sample Number", "Date/Time", *names, "Events"])]
    for k, row in enumerate(rows, start=1):
        at = start + timedelta(seconds=(k - 1) * interval)
        stamp = f"{at:%m/%d/%Y %I:%M:%S}.{at.microsecond // 1000:03d} {at:%p}"
        lines.append(", ".join([f"{k:8d}", f"  {stamp}", *(f"{one:.6f}" for one in row)]))
    return "\n".join(lines).encode()
