"""Bytes of a NetCDF 3 file (classic or 64-bit offset), by the grammar of Unidata's format description; fixed sizes only."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

_CODES = {"i1": 1, "i2": 3, "i4": 4, "f4": 5, "f8": 6}
_DIMENSION, _VARIABLE, _ATTRIBUTE, _CHAR = 10, 11, 12, 2


@dataclass(frozen=True)
class Variable:
    name: str
    values: Any  # as stored
    dimensions: Sequence[str]
    attributes: Mapping[str, Any] = field(default_factory=dict)


def file(variables: Sequence[Variable], attributes: Mapping[str, Any] | None = None, wide: bool = False) -> bytes:
    sizes: dict[str, int] = {}
    for one in variables:
        sizes |= dict(zip(one.dimensions, np.shape(one.values), strict=True))
    names = list(sizes)
    head = b"CDF" + (b"\x02" if wide else b"\x01") + struct.pack(">i", 0)
    head += struct.pack(">ii", _DIMENSION, len(names)) + b"".join(
        _text(name) + struct.pack(">i", sizes[name]) for name in names
    )
    head += _attributes(attributes or {}) + struct.pack(">ii", _VARIABLE, len(variables))
    opened = [_opening(one, names) for one in variables]
    bodies = [_body(one) for one in variables]
    begin = len(head) + sum(len(one) + 4 + 4 + (8 if wide else 4) for one in opened)
    for one, opening, body in zip(variables, opened, bodies, strict=True):
        code = _CODES[np.asarray(one.values).dtype.str[1:]]
        head += opening + struct.pack(">ii", code, len(body)) + struct.pack(">q" if wide else ">i", begin)
        begin += len(body)
    return head + b"".join(bodies)


def _opening(one: Variable, names: list[str]) -> bytes:
    places = struct.pack(f">i{len(one.dimensions)}i", len(one.dimensions), *(names.index(name) for name in one.dimensions))
    return _text(one.name) + places + _attributes(one.attributes)


def _body(one: Variable) -> bytes:
    values = np.asarray(one.values)
    raw = values.astype(values.dtype.newbyteorder(">")).tobytes()
    return raw + bytes(-len(raw) % 4)


def _attributes(found: Mapping[str, Any]) -> bytes:
    if not found:
        return bytes(8)
    return struct.pack(">ii", _ATTRIBUTE, len(found)) + b"".join(_attribute(*one) for one in found.items())


def _attribute(name: str, value: Any) -> bytes:
    if isinstance(value, str):
        raw, code, count = value.encode(), _CHAR, len(value.encode())
    else:
        array = np.atleast_1d(np.asarray(value))
        raw, code, count = array.astype(array.dtype.newbyteorder(">")).tobytes(), _CODES[array.dtype.str[1:]], array.size
    return _text(name) + struct.pack(">ii", code, count) + raw + bytes(-len(raw) % 4)


def _text(value: str) -> bytes:
    raw = value.encode()
    return struct.pack(">i", len(raw)) + raw + bytes(-len(raw) % 4)
