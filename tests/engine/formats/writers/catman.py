"""Bytes of a catman file of identification 5012."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Channel:
    name: str
    values: Any
    unit: str = "kN"
    dt: float = 0.01
    form: int = 0  # 0: 8 bytes, 1: 4 bytes, 2: 2 bytes
    stated: int | None = None


def file(*channels: Channel, comment: str = "test") -> bytes:
    opening = _text(comment) + b"".join(_text(" ") for _ in range(32)) + struct.pack("<hi", len(channels), 0)
    opening += struct.pack(f"<{len(channels)}i", *[0] * len(channels)) + struct.pack("<i", 0)
    heads = b"".join(_head(k, one) for k, one in enumerate(channels, start=1))
    offset = 6 + len(opening) + len(heads)
    return struct.pack("<hi", 5012, offset) + opening + heads + b"".join(_samples(one) for one in channels)


def _head(number: int, one: Channel) -> bytes:
    count = len(one.values) if one.stated is None else one.stated
    extended = bytearray(148)
    struct.pack_into("<dd", extended, 0, 45000.0, 1000 * one.dt)
    extended[140] = one.form
    parts = [struct.pack("<hi", number, count), _text(one.name), _text(one.unit), _text(""), struct.pack("<hhd", 0, 8, 45000.0)]
    parts += [struct.pack("<i", 148), bytes(extended), b"\x01\x00\x00", struct.pack("<h", 0), _text(""), struct.pack("<i", 0)]
    return b"".join(parts)


def _samples(one: Channel) -> bytes:
    values = np.asarray(one.values, dtype=float)
    if one.form < 2:
        return values.astype("<f8" if one.form == 0 else "<f4").tobytes()
    least, most = float(values.min()), float(values.max())
    steps = np.round((values - least) / (most - least) * 32767).astype("<u2")
    return struct.pack("<dd", least, most) + steps.tobytes()


def _text(value: str) -> bytes:
    raw = value.encode("cp1252")
    return struct.pack("<h", len(raw)) + raw
