"""Bytes of a TDMS file by National Instruments' description of its internal structure; no code in common with the reader."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

import numpy as np

_EPOCH = datetime(1904, 1, 1, tzinfo=UTC)
_TYPES = {"<f8": 10, "<f4": 9, "<i2": 2, "<i4": 3, "<u1": 5}
_META, _RAW, _NEW = 1 << 1, 1 << 3, 1 << 2


@dataclass(frozen=True)
class Channel:
    group: str
    name: str
    values: Any
    properties: Mapping[str, Any] = field(default_factory=dict)


def file(*segments: Sequence[Channel], properties: Mapping[str, Any] | None = None) -> bytes:
    """A file of one segment for each sequence of channels; the channels of later segments continue those of the first."""
    return b"".join(_segment(one, properties or {} if k == 0 else {}) for k, one in enumerate(segments))


def waveform(dt: float, start: float = 0.0, unit: str = "", begun: datetime | None = None) -> dict[str, Any]:
    about: dict[str, Any] = {"wf_increment": dt, "wf_start_offset": start, "wf_xname": "Time", "wf_xunit_string": "s"}
    return about | ({"unit_string": unit} if unit else {}) | ({"wf_start_time": begun} if begun else {})


def _segment(channels: Sequence[Channel], properties: Mapping[str, Any]) -> bytes:
    groups = list(dict.fromkeys(one.group for one in channels))
    objects = [_object("/", b"\xff\xff\xff\xff", properties)]
    objects += [_object(f"/'{group}'", b"\xff\xff\xff\xff", {}) for group in groups]
    raw = b""
    for one in channels:
        values = np.ascontiguousarray(one.values)
        index = struct.pack("<IIIQ", 20, _TYPES[values.dtype.str.replace("|", "<")], 1, len(values))
        objects.append(_object(f"/'{one.group}'/'{one.name}'", index, one.properties))
        raw += values.tobytes()
    meta = struct.pack("<I", len(objects)) + b"".join(objects)
    return b"TDSm" + struct.pack("<IIQQ", _META | _RAW | _NEW, 4713, len(meta) + len(raw), len(meta)) + meta + raw


def _object(path: str, index: bytes, properties: Mapping[str, Any]) -> bytes:
    return _text(path) + index + struct.pack("<I", len(properties)) + b"".join(_property(*one) for one in properties.items())


def _property(name: str, value: Any) -> bytes:
    if isinstance(value, str):
        return _text(name) + struct.pack("<I", 0x20) + _text(value)
    if isinstance(value, float):
        return _text(name) + struct.pack("<Id", 10, value)
    if isinstance(value, datetime):
        since = (value - _EPOCH).total_seconds()
        return _text(name) + struct.pack("<IQq", 0x44, int(since % 1 * 2**64), int(since // 1))
    return _text(name) + struct.pack("<Ii", 3, value) if value < 2**31 else _text(name) + struct.pack("<II", 7, value)


def _text(value: str) -> bytes:
    raw = value.encode()
    return struct.pack("<I", len(raw)) + raw
