"""The keys of a FAMOS file: `|NAME,version,length,field,field,...;`, where a text field follows its own length."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rths_engine.foundation.errors import FileError, Issue

_OPENING = re.compile(rb"\|([A-Za-z]{2}),\s*(\d+)\s*,\s*(\d+)\s*,")


@dataclass(frozen=True)
class Key:
    """A key with the bytes between its length and its semicolon. Every error names the byte at which the key begins."""

    name: str
    version: int
    content: bytes
    at: int
    codepage: str

    @property
    def where(self) -> str:
        return f"key {self.name} at byte {self.at}"

    @property
    def text(self) -> str:
        return self.content.decode(self.codepage, "replace")

    def fields(self) -> list[str]:
        """The fields up to the first text field, which can contain commas."""
        return [one.strip() for one in self.text.split(",")]

    def whole(self, number: int) -> int:
        """A field as a whole number. Raises FileError."""
        return int(self.real(number))

    def real(self, number: int) -> float:
        """A field as a number. Raises FileError."""
        found = self.fields()
        try:
            return float(found[number])
        except (IndexError, ValueError, OverflowError):
            value = found[number] if number < len(found) else ""
            raise FileError(
                Issue(self.where, f"needs a number as field {number + 1}", value, "export the file again")
            ) from None

    def texts(self, number: int) -> list[str]:
        """The texts from field `number` on: each is a length, a comma, so many bytes, a comma. Raises FileError."""
        rest = self.content.split(b",", number)[-1] if number else self.content
        found = []
        while rest:
            length, _, after = rest.partition(b",")
            if not length.strip().isdigit() or int(length) > len(after):
                break
            found.append(after[: int(length)].decode(self.codepage, "replace"))
            rest = after[int(length) + 1 :]
        return found or [""]

    def body(self, number: int) -> bytes:
        """The bytes after `number` fields: the samples."""
        return self.content.split(b",", number)[-1]


def keys(raw: bytes) -> Iterator[Key]:
    """The keys one after the other. Raises FileError where the file ends within a key or another text stands between keys."""
    at, codepage = 0, "cp1252"
    while at < len(raw):
        opening = _OPENING.match(raw, at)
        if opening is None:
            if not raw[at:].strip(b"\r\n \0\x1a"):
                return
            if raw[at : at + 1] in b"\r\n ":
                at += 1
                continue
            raise FileError(Issue(f"byte {at}", "is not the beginning of a key", fix="the file is damaged: export it again"))
        begin, length = opening.end(), int(opening[3])
        content = raw[begin : begin + length]
        if len(content) != length or raw[begin + length : begin + length + 1] != b";":
            problem = f"states {length} bytes in the key {opening[1].decode()}; it does not end there"
            raise FileError(Issue(f"byte {at}", problem, fix="the file is cut or damaged: export it again"))
        key = Key(opening[1].decode(), int(opening[2]), content, at, codepage)
        if key.name == "NL" and key.fields()[0].isdigit():
            codepage = f"cp{key.fields()[0]}" if key.fields()[0] not in ("0", "65001") else "utf-8"
        yield key
        at = begin + length + 1
