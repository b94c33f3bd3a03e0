"""Columns of a large file on disk: an unnamed scratch file, mapped into memory while the columns are used.

The operating system deletes the file when the last column is no longer used, also after a crash.
"""

from __future__ import annotations

import mmap
import os
import tempfile
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_PAGE = mmap.ALLOCATIONGRANULARITY
_SIZE = np.dtype(float).itemsize


class Scratch:
    """A file of `columns` columns with room for `most` rows each. Rows that are not written take no space on the disk."""

    def __init__(self, columns: int, most: int):
        self._shape = columns, -(-most * _SIZE // _PAGE) * _PAGE // _SIZE
        self._file = tempfile.TemporaryFile(prefix="rths-", buffering=0)  # noqa: SIM115 closed by __exit__
        os.ftruncate(self._file.fileno(), columns * self._shape[1] * _SIZE)

    def __enter__(self) -> Scratch:
        return self

    def __exit__(self, *error: object) -> None:
        self._file.close()  # the mapped columns keep the file

    def write(self, column: int, row: int, values: Array) -> None:
        """Write the values of one column from `row`. Raises FileError where the disk is full."""
        try:
            write_at(self._file.fileno(), (column * self._shape[1] + row) * _SIZE, values)
        except OSError as error:
            problem = f"cannot be read: its columns cannot be written to {tempfile.gettempdir()}: {error.strerror}"
            raise FileError(Issue("file", problem, fix="free disk space, or set TMPDIR to a larger folder")) from None

    def columns(self, rows: int) -> list[Array]:
        """The columns, each with its first `rows` values; they can be read only."""
        return list(np.memmap(self._file, float, "r", shape=self._shape)[:, :rows])


def write_at(descriptor: int, at: int, values: Array) -> None:
    """Write the values as float64 to an open file, from byte `at`."""
    left = np.ascontiguousarray(values, dtype=float).data.cast("B")
    while left:
        written = os.pwrite(descriptor, left, at)
        at, left = at + written, left[written:]


def kept(values: Array) -> Array:
    """The values in a scratch file of their own."""
    with Scratch(1, len(values)) as scratch:
        scratch.write(0, 0, values)
        return scratch.columns(len(values))[0]


def on_disk(values: Array) -> bool:
    """Whether the values lie in a file and not in memory."""
    return isinstance(values, np.memmap)


def release(values: Array) -> None:
    """Free the memory of values that lie in a file, until they are read again."""
    base: Any = values
    while isinstance(base, np.ndarray):
        base = base.base
    if not on_disk(values) or not isinstance(base, mmap.mmap) or not len(values):
        return
    first = values.ctypes.data - np.frombuffer(base, np.uint8).ctypes.data
    begin = first // _PAGE * _PAGE
    base.madvise(mmap.MADV_DONTNEED, begin, first + values.nbytes - begin)
