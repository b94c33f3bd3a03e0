"""Numbers in fixed Fortran columns, as strong-motion formats write them: `(8F10.5)`, `(10I8)`, `(5F15.6)`.

Numbers can touch (`-999.00000 5.0000000-999.00000`), so that the columns separate them, not the blanks. A number ends in the
last column of its field. A line whose blanks separate as many numbers as the format puts on a line is read by its blanks.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rths_engine.formats.statement import Written, last_digit
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_WRITTEN = re.compile(r"\(\s*(?:(\d+)\s*X\s*,\s*)?(\d+)\s*[FEGID]\s*(\d+)(?:\.(\d+))?\s*\)", re.IGNORECASE)
_NOT_A_NUMBER = re.compile(r"[^-+.\deEdD\s]")

_FOUR_DIGITS = 5e-4  # rounding to four digits; chosen, see docs/decisions/0023

Line = tuple[int, str]  # line number from 1, and the line


@dataclass(frozen=True, slots=True)
class Columns:
    """Fields of `width` characters, `per_line` on each line, after `before` blanks.

    `digits`: how many follow the point; by them a number that blanks separate is whole. None: any number of digits.
    """

    per_line: int
    width: int
    before: int = 0
    digits: int | None = None

    @classmethod
    def written(cls, text: str) -> Columns | None:
        """The columns of a format such as `(8F10.5)` in `text`; None where it contains no format."""
        found = _WRITTEN.search(text)
        if found is None or not int(found[2]) or not int(found[3]):
            return None
        return cls(int(found[2]), int(found[3]), int(found[1] or 0), int(found[4]) if found[4] else None)

    def fields(self, line: str, where: str) -> list[str]:
        """The numbers of a line, as they are written. Raises FileError where the columns do not separate them."""
        text = line.rstrip()
        if "*" in text:
            fix = "get the record in another format: the number is lost"
            raise FileError(Issue(where, "contains a number that is too large for its columns", text.strip(), fix))
        if _NOT_A_NUMBER.search(text):
            raise FileError(Issue(where, "is not a row of numbers", text.strip(), "correct or remove it"))
        parts = [text[start : start + self.width] for start in range(self.before, len(text), self.width)]
        if not text[: self.before].strip() and all(len(one) == self.width and _is_number(one) for one in parts):
            return [one.strip() for one in parts]
        tokens = text.split()
        if len(tokens) <= self.per_line and all(_is_number(one) and self._is_whole(one) for one in tokens):
            return tokens
        form = f"{self.per_line} columns of {self.width} characters"
        raise FileError(
            Issue(where, f"does not follow the format of {form}", text.strip(), "write the numbers in these columns")
        )

    def _is_whole(self, text: str) -> bool:
        return self.digits is None or len(re.split("[eEdD]", text.partition(".")[2])[0]) == self.digits


def _is_number(text: str) -> bool:
    if text[-1:].isspace():
        return False
    try:
        return math.isfinite(number(text))
    except ValueError:
        return False


def number(text: str) -> float:
    """The value of a number as Fortran writes it, also with a D exponent."""
    return float(text.replace("D", "E").replace("d", "e"))


def stated(text: str, where: str) -> Written:
    """A number of a header, also where Fortran filled it up with zeros: `-29.340` of a program that keeps four digits."""
    written = Written.of(text, where)
    filled = last_digit(text.strip().rstrip("0")) / 2 if "." in text and text.strip().endswith("0") else 0.0
    return Written(written.value, max(written.within, min(filled, _FOUR_DIGITS * abs(written.value))), where)


@dataclass(frozen=True, slots=True, eq=False)
class Series:
    """The numbers of a block of data. `rounding`: half a unit of the last digit of the largest number."""

    values: Array
    rounding: float


def header(lines: Sequence[Line], columns: Columns) -> list[str]:
    """All header values on the lines, as they are written."""
    free = replace(columns, digits=None)
    return [text for at, line in lines for text in free.fields(line, f"line {at}")]


def series(lines: Iterable[Line], columns: Columns, missing: Sequence[float] = ()) -> Series:
    """The numbers of a block of data, with `columns.per_line` numbers on each line but the last.

    Raises FileError with the line for a short line before the last, for text, for columns that cannot be separated, and for a
    number that marks a missing value.
    """
    found: list[str] = []
    short = ""
    for at, line in lines:
        if not line.strip():
            continue
        fields = columns.fields(line, f"line {at}")
        if short or len(fields) > columns.per_line:
            where = short or f"line {at}"
            many = len(found) % columns.per_line if short else len(fields)
            problem = f"has {many} numbers; each line but the last has {columns.per_line}"
            raise FileError(Issue(where, problem, fix="get the file again: numbers are missing or added"))
        if len(fields) < columns.per_line:
            short = f"line {at}"
        for text in fields:
            if missing and number(text) in missing:
                problem = "contains the value that marks a missing sample"
                raise FileError(Issue(f"line {at}", problem, text, "give a record without gaps"))
        found += fields
    values = np.array([number(text) for text in found])
    largest = found[int(np.argmax(np.abs(values)))] if found else "0"
    return Series(values, last_digit(largest) / 2)
