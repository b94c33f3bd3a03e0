"""Filters as text in an address: `mte_mm:1<0.5;plan.stations.0.compensator.alpha_es>=30;tag=calibration`.

Conditions are separated by semicolons, and all must hold. The operators are `=  !=  <  <=  >  >=`, `~` (contains) and `!~`.
Alternatives of `=` and `!=` are separated by `|`. No value means that the run has no value: `mte_mm:1=`. A value that contains
`;`, `|` or a quotation mark stands in quotation marks, each one inside written twice.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rths_engine.foundation.errors import Issue, RthsError

MOST_CONDITIONS = 20
LONGEST = 4000  # characters of a whole filter
OPERATORS = ("!=", ">=", "<=", "!~", "~", "=", "<", ">")
_CONDITION = re.compile(r"\s*([A-Za-z_][\w.]*(?::\w+)?)\s*(!=|>=|<=|!~|~|=|<|>)\s*(.*?)\s*", re.DOTALL)
_QUOTED = re.compile(r'"(?:[^"]|"")*"')


@dataclass(frozen=True, slots=True)
class Condition:
    """One condition of a filter: a column, an operator, and the values as written. No value: the run has none."""

    key: str
    operator: str
    values: tuple[str, ...]
    text: str


def read(where: str) -> list[Condition]:
    """The conditions of a filter. Raises RthsError for text that is not a filter."""
    if len(where) > LONGEST:
        raise RthsError(Issue("where", f"has {len(where)} characters; the limit is {LONGEST} characters", where[:80]))
    parts = [part for part in _split(where, ";") if part.strip()]
    if len(parts) > MOST_CONDITIONS:
        raise RthsError(Issue("where", f"has {len(parts)} conditions; the limit is {MOST_CONDITIONS}", where[:80]))
    return [_condition(part) for part in parts]


def _condition(part: str) -> Condition:
    found = _CONDITION.fullmatch(part)
    if found is None:
        fix = "write a column, an operator (= != < <= > >= ~ !~) and a value, such as mte_mm:1<0.5"
        raise RthsError(Issue("where", "is not a valid condition", part.strip(), fix))
    key, operator, rest = found.groups()
    several = _split(rest, "|") if operator in ("=", "!=") else [rest]
    values = tuple(text for text in (_bare(one) for one in several) if text)
    if not values and operator not in ("=", "!="):
        raise RthsError(Issue("where", f"needs a value after {operator}", part.strip()))
    return Condition(key, operator, values, part.strip())


def _split(text: str, mark: str) -> list[str]:
    """The parts between marks that do not stand in quotation marks."""
    return list(_parts(text, mark))


def _parts(text: str, mark: str) -> Iterator[str]:
    first = at = 0
    while at < len(text):
        quoted = _QUOTED.match(text, at)
        if quoted:
            at = quoted.end()
            continue
        if text[at] == mark:
            yield text[first:at]
            first = at + 1
        at += 1
    yield text[first:]


def _bare(text: str) -> str:
    text = text.strip()
    return text[1:-1].replace('""', '"') if _QUOTED.fullmatch(text) else text
