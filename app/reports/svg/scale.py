"""Scales of axes: limits, round ticks and their labels."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from app.reports.digits import RAISED
from app.reports.packed import Samples

STEPS = (1.0, 2.0, 5.0, 10.0)
LARGE, SMALL = 1e5, 1e-3  # numbers outside are written with a power of ten beside the axis
MARGIN = 0.05  # of the range, above and below the data


@dataclass(frozen=True, slots=True)
class Scale:
    """Maps values from `low` to `high` to 0 to 1. `ticks` have a value and a label; `power` stands beside the axis."""

    low: float
    high: float
    ticks: tuple[tuple[float, str], ...]
    log: bool = False
    power: str = ""

    def place(self, values: Samples) -> Samples:
        """Places from 0 (low) to 1 (high); NaN where a value has none."""
        if not self.log:
            places: Samples = (np.asarray(values, dtype=float) - self.low) / (self.high - self.low)
            return places
        with np.errstate(divide="ignore", invalid="ignore"):
            exponents = np.log10(np.asarray(values, dtype=float))
        exponents[~np.isfinite(exponents)] = np.nan
        decades: Samples = (exponents - math.log10(self.low)) / (math.log10(self.high) - math.log10(self.low))
        return decades


def linear(values: Samples, most: int, from_zero: bool = False, tight: bool = False) -> Scale:
    """A linear scale of finite values with at most `most` ticks. A `tight` scale has no margin."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    if from_zero:
        low, high = min(low, 0.0), max(high, 0.0)
    if high <= low:
        wide = abs(low) * 0.1 or 1.0
        low, high = low - wide, high + wide
    elif not tight:
        margin = MARGIN * (high - low)
        low = low if from_zero and low == 0 else low - margin
        high = high if from_zero and high == 0 else high + margin
    return Scale(low, high, *_labelled(_round(low, high, most)))


def logarithmic(values: Samples, most: int) -> Scale:
    """A scale of positive values with a tick at powers of ten."""
    known = values[np.isfinite(values) & (values > 0)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (1.0, 10.0)
    if high <= low:
        low, high = low / 2, high * 2
    first, last = math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9)
    every = max(1, math.ceil((last - first + 1) / most))
    ticks = tuple((10.0**one, f"10{_raised(one)}") for one in range(first, last + 1, every))
    if len(ticks) < 2:  # less than a decade
        ticks = tuple((one, f"{one:.3g}") for one in _round(low, high, most) if one > 0)
    return Scale(low, high, ticks, log=True)


def _round(low: float, high: float, most: int) -> list[float]:
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(one * power for one in STEPS if one * power >= rough * (1 - 1e-9))
    first = math.ceil(low / step - 1e-9)
    return [number * step for number in range(first, math.floor(high / step + 1e-9) + 1)]


def _labelled(ticks: list[float]) -> tuple[tuple[tuple[float, str], ...], bool, str]:
    """The ticks with their labels, that the scale is not logarithmic, and the power of ten of the labels."""
    largest = max(map(abs, ticks), default=0.0)
    exponent = 3 * math.floor(math.log10(largest) / 3) if largest and not SMALL <= largest < LARGE else 0
    shown = [one / 10.0**exponent for one in ticks]
    step = shown[1] - shown[0] if len(shown) > 1 else 1.0
    decimals = max(0, -math.floor(math.log10(abs(step)) + 1e-9))
    labels = tuple((one, f"{value:z.{decimals}f}".replace("-", "−")) for one, value in zip(ticks, shown, strict=True))
    return labels, False, f"× 10{_raised(exponent)}" if exponent else ""


def _raised(number: int) -> str:
    return str(number).translate(RAISED)
