"""The errors of the engine. Every error says what is wrong, where, the value, its bound and how to mend it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from itertools import islice
from typing import Any

MOST_ISSUES = 100  # listed of one input; chosen; see docs/decisions/0023


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
        given = "" if self.value is None else f" = {_short(self.value)}"
        fix = f" ({self.fix})" if self.fix else ""
        return f"{self.where}{given}: {self.problem}{fix}" if self.where else f"{self.problem}{fix}"

    def as_dict(self) -> dict[str, Any]:
        found = {**asdict(self), "value": None if self.value is None else _short(self.value)}
        return found if self.lines else {name: value for name, value in found.items() if name != "lines"}


class RthsError(Exception):
    """An input or state that the engine cannot use. `issues` lists all problems, not only the first."""

    def __init__(self, issues: Issue | str | Iterable[Issue]):
        if isinstance(issues, str):
            issues = Issue("", issues)
        self.issues: tuple[Issue, ...] = (issues,) if isinstance(issues, Issue) else tuple(issues)
        super().__init__("\n".join(str(issue) for issue in self.issues))


def limited(issues: Iterable[Issue], count: int) -> Iterator[Issue]:
    """The first MOST_ISSUES of `count` issues, then one that tells how many are left. The rest is never made."""
    yield from islice(issues, MOST_ISSUES)
    if count > MOST_ISSUES:
        yield Issue("", f"has {count - MOST_ISSUES} more errors that are not listed", fix="mend the listed ones first")


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


def _short(value: Any, limit: int = 80) -> str:
    text = value if isinstance(value, str) else repr(value)
    return text if len(text) <= limit else text[: limit - 1] + "…"
