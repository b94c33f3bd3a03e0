"""A line of numbers above the data: `400`, `400 0.01` or `400, 0.01, g` state the count, the step (s) and the unit."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rths_engine.formats.plain.form import COMMENT, Line
from rths_engine.formats.plain.header_facts import Facts
from rths_engine.formats.plain.header_lines import LONGEST_UNSTATED
from rths_engine.formats.statement import Written
from rths_engine.foundation import unit_names
from rths_engine.foundation.errors import FileError, Issue

_TOKENS = re.compile(
    r"([1-9]\d{0,17})\.?(?:[\s,;]+(\d*[.,]\d+(?:[eEdD][-+]?\d+)?)(?:\s*s(?:ec)?)?)?(?:[\s,;]+([A-Za-z][\w/^*²-]*))?[\s,;]*"
)
_NUMBERS = re.compile(r"[-+\d.,;\seEdD]*\d[-+\d.,;\seEdD]*")
_ROWS_OF_NAMES = 3  # names, units, and the numbers above; chosen, see docs/decisions/0023


@dataclass(frozen=True, slots=True)
class CountLine:
    """The numbers of the line; the step and the unit where it has them."""

    line: Line
    count: int
    step: Written | None
    unit: unit_names.Written


def parsed(line: Line) -> CountLine | None:
    """The line as a count with or without a step and a unit; None where it is something else."""
    at, text = line
    found = _TOKENS.fullmatch(text.strip())
    if not found or int(found[1]) < 2:
        return None
    unit = unit_names.read(found[3] or "")
    step = Written.of(found[2].replace(",", "."), f"line {at}") if found[2] else None
    if unit.problem or (step is not None and not 0 < step.value <= LONGEST_UNSTATED):
        return None
    return CountLine(line, int(found[1]), step, unit)


def added(facts: Facts, found: CountLine) -> Facts:
    """The facts with those of the line."""
    where = f"line {found.line[0]}"
    steps = (*facts.steps, found.step) if found.step is not None else facts.steps
    units = facts.units if found.unit.none else (found.unit,)
    return replace(facts, counts=(*facts.counts, Written(found.count, 0.0, where)), steps=steps, units=units)


def with_numbers_above(facts: Facts, header: Sequence[Line], count: int, columns: int) -> Facts:
    """The facts with those of a line of numbers in the header that states `count`.

    Raises FileError where numbers directly above the data, or above the names of their `columns`, state another count: they can
    be a count or a sample.
    """
    for line in header:
        if (found := parsed(line)) is not None and found.count == count:
            facts = added(facts, found)
    above = next((line for line in reversed(header[-_ROWS_OF_NAMES:]) if not _is_heading(line[1])), None)
    if above is not None and _NUMBERS.fullmatch(above[1]) and not COMMENT.match(above[1].lstrip()):
        found = parsed(above)
        if found is None or found.count not in {count, columns}:
            raise refusal(above, count)
    return facts


def _is_heading(text: str) -> bool:
    """Whether a line can hold names or units of several columns."""
    return len(re.split(r"[\t;,]|\s{2,}|\s", text.strip())) > 1 and not _NUMBERS.fullmatch(text)


def refusal(line: Line, count: int) -> FileError:
    """The refusal of numbers above the data that are neither samples nor the count of the samples."""
    place = f"above {count} samples" if count else "below the samples"
    problem = f"stands {place}: it can be a count, a step or a sample"
    fix = "correct the count, or remove the line if it is no sample"
    return FileError(Issue(f"line {line[0]}", problem, line[1].strip(), fix))
