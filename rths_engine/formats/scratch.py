"""Columns of a large file on disk: an unnamed scratch file, mapped into memory while the columns are used.

The operating system deletes the file when the last column is no longer used, also after a crash.
"""

from __future__ import annotations

import mmap
import os
import tempfile

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_PAGE = mmap.ALLOCATIONGRANULARITY
_SIZE = np.dtype(float).itemsize


class Scratch:
    """A file of `columns` columns with room for `most` rows each. Rows that are not written take no space on the disk."""

    def __init__(self, columns: int, most: int):
        self._stride = -(-most * _SIZE // _PAGE) * _PAGE
        self._file = tempfile.TemporaryFile(prefix="rths-", buffering=0)  # noqa: SIM115 closed by __exit__
        os.ftruncate(self._file.fileno(), columns * self._stride)
        self._columns = columns

    def __enter__(self) -> Scratch:
        return self

    def __exit__(self, *error: object) -> None:
        self._file.close()  # the mapped columns keep the file

    def write(self, row: int, block: Array) -> None:
        """Write the rows of `block` (columns, rows) from `row`. Raises FileError where the disk is full."""
        for column, values in enumerate(block):
            at, left = column * self._stride + row * _SIZE, memoryview(values).cast("B")
            try:
                while left:
                    written = os.pwrite(self._file.fileno(), left, at)
                    at, left = at + written, left[written:]
            except OSError as error:
                problem = f"cannot be read: its columns cannot be written to {tempfile.gettempdir()}: {error.strerror}"
                raise FileError(Issue("file", problem, fix="free disk space, or set TMPDIR to a larger folder")) from None

    def columns(self, rows: int) -> list[Array]:
        """The columns, each with its first `rows` values; they can be read only."""
        return [
            np.memmap(self._file, float, "r", offset=column * self._stride, shape=(rows,)) for column in range(self._columns)
        ]


def on_disk(values: Array) -> bool:
    """Whether the values are a column in a scratch file."""
    return isinstance(values, np.memmap)


def release(values: Array) -> None:
    """Free the memory of a column in a scratch file until its values are read again."""
    if isinstance(values, np.memmap) and isinstance(values.base, mmap.mmap):
        values.base.madvise(mmap.MADV_DONTNEED)
