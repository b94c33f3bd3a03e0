"""A file to read: a path or bytes, its name, and its first lines, by which its format is recognised."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

from rths_engine.formats import encodings, lines
from rths_engine.foundation.errors import FileError, Issue

LARGEST = 200_000_000  # bytes of a file that is held in memory to be read; chosen, see docs/decisions/0023
HEAD = 1 << 16  # bytes by which a format is recognised; chosen, see docs/decisions/0023


@dataclass(frozen=True)
class Source:
    """The content of a file, in memory (`content`) or on disk (`path`), and the name that its owner gave it."""

    name: str
    path: Path | None = None
    content: bytes | None = field(default=None, repr=False)

    @cached_property
    def size(self) -> int:
        """Size in bytes."""
        return len(self.content) if self.content is not None else self._path.stat().st_size

    @cached_property
    def head(self) -> bytes:
        """The first bytes, all bytes of a small file."""
        if self.content is not None:
            return self.content[:HEAD]
        with self._path.open("rb") as file:
            return file.read(HEAD)

    @cached_property
    def tail(self) -> bytes:
        """The last bytes, at most 64."""
        if self.content is not None:
            return self.content[-64:]
        with self._path.open("rb") as file:
            file.seek(max(0, self.size - 64))
            return file.read()

    def open(self) -> BinaryIO:
        """The content as an open file."""
        return BytesIO(self.content) if self.content is not None else self._path.open("rb", buffering=0)

    def part(self, start: int, size: int) -> bytes:
        """At most `size` bytes from byte `start`."""
        with self.open() as file:
            file.seek(start)
            return file.read(size)

    def bytes(self) -> bytes:
        """The whole content. Raises FileError for a file too large to be held in memory."""
        if self.size > LARGEST:
            problem = f"has {self.size / 1e6:.0f} MB; a file of this format can have {LARGEST / 1e6:.0f} MB"
            raise FileError(Issue("file", problem, fix="export fewer signals or a shorter time, or export it as CSV"))
        return self.content if self.content is not None else self._path.read_bytes()

    def in_utf8(self) -> Source:
        """The source, with text in UTF-16 or in a known code page in UTF-8. Raises FileError where such text is damaged."""
        utf16 = self.head.startswith((b"\xff\xfe", b"\xfe\xff"))
        encoding = "utf-16" if utf16 else encodings.of(self.head)
        if not encoding:
            return self
        try:
            return Source(self.name, content=self.bytes().decode(encoding).encode("utf-8"))
        except UnicodeDecodeError as error:
            called = "UTF-16" if utf16 else encoding
            problem = f"begins as {called} text and is damaged at byte {error.start}"
            raise FileError(Issue("file", problem, fix="save it as plain text (UTF-8)")) from None

    @cached_property
    def head_lines(self) -> list[str]:
        """The lines in the first bytes; empty for binary content."""
        whole = self.size <= len(self.head)
        try:
            found = lines.lines_of(self.head)
        except FileError:
            return []
        return found if whole else found[:-1]

    @cached_property
    def lines(self) -> list[str]:
        """All lines. Raises FileError for content that is not text."""
        return lines.lines_of(self.bytes())

    @property
    def extension(self) -> str:
        """Extension of the name in lower case, without the dot."""
        return Path(self.name.replace("\\", "/")).suffix.lower().lstrip(".")

    @property
    def _path(self) -> Path:
        if self.path is None:
            raise FileError(Issue("file", "has neither a path nor content"))
        return self.path
