"""Bytes of an imc FAMOS file of version 2: keys with their lengths, and one block of samples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

_TYPES = {"|u1": 1, "|i1": 2, "<u2": 3, "<i2": 4, "<u4": 5, "<i4": 6, "<f4": 7, "<f8": 8}


@dataclass(frozen=True)
class Channel:
    name: str
    values: Any
    dt: float = 0.01
    start: float = 0.0
    unit: str = "kN"
    factor: float | None = None
    offset: float = 0.0
    second: float = 0.0  # of the trigger, after 8.1.2024 12:36
    times: Any = None  # XY data, where given
    axis_unit: str = "s"
    stated_bytes: int | None = None


def file(*channels: Channel, interleaved: bool = False) -> bytes:
    """The file. `interleaved`: the samples of the channels stand one after the other, row by row."""
    keys = [_key("CF", "1", 2), _key("CK", "1,1"), _key("NO", f"1,{_text('test')},{_text('')}")]
    body, reference = b"", 1
    arrays = [np.ascontiguousarray(one.values) for one in channels]
    row = sum(one.itemsize for one in arrays)
    for one, values in zip(channels, arrays, strict=True):
        components = [(values, one.unit)] if one.times is None else [(values, one.unit), (np.asarray(one.times, "<f8"), "s")]
        keys.append(_key("CG", f"{len(components)},{1 if one.times is None else 3},{len(components)}"))
        keys.append(_key("CD", f"{one.dt:.17E},1,{_text(one.axis_unit)},0,0,0"))
        keys.append(_key("NT", f"8,1,2024,12,36,{one.second}"))
        for number, (held, unit) in enumerate(components, start=1):
            size = held.itemsize
            at, length = (0, row * len(held)) if interleaved else (len(body), held.nbytes)
            offset = sum(other.itemsize for other in arrays[: channels.index(one)]) if interleaved else 0
            keys.append(_key("CC", f"{number},1"))
            gap = row - size if interleaved else 0
            keys.append(_key("CP", f"{reference},{size},{_TYPES[held.dtype.str]},{8 * size},0,{offset},1,{gap}"))
            stated = length if one.stated_bytes is None else one.stated_bytes
            keys.append(_key("Cb", f"1,0,{reference},1,{at},{length},0,{stated},1,{one.start:.17E},0,"))
            scaled = one.factor is not None and number == 1
            keys.append(
                _key("CR", f"{int(scaled)},{one.factor if scaled else 1},{one.offset if scaled else 0},1,{_text(unit)}")
            )
            keys += [_key("CN", f"0,0,0,{_text(one.name)},{_text('')}")] if number == 1 else []
            body += b"" if interleaved else held.tobytes()
            reference += 1
    if interleaved:
        rows = np.zeros(len(arrays[0]), np.dtype([(str(k), array.dtype) for k, array in enumerate(arrays)]))
        for k, array in enumerate(arrays):
            rows[str(k)] = array
        body = rows.tobytes()
    return b"\r\n".join(keys) + b"\r\n|CS,1," + str(len(body) + 2).encode() + b",1," + body + b";"


def _key(name: str, content: str, version: int = 1) -> bytes:
    raw = content.encode("cp1252")
    return f"|{name},{version},{len(raw)},".encode() + raw + b";"


def _text(value: str) -> str:
    return f"{len(value.encode('cp1252'))},{value}"
