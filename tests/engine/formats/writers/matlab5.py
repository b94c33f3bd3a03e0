"""Bytes of a MATLAB file of version 5 to 7: arrays, structs, texts and an object of a class, compressed or not."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

_INT8, _INT32, _UINT32, _DOUBLE, _MATRIX, _COMPRESSED, _UTF8 = 1, 5, 6, 9, 14, 15, 16
_STRUCT, _CHAR, _REAL, _OBJECT = 2, 4, 6, 17


@dataclass(frozen=True)
class Object:
    """An object of a class, of which the file holds only a reference to data that no reader but MATLAB has."""

    of_class: str = "string"


def file(variables: Mapping[str, Any], compressed: bool = False) -> bytes:
    head = b"MATLAB 5.0 MAT-file, written for a test".ljust(116) + bytes(8) + b"\x00\x01IM"
    return head + b"".join(element(name, value, compressed) for name, value in variables.items())


def element(name: str, value: Any, compressed: bool = False) -> bytes:
    raw = _array(name, value)
    if not compressed:
        return raw
    packed = zlib.compress(raw)
    return struct.pack("<II", _COMPRESSED, len(packed)) + packed


def _array(name: str, value: Any) -> bytes:
    if isinstance(value, Object):
        parts = [_flags(_OBJECT), _data(_INT8, name.encode()), _data(_INT8, b"MCOS"), _data(_INT8, value.of_class.encode())]
        reference = np.array([[0xDD000000, 2, 1, 1, 1, 1]], dtype="<u4")
        inside = [_flags(13), _size(6, 1), _data(_INT8, b""), _data(_UINT32, reference.tobytes())]
        return _tagged(_MATRIX, b"".join([*parts, _tagged(_MATRIX, b"".join(inside))]))
    if isinstance(value, Mapping):
        names = b"".join(key.encode().ljust(32, b"\0") for key in value)
        length = struct.pack("<HHI", _INT32, 4, 32)
        parts = [_flags(_STRUCT), _size(1, 1), _data(_INT8, name.encode()), length, _data(_INT8, names)]
        return _tagged(_MATRIX, b"".join([*parts, *(_array("", one) for one in value.values())]))
    if isinstance(value, str):
        parts = [_flags(_CHAR), _size(1, len(value)), _data(_INT8, name.encode()), _data(_UTF8, value.encode())]
        return _tagged(_MATRIX, b"".join(parts))
    array = np.atleast_2d(np.asarray(value, dtype="<f8"))
    parts = [_flags(_REAL), _size(*array.shape), _data(_INT8, name.encode()), _data(_DOUBLE, array.tobytes("F"))]
    return _tagged(_MATRIX, b"".join(parts))


def _flags(of_class: int) -> bytes:
    return struct.pack("<IIII", _UINT32, 8, of_class, 0)


def _size(*shape: int) -> bytes:
    return _data(_INT32, struct.pack(f"<{len(shape)}i", *shape))


def _data(kind: int, raw: bytes) -> bytes:
    if 0 < len(raw) <= 4:
        return struct.pack("<HH", kind, len(raw)) + raw.ljust(4, b"\0")
    return _tagged(kind, raw)


def _tagged(kind: int, raw: bytes) -> bytes:
    return struct.pack("<II", kind, len(raw)) + raw + bytes(-len(raw) % 8)
