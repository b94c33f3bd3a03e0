"""The errors of the engine. Every error says what is wrong, where, the value, its bound and how to mend it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from itertools import islice
from typing import Any

# chosen; see docs/decisions/0023
MOST_ISSUES = 100  # listed of one input
LONGEST = {"where": 200, "problem": 600, "value": 80, "fix": 600}  # characters of an issue's parts: inputs can hold long names


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a text file: its number from 1 and its text, which may be cut."""

    number: int
    text: str


@dataclass(frozen=True, slots=True)
class Issue:
    """One problem of an input.

    `where` is a dotted path into the input (`stations.0.actuator.alpha`, indices from 0; empty for the whole input). `value`
    is the value given, `problem` the bound or rule that it breaks, and `fix` how to mend it. `lines` is the line of a text file
    that `where` names, with its neighbours.
    """

    where: str
    problem: str
    value: Any = None
    fix: str | None = None
    lines: tuple[Line, ...] = field(default=(), compare=False)

    def __str__(self) -> str:
        where, problem, value, fix = self._parts().values()
        told = f"{problem} ({fix})" if fix else problem
        given = "" if value is None else f" = {value}"
        return f"{where}{given}: {told}" if where else str(told)

    def as_dict(self) -> dict[str, Any]:
        return self._parts() | ({"lines": [asdict(line) for line in self.lines]} if self.lines else {})

    def _parts(self) -> dict[str, str | None]:
        """Where, problem, value and fix as texts of bounded length."""
        return {name: _short(getattr(self, name), longest) for name, longest in LONGEST.items()}


class RthsError(Exception):
    """An input or state that the engine cannot use. `issues` lists all problems, not only the first."""

    def __init__(self, issues: Issue | str | Iterable[Issue]):
        if isinstance(issues, str):
            issues = Issue("", issues)
        self.issues: tuple[Issue, ...] = (issues,) if isinstance(issues, Issue) else _bounded(issues)
        super().__init__("\n".join(str(issue) for issue in self.issues))


def limited(issues: Iterable[Issue], count: int) -> Iterator[Issue]:
    """The first MOST_ISSUES of `count` issues, then one that tells how many are left. The rest is never made."""
    yield from islice(issues, MOST_ISSUES)
    if count > MOST_ISSUES:
        yield Issue("", f"has {count - MOST_ISSUES} more errors that are not listed", fix="mend the listed ones first")


def _bounded(issues: Iterable[Issue]) -> tuple[Issue, ...]:
    """All issues, or the first MOST_ISSUES and one that says that there are more; the others are never made."""
    found = tuple(islice(issues, MOST_ISSUES + 2))
    more = Issue("", "has more errors that are not listed", fix="mend the listed ones first")
    return found if len(found) < MOST_ISSUES + 2 else (*found[:MOST_ISSUES], more)


def renamed(error: RthsError, names: Mapping[str, str]) -> RthsError:
    """The error with new names for its inputs.

    With `heldout.0` -> `Held-out recording 1`, an issue at `heldout.0` or below it is reported at `Held-out recording 1`. The
    command line and the service use different names for the same inputs.
    """

    def name(where: str) -> str:
        known = [path for path in names if where == path or where.startswith(f"{path}.")]
        path = max(known, key=len, default="")
        return names[path] + where[len(path) :] if path else where

    return type(error)(replace(issue, where=name(issue.where)) for issue in error.issues)


class PlanError(RthsError):
    """A test plan that cannot run as written."""


class FileError(RthsError):
    """A file that cannot be read, or whose header contradicts its data."""


class MotionError(RthsError):
    """A ground-motion record that does not exist, cannot be read or cannot be used."""


class RecordingError(RthsError):
    """A recording that is missing, damaged or not in the expected format."""


class MeasuredError(RthsError):
    """A file of measurements, or its mapping, that cannot be imported."""


def cut(text: str, longest: int) -> str:
    """A text of at most `longest` characters."""
    return text if len(text) <= longest else text[: longest - 1] + "…"


def _short(value: Any, longest: int) -> str | None:
    """A part of an issue as text."""
    if value is None:
        return None
    if isinstance(value, list | tuple):
        value = value[:longest]  # what comes later is cut
    try:
        return cut(value if isinstance(value, str) else repr(value), longest)
    except (ValueError, RecursionError):  # a whole number of thousands of digits, or deep nesting
        return "too long to be shown"
