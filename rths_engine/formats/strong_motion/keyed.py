"""Headers of labelled lines (`Station Code      AOM017`, `NDATA: 19128`), with the line number of each number."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone

from rths_engine.formats.statement import Written
from rths_engine.formats.strong_motion.fortran import Line
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
FIRST_LINES = 140  # of a file, in which a header of such lines is looked for
MISSING = (-999.0, -9999.0)  # mark a sample that is missing, in a record of decimal numbers


@dataclass(frozen=True, slots=True)
class Keyed:
    """The lines of a header. A pattern is a regular expression, without case, whose first group is the value."""

    lines: list[Line]

    def find(self, pattern: str) -> Iterator[tuple[str, re.Match[str]]]:
        """Where `pattern` stands in the header, and each match."""
        for at, line in self.lines:
            if found := re.search(pattern, line, re.IGNORECASE):
                yield f"line {at}", found

    def text(self, pattern: str) -> str:
        """The first value as text; empty where the header does not state it."""
        return next((found[1].strip() for _, found in self.find(pattern)), "")

    def number(self, pattern: str) -> Written | None:
        """The first value as a number; None where the header does not state it. Raises FileError for text."""
        where, found = next(self.find(pattern), ("", None))
        if found is None or not found[1].strip():
            return None
        try:
            return Written.of(found[1].strip(), where)
        except ValueError:
            raise FileError(Issue(where, "needs a number", found[1].strip(), "correct the header")) from None

    def needed(self, pattern: str, what: str) -> Written:
        """The first value as a positive number. Raises FileError where the header does not state it."""
        stated = self.number(pattern)
        if stated is None:
            raise FileError(Issue("header", f"does not state the {what}", fix="get the file again"))
        if stated.value <= 0:
            raise FileError(Issue(stated.where, f"states an impossible {what}", f"{stated.value:g}", "correct the header"))
        return stated

    @property
    def shown(self) -> str:
        """The lines as they stand in the file."""
        return "\n".join(line for _, line in self.lines)


def numbered(lines: Iterable[str]) -> list[Line]:
    """The lines with their numbers from 1."""
    return list(enumerate(lines, start=1))


def instant(text: str, *forms: str, hours: float = 0.0) -> datetime | None:
    """The time that `text` states in one of the forms, `hours` ahead of UTC; None where it has none of them."""
    for form in forms:
        try:
            return datetime.strptime(" ".join(text.split()), form).replace(tzinfo=timezone(timedelta(hours=hours)))
        except ValueError:
            continue
    return None


def stamp(moment: datetime | None) -> str:
    """A time as text: `2008-06-14T08:44:03.000+09:00`; empty for None."""
    return "" if moment is None else moment.isoformat(timespec="milliseconds")
