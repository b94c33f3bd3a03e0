"""Damage to valid files: cut, flipped, repeated, inserted and lost bytes, other numbers, lines in another order."""

from __future__ import annotations

import re
from collections.abc import Callable

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

_NUMBER = re.compile(rb"[-+]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?")
NUMBERS = [
    b"0", b"-1", b"1e999", b"-1e308", b"1e-320", b"nan", b"inf", b"99999999999999999999", b"2147483648", b"1e6", b"0.1",
    b"9" * 60, b"9" * 5000, b"", b"-", b"1.2.3", b"****", b"2024-13-45", "½".encode(),
]  # fmt: skip
PIECES = [
    b"\0" * 8, b"\xff" * 4, b"\xff\xff\xff\x7f", b"\x00\x00\x00\x80", b"\xff" * 8, b"\xf0\x3f", b"\n", b"\r\n", b",", b"\t;",
    b"NaN", b"-999", b"\xff\xfe", b"\xef\xbb\xbf", b"\xed\xa0\x80", b"{[", b"<a>", b"'\"", b"\x1a", b"#", b"\n\n\n", b" " * 100,
]  # fmt: skip

Damage = Callable[[bytes], bytes]
_AT = st.integers(0, 10**6)
_SHORT = st.integers(1, 64)


def _cut(at: int) -> Damage:
    return lambda raw: raw[: at % (len(raw) + 1)]


def _without_start(at: int) -> Damage:
    return lambda raw: raw[at % (len(raw) + 1) :]


def _flipped(at: int, value: int) -> Damage:
    return lambda raw: _put(raw, at, 1, bytes([value]))


def _written(at: int, piece: bytes) -> Damage:
    return lambda raw: _put(raw, at, len(piece), piece)


def _inserted(at: int, piece: bytes) -> Damage:
    return lambda raw: _put(raw, at, 0, piece)


def _lost(at: int, length: int) -> Damage:
    return lambda raw: _put(raw, at, length, b"")


def _repeated(at: int, length: int, times: int) -> Damage:
    def damage(raw: bytes) -> bytes:
        at_ = at % (len(raw) + 1)
        return raw[:at_] + raw[at_ : at_ + length] * times + raw[at_:]

    return damage


def _number(which: int, text: bytes) -> Damage:
    """Another number: half of the draws change one near the start, where headers are."""

    def damage(raw: bytes) -> bytes:
        found = list(_NUMBER.finditer(raw[:20_000]))
        if not found:
            return raw
        one = found[which // 2 % min(len(found), 40 if which % 2 else len(found))]
        return raw[: one.start()] + text + raw[one.end() :]

    return damage


def _lines(which: int, other: int, how: str) -> Damage:
    def damage(raw: bytes) -> bytes:
        lines = raw.split(b"\n")
        a, b = which % min(len(lines), 60), other % len(lines)
        if how == "swapped":
            lines[a], lines[b] = lines[b], lines[a]
        elif how == "lost":
            del lines[a]
        elif how == "twice":
            lines.insert(b, lines[a])
        else:
            lines[a] = lines[a].replace(b" ", b"") if how == "glued" else b""
        return b"\n".join(lines)

    return damage


def _put(raw: bytes, at: int, length: int, piece: bytes) -> bytes:
    at %= len(raw) + 1
    return raw[:at] + piece + raw[at + length :]


_PIECE = st.sampled_from(PIECES) | st.binary(min_size=1, max_size=16)
_HOW = st.sampled_from(["swapped", "lost", "twice", "glued", "empty"])
DAMAGE: SearchStrategy[Damage] = st.one_of(
    st.builds(_number, _AT, st.sampled_from(NUMBERS)),
    st.builds(_lines, _AT, _AT, _HOW),
    st.builds(_flipped, _AT, st.integers(0, 255)),
    st.builds(_written, _AT, _PIECE),
    st.builds(_inserted, _AT, _PIECE),
    st.builds(_lost, _AT, _SHORT),
    st.builds(_repeated, _AT, _SHORT, st.integers(1, 200)),
    st.builds(_cut, _AT),
    st.builds(_without_start, _AT),
)


def damaged(raw: bytes) -> SearchStrategy[bytes]:
    """The file with one to three damages; also empty."""

    def apply(damages: list[Damage]) -> bytes:
        found = raw
        for damage in damages:
            found = damage(found)
        return found

    return st.lists(DAMAGE, min_size=1, max_size=3).map(apply)
