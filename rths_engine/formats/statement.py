"""What the header of a file states, beside what was read from its data.

A statement agrees where |stated - read| <= within; `within` is what the rounding of the two numbers explains. A statement that
does not agree refuses the file, because either the header or the data are not what they claim to be.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# of a step; chosen, see docs/decisions/0023
SAME_STEP = 1e-3
COARSE = 0.03

_DIGITS = re.compile(r"[-+]?(\d*)\.?(\d*)(?:[eEdD]([-+]?\d+))?")


@dataclass(frozen=True, slots=True)
class Statement:
    """A number in a header and the number that was read from the data, both in `unit`. `where`: the line or the attribute."""

    what: str
    where: str
    stated: float
    read: float
    unit: str = ""
    within: float = 0.0

    @property
    def agrees(self) -> bool:
        return abs(self.stated - self.read) <= self.within * (1 + 1e-9)

    @property
    def issue(self) -> Issue:
        unit = f" {self.unit}" if self.unit else ""
        problem = f"states a {self.what} of {self.stated:.7g}{unit}; the data have {self.read:.7g}{unit}"
        return Issue(self.where, problem, fix="the file contradicts itself: get it again, or correct the header or the data")


@dataclass(frozen=True, slots=True)
class Written:
    """A number of a header: its value, half a unit of its last digit, and where it stands."""

    value: float
    within: float
    where: str

    @classmethod
    def of(cls, text: str, where: str) -> Written:
        """The number in `text`. Raises ValueError where it is not a number, and FileError where it is not finite (`1e999`)."""
        value = float(re.sub("[dD]", "E", text))
        if not math.isfinite(value):
            raise FileError(Issue(where, "is not a finite number", text.strip(), "correct the header, or get the file again"))
        return cls(value, last_digit(text) / 2, where)


def last_digit(text: str) -> float:
    """The value of one unit of the last digit of a number as it is written: 0.001 for `-0.182`, 1 for `182`."""
    found = _DIGITS.fullmatch(text.strip())
    return float(f"1e{int(found[3] or 0) - len(found[2])}") if found else 0.0


def count(stated: int, read: int, where: str, of: str = "") -> Statement:
    """The number of samples."""
    return Statement(f"number of samples{of and f' of {of}'}", where, stated, read)


def step(stated: Written, read: float, unit: str = "s") -> Statement:
    """The time step of a header beside the step of the time column, in `unit`.

    `0.004` can be 1/256 s, but `0.01` is not 0.005, though half a unit of its last digit would allow it.
    """
    within = max(min(stated.within, COARSE * abs(read)), SAME_STEP * abs(read))
    return Statement("time step", stated.where, stated.value, read, unit, within)


def peak(stated: Written, values: Array, unit: str, rounding: float = 0.0, of: str = "", signed: bool = False) -> Statement:
    """The largest absolute value, in `unit`; `rounding`: half a unit of the last digit of the samples."""
    at = int(np.argmax(np.abs(values)))
    read = float(values[at]) if signed else abs(float(values[at]))
    given = stated.value if signed else abs(stated.value)
    return Statement(f"peak{of and f' of {of}'}", stated.where, given, read, unit, stated.within + rounding + 1e-6 * abs(read))


def peak_time(stated: Written, values: Array, dt: float, start: float = 0.0, of: str = "") -> Statement:
    """The time (s) of the largest absolute value: of the sample nearest to the stated time, where several are as large."""
    size = np.abs(values)
    times = start + np.flatnonzero(size >= np.max(size) * (1 - 1e-9)) * dt
    read = float(times[np.argmin(np.abs(times - stated.value))])
    return Statement(f"time of the peak{of and f' of {of}'}", stated.where, stated.value, read, "s", stated.within + dt)


def duration(stated: Written, samples: int, dt: float, of: str = "") -> Statement:
    """The duration (s) of a header: `samples` * dt, or (`samples` - 1) * dt as some networks count it; within half a step."""
    read = min((samples * dt, (samples - 1) * dt), key=lambda one: abs(one - stated.value))
    return Statement(f"duration{of and f' of {of}'}", stated.where, stated.value, read, "s", stated.within + dt / 2)
