"""The variables of a MATLAB file up to v7, one at a time: one that cannot be read does not hide the others."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

from rths_engine.foundation.errors import FileError, Issue

# by definition of the format
_HEADER = 128
_SUBSYSTEM = slice(116, 124)  # the place of data that only MATLAB's objects need
_MATRIX, _COMPRESSED = 14, 15
_OBJECT = 17  # class of an array: an object of a class of MATLAB
_OPENING = 4096  # bytes of a variable that contain its class and name


@dataclass(frozen=True)
class Element:
    """A variable: its name, where it stands, and a MATLAB file that contains it alone. `of_class`: that of an object."""

    name: str
    where: str
    file: bytes
    of_class: str = ""


def elements(raw: bytes) -> Iterator[Element]:
    """The variables of the file. Raises FileError where the file ends within one of them."""
    if len(raw) < _HEADER:
        raise FileError(
            Issue("file", f"has {len(raw)} bytes; its header alone has {_HEADER}", fix="the file is cut: save it again")
        )
    order = ">" if raw[126:128] == b"MI" else "<"
    (hidden,) = struct.unpack(order + "Q", raw[_SUBSYSTEM])
    header = raw[: _SUBSYSTEM.start] + bytes(8) + raw[_SUBSYSTEM.stop : _HEADER]
    at = _HEADER
    while at + 8 <= len(raw):
        kind, length = struct.unpack_from(order + "II", raw, at)
        end = at + 8 + length + (-length % 8 if kind != _COMPRESSED else 0)
        if end > len(raw):
            problem = f"a variable states {length} bytes; the file has {len(raw) - at - 8}"
            raise FileError(Issue(f"byte {at}", problem, fix="the file is cut: save it again"))
        if at != hidden and kind in (_MATRIX, _COMPRESSED):
            body = raw[at:end]
            name, of_class = _described(body, kind, order)
            yield Element(name, f"byte {at}", header + body, of_class)
        at = end


def _described(body: bytes, kind: int, order: str) -> tuple[str, str]:
    """Name and class of an object; both empty for every other variable, whose name its reader gives, and for a damaged one."""
    try:
        opening = zlib.decompressobj().decompress(body[8:], _OPENING) if kind == _COMPRESSED else body[:_OPENING]
        (flags,) = struct.unpack_from(order + "I", opening, 16)
        if flags & 0xFF != _OBJECT:
            return "", ""
        name, at = _text(opening, 24, order)
        _, at = _text(opening, at, order)  # the kind of class system
        return name, _text(opening, at, order)[0]
    except (zlib.error, struct.error, UnicodeDecodeError):
        return "", ""


def _text(raw: bytes, at: int, order: str) -> tuple[str, int]:
    """A text element, and the place behind it. A short one has its length and its text in eight bytes."""
    kind, length = struct.unpack_from(order + "II", raw, at)
    if kind >> 16:
        return raw[at + 4 : at + 4 + (kind >> 16)].decode("ascii"), at + 8
    return raw[at + 8 : at + 8 + length].decode("ascii"), at + 8 + length + -length % 8
