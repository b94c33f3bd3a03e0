"""Stamps of date and clock as seconds from the first stamp: ISO 8601, German, British and American dates, AM and PM."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

DAY = 86400.0  # s, by definition
_SERIAL = (20_000.0, 1_000_000.0)  # days: Excel 1954 on, MATLAB's datenum; chosen, see docs/decisions/0023
_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_DATE = r"\d{4}[-/.]\d{1,2}[-/.]\d{1,2}|\d{1,2}[-/.]\d{1,2}[-/.](?:\d{4}|\d{2})|\d{1,2}[- ][A-Za-z]{3}[- ](?:\d{4}|\d{2})"
_ZONE = r"\s*(?:Z|UTC|GMT|[+-]\d{2}:?\d{2})?"
_CLOCK = r"(\d{1,2}):(\d{2}):(\d{2}(?:[.,:]\d+)?)\s*([AaPp])?\.?(?:[Mm]\.?)?"
_STAMP = re.compile(rf"(?:({_DATE})(?:T|,?\s+))?{_CLOCK}{_ZONE}")
_MINUTES = re.compile(r"(\d{1,3}):(\d{2}[.,]\d+)")
_DAY = re.compile(_DATE)
_SERIAL_NAME = re.compile(r"\b(?:date|datum|fecha|datenum|excel)", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Stamps:
    """Seconds from the first stamp, and the resolution (s) to which they are written."""

    seconds: Array
    resolution: float


def is_stamp(field: str) -> bool:
    """Whether a field is a clock, with or without a date."""
    return bool(_STAMP.fullmatch(field) or _MINUTES.fullmatch(field))


def is_day(field: str) -> bool:
    """Whether a field is a date alone."""
    return bool(_DAY.fullmatch(field))


def seconds(fields: Sequence[str], lines: Sequence[int]) -> Stamps:
    """Seconds from the first stamp. Raises FileError for a field that is no stamp, and for dates of unclear order."""
    parsed = [_parsed(field, at) for field, at in zip(fields, lines, strict=True)]
    days = {text: _days(text, lines[k]) for k, (text, _, _) in reversed(list(enumerate(parsed)))}
    clocks = np.array([clock for _, clock, _ in parsed])
    orders = [np.array([days[text][order] for text, _, _ in parsed]) for order in (0, 1)]
    possible = [DAY * (day - day[0]) + clocks for day in orders if not np.isnan(day).any()]
    if not possible:
        raise FileError(Issue(f"line {lines[0]}", "is not a valid date", fields[0], "correct the date"))
    if not parsed[0][0]:
        wraps = np.concatenate([[0.0], np.cumsum(np.diff(clocks) < -DAY / 2)])  # midnight
        possible = [clocks + DAY * wraps]
    resolution = min(digit for _, _, digit in parsed)
    best = sorted(possible, key=lambda found: float(np.max(np.abs(np.diff(found)), initial=0.0)))
    if len(best) == 2 and not np.array_equal(*best) and np.max(np.abs(np.diff(best[0]))) > 1.5 * DAY:
        fix = "write dates as 2024-01-31"
        raise FileError(Issue(f"line {lines[0]}", "the order of day and month is not clear", fields[0], fix))
    return Stamps(np.round(best[0] - best[0][0], 9), resolution)


def from_days(name: str, values: Array) -> Array | None:
    """Seconds from the first of the dates that a spreadsheet counts in days; None where the column cannot be such dates."""
    if not _SERIAL_NAME.search(name) or not np.isfinite(values).all() or not len(values):
        return None
    steps = np.diff(values)
    if values.min() < _SERIAL[0] or values.max() > _SERIAL[1] or not (np.all(steps > 0) and np.all(steps < 1)):
        return None
    found: Array = np.round((values - values[0]) * DAY, 6)
    return found


def _parsed(field: str, at: int) -> tuple[str, float, float]:
    """Date, clock (s) and the value of the last digit (s)."""
    if found := _MINUTES.fullmatch(field):
        text = found[2].replace(",", ".")
        return "", 60 * int(found[1]) + float(text), 10.0 ** -len(text.partition(".")[2])
    if not (found := _STAMP.fullmatch(field)):
        raise FileError(Issue(f"line {at}", "is not a date and a time", field, "correct or remove the line"))
    text = re.sub("[,:]", ".", found[4])
    hour = int(found[2])
    if found[5]:
        hour = hour % 12 + (12 if found[5] in "Pp" else 0)
    if hour > 24 or int(found[3]) > 59 or float(text) >= 61:
        raise FileError(Issue(f"line {at}", "is not a valid clock", field, "correct it"))
    return found[1] or "", 3600 * hour + 60 * int(found[3]) + float(text), 10.0 ** -len(text.partition(".")[2])


def _days(text: str, at: int) -> tuple[float, float]:
    """The date as a number of days, read as day-month and as month-day; NaN where it is not a valid date so."""
    if not text:
        return 0.0, 0.0
    first, second, third = re.split(r"[-/. ]", text)
    if second.isalpha():
        if second.lower() not in _MONTHS:
            raise FileError(Issue(f"line {at}", "has a month that is not known", text, "write dates as 2024-01-31"))
        both = [(third, str(_MONTHS.index(second.lower()) + 1), first)] * 2
    elif len(first) == 4:
        both = [(first, second, third)] * 2
    elif "." in text:
        both = [(third, second, first)] * 2
    else:
        both = [(third, second, first), (third, first, second)]
    return _ordinal(*both[0]), _ordinal(*both[1])


def _ordinal(year: str, month: str, day: str) -> float:
    try:
        return float(date(int(year) + (2000 if len(year) == 2 else 0), int(month), int(day)).toordinal())
    except ValueError:
        return float("nan")
