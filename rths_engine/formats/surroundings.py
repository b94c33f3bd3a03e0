"""The lines around the line of a file that an error names, so that its reader sees what is meant."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable
from dataclasses import replace
from itertools import islice

from rths_engine.formats.lines import decoded
from rths_engine.formats.source import Source
from rths_engine.foundation.errors import Issue, Line

# chosen; see docs/decisions/0023
AROUND = 2  # lines before and after the named line
LONGEST = 240  # characters of a line that are kept

_NAMED = re.compile(r"\bline (\d+)\b")


def shown(issues: Iterable[Issue], source: Source) -> tuple[Issue, ...]:
    """The issues, each with the lines of the file around the line that it names."""
    return tuple(
        replace(issue, lines=around(source, int(found[1]))) if (found := _NAMED.search(issue.where)) else issue
        for issue in issues
    )


def around(source: Source, number: int) -> tuple[Line, ...]:
    """The line `number` (from 1) of a text file with the lines before and after it; fewer at the ends of the file."""
    first = max(1, number - AROUND)
    with source.open() as raw:
        text = io.TextIOWrapper(io.BufferedReader(raw), encoding="latin-1", newline=None)  # type: ignore[type-var]
        found = islice(text, first - 1, number + AROUND)
        return tuple(Line(at, _short(decoded(line.encode("latin-1")))) for at, line in enumerate(found, start=first))


def _short(line: str) -> str:
    plain = "".join(sign if sign.isprintable() or sign == "\t" else "\N{REPLACEMENT CHARACTER}" for sign in line)
    return plain if len(plain) <= LONGEST else plain[: LONGEST - 1] + "…"
