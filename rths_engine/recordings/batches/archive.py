"""A ZIP archive of files of measurements, opened within limits; nothing is written under a name from the archive.

An archive is refused as a whole where it can be meant to harm: too many files, too large when unpacked, compressed beyond what
measurements allow, links, names that lead out of its folder. A single damaged or encrypted file in it is refused alone.
"""

from __future__ import annotations

import stat
import struct
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import IO, BinaryIO

from rths_engine.foundation.errors import Issue, MeasuredError

# chosen; see docs/decisions/0023
MOST_FILES = 1000
MOST_BYTES = 20 * 10**9  # of all files together, unpacked
MOST_RATIO = 300  # unpacked over packed size of one file; text of measurements compresses to a twentieth
SMALL = 10**6  # bytes: the ratio of smaller files does not matter
LONGEST_ENTRY = 1000  # bytes of the directory of an archive for each file

# the end of the directory of an archive: APPNOTE 6.3.10, 4.3.14 to 4.3.16, in docs/decisions/0028
_END, _LOCATOR, _END64 = b"PK\x05\x06", b"PK\x06\x07", b"PK\x06\x06"
_END_SIZE, _LOCATOR_SIZE, _LONGEST_COMMENT = 22, 20, 1 << 16

_OF_THE_SYSTEM = frozenset({"__MACOSX", "Thumbs.db", "desktop.ini"})
_ENCRYPTED = 1  # a bit of the flags of a file, by definition of the format
_DAMAGED = (zipfile.BadZipFile, zlib.error, EOFError, OSError, NotImplementedError, RuntimeError, ValueError)


@dataclass(frozen=True)
class Limits:
    """The largest archive: number of files, bytes of all files when unpacked, and unpacked over packed size of each."""

    files: int = MOST_FILES
    bytes: int = MOST_BYTES
    ratio: float = MOST_RATIO


class Unpacked:
    """A file of an archive, unpacked as it is read, from its start to its end."""

    def __init__(self, stream: IO[bytes]):
        self._stream = stream

    def read(self, size: int = -1, /) -> bytes:
        """The next bytes, at most `size`, or all. Raises MeasuredError where they are damaged."""
        try:
            return self._stream.read(size)
        except _DAMAGED as error:
            raise _damaged(error) from None


class Archive:
    """A ZIP archive in an open file. Raises MeasuredError where it is not one or is beyond the limits; `name` is for errors."""

    def __init__(self, file: BinaryIO, name: str, limits: Limits | None = None):
        self.name, self.limits = name, limits or Limits()
        self._refuse_directory(file)
        try:
            self._file = zipfile.ZipFile(file)
        except _DAMAGED as error:
            raise self._refused(f"is not a complete ZIP archive: {error}", fix="make the archive again") from None
        self._members = {one.filename: one for one in self._file.infolist() if not one.is_dir() and wanted(one.filename)}
        try:
            self._check()
        except MeasuredError:
            self._file.close()
            raise

    @property
    def names(self) -> list[str]:
        """Names of the files, sorted; hidden files and those of operating systems are left out."""
        return sorted(self._members)

    @contextmanager
    def open(self, name: str) -> Iterator[Unpacked]:
        """A file of the archive, unpacked as it is read. Raises MeasuredError where it is damaged or encrypted."""
        member = self._members[name]
        if member.flag_bits & _ENCRYPTED:
            raise MeasuredError(Issue("file", "is encrypted", fix="make the archive again without a password"))
        try:
            stream = self._file.open(member)
        except _DAMAGED as error:
            raise _damaged(error) from None
        with stream:
            yield Unpacked(stream)

    def close(self) -> None:
        self._file.close()

    def _check(self) -> None:
        members = self._file.infolist()
        self._refuse_many(len(self._members))
        twice = [name for name, count in Counter(one.filename for one in members).items() if count > 1]
        if twice:
            raise self._refused("contains two files of one name", twice[0], "give each file its own name")
        for one in members:
            if _leads_out(one.filename):
                raise self._refused("contains a name that leads out of the archive", one.filename, "make the archive again")
            if stat.S_ISLNK(one.external_attr >> 16):
                raise self._refused("contains a link", one.filename, "put the file itself into the archive")
            if one.file_size > SMALL and one.file_size > self.limits.ratio * max(1, one.compress_size):
                ratio = f"{one.filename}, {one.file_size / max(1, one.compress_size):.0f} times its packed size"
                fix = "no measurements are compressed so much; import the file itself"
                raise self._refused(f"contains a file of more than {self.limits.ratio:g} times its packed size", ratio, fix)
        if not self._members:
            raise self._refused("contains no file", fix="put the files of measurements into the archive")
        size = sum(one.file_size for one in members)
        if size > self.limits.bytes:
            problem = f"unpacks to more than {self.limits.bytes / 1e6:g} MB"
            raise self._refused(problem, f"{size / 1e6:.6g} MB", "import fewer files at a time")

    def _refuse_many(self, files: int) -> None:
        if files > self.limits.files:
            problem = f"contains more than {self.limits.files} files"
            raise self._refused(problem, str(files), "import fewer files at a time")

    def _refuse_directory(self, file: BinaryIO) -> None:
        """Refuse an archive whose directory is larger than the limits allow, before it is read into memory."""
        size = _directory_size(file)
        if size is None:
            raise self._refused("is not a complete ZIP archive", fix="make the archive again")
        if size > self.limits.files * LONGEST_ENTRY:
            raise self._refused(f"contains more than {self.limits.files} files", fix="import fewer files at a time")

    def _refused(self, problem: str, value: str | None = None, fix: str | None = None) -> MeasuredError:
        return MeasuredError(Issue(self.name, problem, value, fix))


def _damaged(error: Exception) -> MeasuredError:
    return MeasuredError(Issue("file", f"is damaged in the archive: {error}", fix="make the archive again"))


def wanted(name: str) -> bool:
    """Whether a name is not that of a hidden file or of a file that operating systems add to folders and archives."""
    return not any((part.startswith(".") and part != "..") or part in _OF_THE_SYSTEM for part in PurePosixPath(name).parts)


def _leads_out(name: str) -> bool:
    path = PurePosixPath(name)
    return path.is_absolute() or ".." in path.parts or "\\" in name or ":" in name or not name.isprintable()


def _directory_size(file: BinaryIO) -> int | None:
    """Bytes of the directory of an archive, as the module `zipfile` finds it; None where there is none."""
    end = file.seek(0, 2)
    start = max(0, end - _END_SIZE - _LONGEST_COMMENT)
    file.seek(start)
    tail = file.read()
    at = len(tail) - _END_SIZE if tail[-_END_SIZE:].startswith(_END) and tail.endswith(b"\0\0") else tail.rfind(_END)
    if at < 0 or len(tail) - at < _END_SIZE:
        return None
    size: int = struct.unpack_from("<L", tail, at + 12)[0]
    locator = start + at - _LOCATOR_SIZE
    if locator < 0:
        return size
    file.seek(locator)
    found = file.read(_LOCATOR_SIZE)
    if not found.startswith(_LOCATOR):
        return size
    file.seek(locator - 56)
    record = file.read(56)
    return int(struct.unpack_from("<Q", record, 40)[0]) if record.startswith(_END64) else None
