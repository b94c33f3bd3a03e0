"""Read a block of rows of numbers from a text file of any size, in bounded memory, on two threads.

The file is read in pieces of whole lines. Threads convert the pieces in compiled code; their columns go to memory for a small
file and to a scratch file for a large file. The file is read once and never held.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

from rths_engine.formats.numeric_rows import PADDING, numeric_rows
from rths_engine.formats.scratch import Scratch
from rths_engine.formats.source import Source
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
PIECE = 1 << 22  # bytes of text that a thread converts at a time
THREADS = 2
IN_MEMORY = 1 << 25  # bytes of text whose columns stay in memory; those of a larger file go to a scratch file
MOST_VALUES = 500_000_000  # in all columns: 4 GB of a scratch file


@dataclass(frozen=True, slots=True)
class Layout:
    """How a row is written: its `separator` (empty: white space), its decimal sign, and which fields are numbers.

    `ending`: whether rows can end with a separator.
    """

    separator: str
    decimal: str
    numeric: Sequence[bool]
    ending: bool = False

    @property
    def columns(self) -> int:
        return sum(self.numeric)

    @property
    def targets(self) -> np.ndarray:
        """For each field its column, -1 for text."""
        return np.where(self.numeric, np.cumsum(self.numeric) - 1, -1)


# The numbers of a line that the compiled code does not read, given the offset of the line in the file and its bytes; None for a
# line that is not a row. It raises FileError for a line that is wrong.
OtherLine = Callable[[int, bytes], Sequence[float] | None]


@dataclass(slots=True)
class _Piece:
    """Whole lines: `text[:size]`, from byte `offset` of the file."""

    text: bytearray
    size: int
    offset: int


def read_block(source: Source, start: int, layout: Layout, other: OtherLine) -> list[Array]:
    """The numeric columns of all rows from byte `start` to the end. Raises FileError by `other`, or for too many values."""
    most = (source.size - start) // max(2, len(layout.numeric)) + 1
    if source.size - start <= IN_MEMORY:
        blocks = [block.copy() for block in _blocks(source, start, layout, other)]
        return list(np.concatenate(blocks, axis=1)) if blocks else [np.zeros(0)] * layout.columns
    with Scratch(layout.columns, most) as scratch:
        rows = 0
        for block in _blocks(source, start, layout, other):
            for column, values in enumerate(block):
                scratch.write(column, rows, values)
            rows += block.shape[1]
            if rows * layout.columns > MOST_VALUES:
                problem = f"has more than {MOST_VALUES:,} values, the maximum"
                raise FileError(Issue("file", problem, fix="export fewer signals, a shorter time or a lower rate"))
        return scratch.columns(rows)


def line_number(source: Source, offset: int) -> int:
    """The number, from 1, of the line that starts at a byte of the file; lines end with CR LF, LF or CR."""
    number, last = 1, b""
    with source.open() as file:
        while offset > 0 and (part := file.read(min(PIECE, offset))):
            number += part.count(b"\n") + part.count(b"\r") - part.count(b"\r\n") - (last == b"\r" and part.startswith(b"\n"))
            offset, last = offset - len(part), part[-1:]
    return number


def _blocks(source: Source, start: int, layout: Layout, other: OtherLine) -> Iterator[Array]:
    """The columns (columns, rows) of one piece after the other. A block is valid until the next is asked for."""
    room = PIECE // max(2, len(layout.numeric)) + 1
    room += -room % 512 + 24  # columns at multiples of 4096 bytes would displace each other in the processor's cache
    spare: deque[tuple[bytearray, Array]] = deque()
    running: deque[tuple[Future[Array], tuple[bytearray, Array]]] = deque()
    with source.open() as file, ThreadPoolExecutor(THREADS) as pool:
        file.seek(start)
        rest, offset = b"", start
        while True:
            own = spare.popleft() if spare else (bytearray(PIECE + PADDING), np.empty((layout.columns, room)))
            piece, rest = _piece(file, rest, offset, own[0])
            if piece.size:
                running.append((pool.submit(_converted, piece, layout, other, own[1]), own))
            offset += piece.size
            while running and (len(running) > THREADS or not piece.size):
                block, used = running.popleft()
                yield block.result()
                spare.append(used)
            if not piece.size:
                return


def _piece(file: BinaryIO, rest: bytes, offset: int, text: bytearray) -> tuple[_Piece, bytes]:
    """The next whole lines, at the end of the file also a line without an end; and the bytes after them."""
    text[: len(rest)] = rest
    view, filled = memoryview(text), len(rest)
    while filled < PIECE and (got := file.readinto(view[filled:PIECE])):  # type: ignore[attr-defined]
        filled += got
    size = filled
    if filled == PIECE:
        size = text.rfind(b"\n", 0, filled) + 1 or text.rfind(b"\r", 0, filled) + 1
        if not size:
            raise FileError(Issue(f"byte {offset}", f"has no line end for {PIECE} bytes", fix="write one row on each line"))
    after = bytes(view[size:filled])
    text[size : size + 1] = b"\n"
    return _Piece(text, size, offset), after


def _converted(piece: _Piece, layout: Layout, other: OtherLine, columns: Array) -> Array:
    text, targets = np.frombuffer(piece.text, np.uint8), layout.targets
    signs = ord(layout.separator or " "), ord(layout.decimal)
    at = row = 0
    while True:
        row, at = numeric_rows(text, at, piece.size, *signs, targets, layout.ending, columns, row)
        if at >= piece.size:
            return columns[:, :row]
        end = _line_end(piece, at)
        values = other(piece.offset + at, bytes(piece.text[at:end]))
        if values is not None:
            columns[:, row] = values
            row += 1
        at = end


def _line_end(piece: _Piece, at: int) -> int:
    """Index after the line that starts at `at`."""
    line = piece.text.find(b"\n", at, piece.size) + 1 or piece.size
    return piece.text.find(b"\r", at, line - 1) + 1 or line
