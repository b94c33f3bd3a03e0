"""COSMOS 1.20 files as the definition describes them, written channel by channel."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rths_engine.foundation.arrays import Array

TITLES = {"acceleration": ("acceleration", 1, 4), "velocity": ("velocity", 2, 5), "displacement": ("displacement", 3, 6)}
UNITS = {2: "g.     ", 4: "cm/sec2", 5: "cm/sec", 6: "cm", 10: "gal", 11: "mg", 50: "counts"}


@dataclass(frozen=True)
class Channel:
    """`stage`: 0 raw, 1 uncorrected, 2 corrected. `reals` and `integers` override header values by their number from 1."""

    values: Array
    dt: float = 0.01
    azimuth: int | None = 90
    quantity: str = "acceleration"
    unit: int | None = None
    stage: int = 2
    form: tuple[int, int, int, str] = (8, 10, 5, "f")
    count: int | None = None
    reals: dict[int, float] = field(default_factory=dict)
    integers: dict[int, int] = field(default_factory=dict)
    comments: tuple[str, ...] = ("|no comment",)
    text_peak: float | None = None
    raw_step: float = 0.005
    null: float = -999.0
    end: str = "End-of-data for Chan  1 acceleration"


def fortran(values: Array | list[float], per_line: int, width: int, digits: int, letter: str) -> list[str]:
    """Rows of numbers in fixed columns; numbers that fill their columns touch."""
    form = f"%{width}d" if letter == "I" else f"%{width}.{digits}{letter}"
    fields = [form % (int(one) if letter == "I" else one) for one in values]
    return ["".join(fields[at : at + per_line]) for at in range(0, len(fields), per_line)]


def section(one: Channel) -> list[str]:
    values = np.asarray(one.values, dtype=float)
    at = int(np.argmax(np.abs(values))) if len(values) else 0
    top = values[at] if len(values) else 0.0
    word, quantity, usual = TITLES[one.quantity]
    unit = one.unit or (50 if one.stage == 0 else usual)
    kind = {0: "Raw acceleration counts  ", 1: f"Uncorrected {word:13s}", 2: f"Corrected {word:15s}"}[one.stage]
    peak = abs(top) if one.stage == 0 else top
    stated = peak if one.text_peak is None else one.text_peak
    azimuth = f"{one.azimuth} deg" if one.azimuth is not None else "Up"
    integers: dict[int, float] = {1: one.stage, 2: quantity, 3: unit, 4: 120, 54: one.azimuth or 400, **one.integers}
    reals = {34: one.raw_step, 62: one.dt * 1000, 63: len(values) * one.dt, 64: peak, 65: at * one.dt, **one.reals}
    per_line, width, digits, letter = one.form
    count = len(values) if one.count is None else one.count
    words = "raw accel.  " if one.stage == 0 else word
    return [
        f"{kind} (Format v01.20 with 13 text lines) Src: test",
        "Made-up earthquake of Sun Jan 01, 2023",
        "Hypocenter: 34.0580  -117.0110  H= 12km ML=4.9",
        "Origin: 01/01/2023, 20:53:26.1 UTC",
        "Statn No: 02-    0  Code:NP-1743   USGS CA:Petaluma;FS 2",
        "Coords: 38.2670 -122.6620  Site Geology: alluvium",
        "Recorder: Etna   s/n  823 ( 3 Chns of   3 at Sta) Sensor: FBA",
        "Rcrd start time: 1/01/2023, 20:53:30.000 UTC (Q=5) RcrdId: 1743",
        f"Sta Chan   1: {azimuth} (Rcrdr Chan  1) Location: ground floor",
        "Raw record length =  99.000 sec, Uncor max =    12345, at   1.000 sec." if one.stage == 2 else "Raw record",
        f"Processed: 01/02/2023, test, Max = {stated:12.5f} {UNITS[unit].strip(' .')}   at {at * one.dt:8.3f} sec",
        "Record filtered below  0.10 Hz (periods over 10.00 secs), and above 40.0 Hz",
        f"Values used when parameter or data value is unknown/unspecified:  {int(one.null)}, {one.null}",
        " 100 Integer-header values follow on  10 lines, Format= (10I8)",
        *fortran([integers.get(k, int(one.null)) for k in range(1, 101)], 10, 8, 0, "I"),
        " 100 Real-header values follow on  17 lines, Format= (6F13.6)",
        *fortran([reals.get(k, one.null) for k in range(1, 101)], 6, 13, 6, "f"),
        f'   {len(one.comments)} Comment line(s) follow, each starting with a "|":',
        *one.comments,
        f"   {count:5d} {words} pts, approx {len(values) * one.dt:4.0f} secs, units={UNITS[unit]}({unit:02d}),"
        f"Format=({per_line}{letter.upper()}{width}{'' if letter == 'I' else f'.{digits}'})",
        *fortran(values, per_line, width, digits, letter),
        *([one.end] if one.end else []),
    ]


def written(*channels: Channel, end: str = "\n") -> bytes:
    """A file of channels."""
    return (end.join(line for one in channels for line in section(one)) + end).encode()
