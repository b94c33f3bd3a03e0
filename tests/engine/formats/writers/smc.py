"""SMC files of the U.S. Geological Survey: 11 lines of text, 48 integers, 50 reals, comments, then rows of 8 numbers."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rths_engine.foundation.arrays import Array

TITLES = {"acceleration": "2 CORRECTED ACCELEROGRAM", "velocity": "3 VELOCITY", "displacement": "4 DISPLACEMENT"}
UNKNOWN, LARGE = -32768, 1.7e38


@dataclass(frozen=True)
class Record:
    values: Array
    rate: float | None = 100.0
    quantity: str = "acceleration"
    azimuth: int | None = 90  # None: up
    title: str = ""
    times: Array | None = None
    comments: tuple[str, ...] = ("|", "|made up")
    integers: dict[int, int] = field(default_factory=dict)
    reals: dict[int, float] = field(default_factory=dict)
    pk: float | None = None


def short(value: float) -> str:
    """1PE10.4E1: one digit of the exponent."""
    mantissa, exponent = f"{value:.4E}".split("E")
    return f"{mantissa}E{int(exponent):+d}".rjust(10)


def written(one: Record, end: str = "\r\n", below: tuple[str, ...] = ()) -> bytes:
    values = np.array([float(f"{value:.4E}") for value in one.values])
    high, low = int(np.argmax(values)), int(np.argmin(values))
    rate = one.rate or 100.0
    numbers = list(values) if one.times is None else [x for pair in zip(one.times, values, strict=True) for x in pair]
    vertical = 90 if one.azimuth is not None else 0
    integers = {1: UNKNOWN, 2: 2023, 9: 1, 10: 3, 13: vertical, 16: len(one.comments), 17: len(numbers)}
    if one.azimuth is not None:
        integers[14] = one.azimuth
    integers |= one.integers
    reals = {29: high / rate, 30: values[high], 31: low / rate, 32: values[low]}
    if one.rate:
        reals[2] = one.rate
    reals |= one.reals
    top = values[high] if values[high] >= -values[low] else values[low]
    component = "up" if one.azimuth is None else f"{one.azimuth:d}"
    whole = [f"{integers.get(k, UNKNOWN):10d}" for k in range(1, 49)]
    real = [f"{reals.get(k, LARGE):15.7E}" for k in range(1, 51)]
    data = [short(value) for value in numbers]
    lines = [
        one.title or TITLES[one.quantity], "*", "SAF0A", "     2023  10  18    0004 Made-up, CA",
        "Moment Mag=      7.1 Ms=      7.1 Ml=      7.0",
        f"station = San Francisco, 1295 Shafter, F component= {component:>6s}",
        f"epicentral dist =     89.0       pk     = {top if one.pk is None else one.pk:8.1f}",
        "inst type=SMA-1      data source = USGS", "*", "*", "*",
        *("".join(whole[at : at + 8]) for at in range(0, 48, 8)),
        *("".join(real[at : at + 5]) for at in range(0, 50, 5)),
        *one.comments,
        *("".join(data[at : at + 8]) for at in range(0, len(data), 8)),
        *below,
    ]  # fmt: skip
    return (end.join(lines) + end).encode()
