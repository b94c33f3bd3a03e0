"""CSMIP volume 1 and 2 as CSMIP, CDMG and RENADIC wrote them: text, 100 integers, 50 or 100 reals, then the data."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from rths_engine.foundation.arrays import Array
from tests.engine.formats.writers.cosmos import fortran

PEAKS = {"acceleration": ("cm/sec/sec", 65), "velocity": ("cm/sec", 67), "displacement": ("cm", 69)}
BLOCKS = {"acceleration": ("accel", "cm/sec2."), "velocity": ("veloc", "cm/sec."), "displacement": ("displ", "cm.")}


@dataclass(frozen=True)
class Channel:
    """Values by quantity, or of acceleration alone. `reals` and `integers` override header values by their number from 1."""

    acceleration: Array
    velocity: Array | None = None
    displacement: Array | None = None
    dt: float = 0.01
    direction: str = "90 Deg"
    azimuth: int = 90
    station: str = "24278"
    counts: dict[str, int] = field(default_factory=dict)
    integers: dict[int, int] = field(default_factory=dict)
    reals: dict[int, float] = field(default_factory=dict)
    text: dict[int, str] = field(default_factory=dict)  # lines of the text, from 1
    number: int = 1


def top(values: Array) -> tuple[float, int]:
    at = int(np.argmax(np.abs(values)))
    return float(values[at]), at


def integers(one: Channel, usual: dict[int, int]) -> list[str]:
    values: dict[int, float] = {27: one.azimuth, **usual, **one.integers}
    return fortran([values.get(k, -999) for k in range(1, 101)], 16, 5, 0, "I")


def corrected(one: Channel) -> list[str]:
    blocks = {name: values for name in BLOCKS if (values := getattr(one, name)) is not None}
    count = len(one.acceleration)
    text = {
        1: f"Corrected accelerogram   24278-TEST               Chan {one.number:2d}: {one.direction}     from",
        2: "Uncorrected Accelerogram Data             Processed: 01/02/23, CGS",
        3: "Made-up earthquake",
        6: f"Station No. {one.station}   34.471N, 118.196W   Etna    s/n 2500  (3 Chns of  3 at Sta)",
        7: "Castaic - Old Ridge Route                 CGS   Data: Acceleration",
        8: f"Chan {one.number:2d}: {one.direction}",
        12: f"                        Record length = {count * one.dt:.3f} sec.",
        13: "                                     Uncor Max  =   .286 g , at   1.000 sec.",
        16: f"{count:6d} points of instrument- and baseline-corrected accel, veloc and displ data",
        17: f"At equally-spaced intervals of    {one.dt:.3f}  sec.",
    }
    reals = {60: count * one.dt, 61: one.dt}
    for line, name in zip((18, 19, 20), BLOCKS, strict=True):
        if name in blocks:
            value, at = top(blocks[name])
            unit, place = PEAKS[name]
            text[line] = f"Peak {name:12s} = {value:10.3f}    {unit}  at {at * one.dt:8.3f}   sec."
            reals |= {place: at * one.dt, place + 1: value}
    text |= one.text
    reals |= one.reals
    lines = [text.get(k, "") for k in range(1, 26)]
    lines[1:] = [line or " " for line in lines[1:]]
    lines += integers(one, {53: count})
    lines += fortran([reals.get(k, -999.0) for k in range(1, 101)], 8, 10, 4, "f")
    for name, values in blocks.items():
        word, unit = BLOCKS[name]
        stated = one.counts.get(name, len(values))
        lines.append(f"{stated:6d} points of {word} data equally spaced at  {one.dt:.3f} sec, in {unit} (8f10.5)")
        lines += fortran(values, 8, 10, 5, "f")
    return [*lines, f"/&  ----------  End of data for channel  {one.number}  ----------"]


def uncorrected(one: Channel, *, pairs: bool = False, shift: float = 0.0, renadic: bool = False) -> list[str]:
    """Volume 1 in g, or in g/10 as pairs; `renadic`: the peak's time counts from an origin `shift` s before the trigger."""
    values = np.asarray(one.acceleration, dtype=float)
    value, at = top(one.acceleration)
    count, stated_at = len(values), at * one.dt - shift
    text = {
        1: "Uncorrected Accelerogram Data             Processed: 01/02/23, CGS",
        2: "Made-up earthquake",
        3: "11/13/2009 3:05:27 (GMT)                (ORIGIN: 11/13/2009 3:05:27 GMT)",
        4: f"                                   TRIGGER TIME: 11/13/2009 3:05:{27 + shift:06.3f} GMT",
        5: f"Station No. {one.station}   34.471N, 118.196W   Etna    s/n 2500  (3 Chns of  3 at Sta)",
        6: "Castaic - Old Ridge Route                 CGS   Data: Acceleration",
        7: f"Chan {one.number:2d}: {one.direction}",
        8: "UNIVERSIDAD DE CHILE - RENADIC" if renadic else "Made-up",
        11: f"No. of Points = {count:6d}  Record Length = {count * one.dt:.3f} sec"
        + ("" if pairs else f"   at {1 / one.dt:.0f} Samples/sec"),
        12: f"Units of uncor data are sec and {'g/10.' if pairs else 'g.   '}"
        f"      Max  = {value:8.4f} g, at {stated_at:8.3f} sec.",
    } | one.text
    reals = {3: count * one.dt, 7: value, 8: stated_at} | one.reals
    lines = [text.get(k, " ") for k in range(1, 14)]
    lines += integers(one, {28: one.counts.get("acceleration", count)})
    lines += fortran([reals.get(k, -999.0) for k in range(1, 51)], 8, 10, 4, "f")
    if pairs:
        both = np.column_stack([np.arange(count) * one.dt, values * 10]).ravel()
        lines += fortran(both, 10, 7, 3, "f")
    else:
        stated = one.counts.get("acceleration", count)
        lines.append(f"{stated:6d} Accelerogram points at {1 / one.dt:.0f} pts/sec in units of g.       Format: (8f9.6)")
        lines += fortran(values, 8, 9, 6, "f")
    return [*lines, f"/&  ----------  End of Data for Channel  {one.number}  ----------"]


def file(*channels: list[str], end: str = "\n") -> bytes:
    return (end.join(line for one in channels for line in one) + end).encode()


def numbered(*channels: Channel) -> list[Channel]:
    return [replace(one, number=k) for k, one in enumerate(channels, start=1)]
