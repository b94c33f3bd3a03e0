"""The chain of the audit log: hash = SHA-256(hash of the entry before + canonical JSON of the entry).

Canonical JSON is RFC 8785: sorted keys, no spaces, UTF-8. Numbers that are not whole are stored as text, because programs
write them differently. docs/audit.md shows the check as ten lines of Python.
"""

from __future__ import annotations

import hashlib
import json
from datetime import UTC, datetime
from typing import Any, NamedTuple

from app.text import cleaned

GENESIS = "0" * 64  # the hash before the first entry


class Head(NamedTuple):
    """Number and hash of the last entry of a chain; number 0 is a chain without entries."""

    number: int
    hash: str


EMPTY = Head(0, GENESIS)


class Entry(NamedTuple):
    """The content of an entry. `details` is canonical JSON."""

    number: int
    at: datetime
    who: str
    role: str
    signed_in: str
    action: str
    about: str
    details: str

    @property
    def text(self) -> str:
        """Canonical JSON of the entry; the stored text of `details` stands in it as it is."""
        at = self.at.astimezone(UTC).isoformat(timespec="microseconds").replace("+00:00", "Z")
        about, action, role, signed_in, who = (
            json.dumps(text, ensure_ascii=False) for text in (self.about, self.action, self.role, self.signed_in, self.who)
        )
        return (
            f'{{"about":{about},"action":{action},"at":"{at}","details":{self.details},"number":{self.number},'
            f'"role":{role},"signed_in":{signed_in},"who":{who}}}'
        )


def digest(previous: str, entry: Entry) -> str:
    """The hash of an entry that follows the entry with the hash `previous`."""
    return hashlib.sha256(f"{previous}{entry.text}".encode()).hexdigest()


def canonical(data: Any) -> str:
    """JSON data as canonical text."""
    return json.dumps(_plain(cleaned(data)), ensure_ascii=False, sort_keys=True, separators=(",", ":"))


def line(entry: Entry, previous: str, hash_: str) -> str:
    """An entry as one line of an export."""
    return f'{{"entry":{entry.text},"hash":"{hash_}","previous":"{previous}"}}\n'


def _plain(data: Any) -> Any:
    """The data with text in place of every value that JSON programs write differently."""
    if isinstance(data, dict):
        return {str(key): _plain(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_plain(one) for one in data]
    return data if data is None or isinstance(data, str | bool | int) else str(data)
