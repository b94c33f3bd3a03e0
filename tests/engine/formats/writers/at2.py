"""PEER AT2, VT2 and DT2 files: four lines of header, then five numbers a line."""

from __future__ import annotations

from rths_engine.foundation.arrays import Array

SERIES = {
    "acceleration": "ACCELERATION TIME SERIES IN UNITS OF G",
    "velocity": "VELOCITY TIME SERIES IN UNITS OF CM/S",
    "displacement": "DISPLACEMENT TIME SERIES IN UNITS OF CM",
}


def written(
    values: Array,
    dt: float = 0.01,
    quantity: str = "acceleration",
    *,
    count: int | None = None,
    old: bool = False,
    series: str | None = None,
    form: str = "%15.7E",
    per_line: int = 5,
) -> bytes:
    stated = len(values) if count is None else count
    counts = f"{stated:6d}    {dt:.4f}    NPTS, DT" if old else f"NPTS= {stated:6d}, DT= {dt:.4f} SEC,"
    fields = [form % value for value in values]
    rows = ["".join(fields[at : at + per_line]) for at in range(0, len(fields), per_line)]
    title = SERIES[quantity] if series is None else series
    header = ["PEER NGA STRONG MOTION DATABASE RECORD", "Made-up-01, 1/17/2023, Canyon Country - W Lost Cany, 0", title, counts]
    return ("\n".join([*header, *rows]) + "\n").encode()
