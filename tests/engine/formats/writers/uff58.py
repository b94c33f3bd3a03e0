"""Text or bytes of a universal file with datasets 58, by the fixed columns of its definition."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Record:
    values: Any
    dt: float = 0.01
    start: float = 0.0
    times: Any = None  # uneven, where given
    unit: str = "kN"
    label: str = "Force"
    point: str = "actuator"
    kind: int = 13  # force
    double: bool = False
    binary: bool = False
    stated: int | None = None
    function: int = 1


def file(*records: Record, before: bytes = b"") -> bytes:
    return before + b"".join(_dataset(one) for one in records)


def _dataset(one: Record) -> bytes:
    values = np.asarray(one.values, dtype=float)
    body = _binary(one, values) if one.binary else _text(one, values).encode()
    first = f"    58b{1:6d}{2:6d}{11:12d}{len(body):12d}{0:6d}{0:6d}{0:12d}{0:12d}" if one.binary else "    58"
    count = len(values) if one.stated is None else one.stated
    lines = [
        "    -1",
        first,
        *("title", "NONE", "18-Apr-16 13:49:58", "NONE", "NONE"),
        f"{one.function:5d}{0:10d}{0:5d}{0:10d} {one.point:<10}{0:10d}{0:4d} {'NONE':<10}{0:10d}{0:4d}",
        f"{4 if one.double else 2:10d}{count:10d}{0 if one.times is not None else 1:10d}"
        f"{one.start:13.5E}{one.dt:13.5E}{0.0:13.5E}",
        f"{17:10d}{0:5d}{0:5d}{0:5d} {'Time':<20} {'s':<20}",
        f"{one.kind:10d}{0:5d}{0:5d}{0:5d} {one.label:<20} {one.unit:<20}",
        *[f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':<20} {'NONE':<20}"] * 2,
    ]
    return "\n".join(lines).encode() + b"\n" + body + b"    -1\n"


def _text(one: Record, values: Any) -> str:
    if one.times is None:
        cells, per = [f"{value:20.12E}" if one.double else f"{value:13.5E}" for value in values], 4 if one.double else 6
    else:
        real = "20.12E" if one.double else "13.5E"
        cells = [cell for time, value in zip(one.times, values, strict=True) for cell in (f"{time:13.5E}", f"{value:{real}}")]
        per = 4 if one.double else 6
    return "".join("".join(cells[k : k + per]) + "\n" for k in range(0, len(cells), per))


def _binary(one: Record, values: Any) -> bytes:
    real = "<f8" if one.double else "<f4"
    if one.times is None:
        return bytes(values.astype(real).tobytes())
    rows = np.zeros(len(values), np.dtype([("t", "<f4"), ("y", real)]))
    rows["t"], rows["y"] = one.times, values
    return rows.tobytes()
