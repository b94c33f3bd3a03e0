"""Dates with times of day, as loggers write them for each row, as seconds; and the step that they show."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import date

import numpy as np

from rths_engine.formats.laboratory.rows import Line
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# by definition
_DAY = 86400.0  # s
_NOON = 12  # hours

_STAMP = re.compile(r"(\d+)[-/.](\d+)[-/.](\d+)[ T]+(\d{1,2}):(\d{2}):(\d{2}(?:[.,]\d+)?)\s*([AP]M)?", re.IGNORECASE)


def seconds(texts: Sequence[str], lines: Sequence[Line]) -> Array:
    """Seconds after the first stamp. A date is year-month-day, or month/day/year, or day/month/year where no month fits.

    Raises FileError with the line for a text that is not a date and a time.
    """
    found = [_STAMP.fullmatch(text.strip().strip('"')) for text in texts]
    day_first = any(one is not None and len(one[1]) < 3 and int(one[1]) > _NOON for one in found)
    days, times = np.empty(len(texts)), np.empty(len(texts))
    for k, one in enumerate(found):
        try:
            if one is None:
                raise ValueError
            days[k], times[k] = _day(one, day_first), _time(one)
        except ValueError:
            raise FileError(Issue(f"line {lines[k][0]}", "is not a date and a time", texts[k], "correct the line")) from None
    return (days - days[0]) * _DAY + (times - times[0]) if len(texts) else times


def _day(found: re.Match[str], day_first: bool) -> int:
    one, two, three = int(found[1]), int(found[2]), int(found[3])
    year, month, day = (one, two, three) if len(found[1]) > 2 else (three, two, one) if day_first else (three, one, two)
    return date(year, month, day).toordinal()


def _time(found: re.Match[str]) -> float:
    hour = int(found[4])
    if found[7]:
        hour = hour % _NOON + (_NOON if found[7].upper() == "PM" else 0)
    return hour * 3600.0 + int(found[5]) * 60.0 + float(found[6].replace(",", "."))


def resolution(texts: Sequence[str]) -> float:
    """One unit of the last digit of the seconds: 0.001 for `04:05:06.004`."""
    digits = max((len(found[1]) for text in texts if (found := re.search(r":\d{2}[.,](\d+)", text))), default=0)
    return 10.0**-digits
