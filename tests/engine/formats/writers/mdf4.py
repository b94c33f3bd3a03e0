"""Bytes of an ASAM MDF 4.10 file: one data group with one channel group for each group of channels, times as float64."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

_KINDS = {"<f8": 4, "<f4": 4, "<i2": 2, "<i4": 2, "<u1": 0, "<u2": 0}


@dataclass(frozen=True)
class Channel:
    name: str
    values: Any
    unit: str = ""
    factor: float | None = None
    offset: float = 0.0
    range: tuple[float, float] | None = None  # of the raw values
    invalid: Any = None  # places of samples that are not valid


@dataclass(frozen=True)
class Group:
    times: Any
    channels: Sequence[Channel]
    name: str = "group"
    time_unit: str = "s"
    stated: int | None = None


class _Blocks:
    def __init__(self) -> None:
        self.raw = b"MDF     4.10    test    " + struct.pack("<4xH", 410)
        self.raw = self.raw.ljust(64, b"\0")

    def add(self, name: str, links: Sequence[int], data: bytes) -> int:
        at = len(self.raw)
        self.raw += struct.pack("<4s4xQQ", b"##" + name.encode(), 24 + 8 * len(links) + len(data), len(links))
        self.raw += struct.pack(f"<{len(links)}Q", *links) + data
        self.raw += b"\0" * (-len(self.raw) % 8)
        return at

    def text(self, value: str) -> int:
        return self.add("TX", (), value.encode() + b"\0") if value else 0


def file(*groups: Group) -> bytes:
    blocks = _Blocks()
    head = blocks.add("HD", (0,) * 6, bytes(32))
    assert head == 64
    history = blocks.add("FH", (0, blocks.add("MD", (), b"<FHcomment><TX>test</TX></FHcomment>\0")), bytes(16))
    following = 0
    for one in reversed(groups):
        following = _group(blocks, one, following)
    raw = bytearray(blocks.raw)
    struct.pack_into("<QQ", raw, head + 24, following, history)
    return bytes(raw)


def _group(blocks: _Blocks, one: Group, following: int) -> int:
    arrays = [np.asarray(one.times, "<f8"), *(np.ascontiguousarray(each.values) for each in one.channels)]
    invalid = [each.invalid for each in one.channels]
    flags = int(any(places is not None for places in invalid))
    row = np.dtype([(str(k), array.dtype) for k, array in enumerate(arrays)] + ([("i", "u1")] if flags else []))
    rows = np.zeros(len(arrays[0]), row)
    for k, array in enumerate(arrays):
        rows[str(k)] = array
    for bit, places in enumerate(invalid):
        if places is not None:
            rows["i"][list(places)] |= 1 << bit
    size = row.itemsize - flags
    channel, at = 0, [int(row.fields[str(k)][1]) for k in range(len(arrays))] if row.fields else []
    for k in reversed(range(1, len(arrays))):
        channel = _channel(blocks, one.channels[k - 1], arrays[k], at[k], channel, k - 1)
    channel = _channel(blocks, Channel("time", arrays[0], one.time_unit), arrays[0], 0, channel, 0, master=True)
    count = len(rows) if one.stated is None else one.stated
    group = blocks.add(
        "CG", (0, channel, blocks.text(one.name), 0, 0, 0), struct.pack("<QQHHIII", 0, count, 0, 0, 0, size, flags)
    )
    data = blocks.add("DT", (), rows.tobytes())
    return blocks.add("DG", (following, group, data, 0), bytes(8))


def _channel(blocks: _Blocks, one: Channel, values: Any, at: int, following: int, bit: int, master: bool = False) -> int:
    law = 0
    if one.factor is not None:
        law = blocks.add("CC", (0, 0, 0, 0), struct.pack("<BBHHHdddd", 1, 0, 0, 0, 2, 0.0, 0.0, one.offset, one.factor))
    low, high = one.range or (0.0, 0.0)
    flags = (8 if one.range else 0) | (2 if one.invalid is not None else 0)
    facts = struct.pack(
        "<BBBBIIIIBBH",
        2 if master else 0,
        int(master),
        _KINDS[values.dtype.str.replace("|", "<")],
        0,
        at,
        8 * values.itemsize,
        flags,
        bit,
        0,
        0,
        0,
    )
    facts += struct.pack("<6d", low, high, 0.0, 0.0, 0.0, 0.0)
    return blocks.add("CN", (following, 0, blocks.text(one.name), 0, law, 0, blocks.text(one.unit), 0), facts)
