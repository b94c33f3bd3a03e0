"""The check of the whole chain of the audit log."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from app.audit.chain import EMPTY, Head, digest
from app.audit.log import AuditLog, Kept


class Broken(NamedTuple):
    """The first entry that does not fit the chain, and why."""

    number: int
    problem: str


class Checked(NamedTuple):
    """The result of a check: number of entries that fit, the last of them, and where the chain is broken, if it is."""

    entries: int
    head: Head
    broken: Broken | None


def check(log: AuditLog, noted: Head | None = None) -> Checked:
    """Check every entry, and that the chain ends where the row of the head says.

    `noted` is a head that was noted elsewhere earlier. The chain must still contain it: this detects a chain whose end was cut
    off, or that was computed anew.
    """
    stated = log.head()
    found = walked(log.entries(), noted)
    if found.broken or found.head.number > stated.number:  # entries were added meanwhile
        return found
    if found.head != stated:
        missing = found.head.number + 1
        problem = f"is missing: the log ends with entry {found.head.number}, but its head states {stated.number}"
        if found.head.number == stated.number:
            missing, problem = stated.number, "has another hash than the head states"
        return found._replace(broken=Broken(missing, problem))
    return found


def walked(entries: Iterable[Kept], noted: Head | None = None) -> Checked:
    """Check that entries make a chain from the first one on, which contains the head `noted`."""
    last, count = EMPTY, 0
    for kept in entries:
        problem = _problem(kept, last, noted)
        if problem:
            return Checked(count, last, Broken(min(kept.entry.number, last.number + 1), problem))
        last, count = Head(kept.entry.number, kept.hash), count + 1
    if noted is not None and noted.number > last.number:
        problem = f"is missing: its hash was noted, but the log ends with entry {last.number}"
        return Checked(count, last, Broken(noted.number, problem))
    return Checked(count, last, None)


def _problem(kept: Kept, last: Head, noted: Head | None) -> str:
    """What is wrong with an entry that follows the entry `last`; empty where nothing is."""
    number = kept.entry.number
    if number != last.number + 1:
        return f"is missing: entry {number} follows entry {last.number}"
    if kept.previous != last.hash:
        return f"does not follow entry {last.number}: it states another hash of the entry before it"
    if digest(last.hash, kept.entry) != kept.hash:
        return "was changed: its hash is not that of its content"
    if noted is not None and number == noted.number and kept.hash != noted.hash:
        return "has another hash than the one that was noted"
    return ""
