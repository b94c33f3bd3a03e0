"""Volume 1 of BHRC: a header cut after 70 characters, then ten values of 13 characters a line, in g/10."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

_WIDE = 70


@dataclass(frozen=True)
class Component:
    """A component. `header`: numbers that replace those of the values: `points`, `duration`, `i28`, `r3`, `r5`, `r9`."""

    letter: str
    values: Sequence[float]
    rate: float = 200.0
    header: dict[str, float] = field(default_factory=dict)
    unit: str = "G/10"


def number(value: float) -> str:
    """The value as Fortran's E13.6 without a leading zero: `  .854257E-03`."""
    mantissa, exponent = f"{abs(value):.5e}".split("e")
    digits, power = mantissa.replace(".", ""), int(exponent) + (value != 0)
    return f"{'-' if value < 0 else ''}.{digits}E{power:+03d}".rjust(13)


def written(*components: Component) -> bytes:
    lines: list[str] = []
    for k, one in enumerate(components, start=1):
        seconds = len(one.values) / one.rate
        header = {
            "points": len(one.values), "duration": seconds, "i28": len(one.values), "r3": seconds, "r5": 0.1, "r9": one.rate,
        } | one.header  # fmt: skip
        lines += [
            "* VOL1DS FILE:  5520/01", "Inst Type = SSA-2", "Origin Time : 2012/08/11   12:23:16", "", one.letter, " " * _WIDE,
            f"COMP {one.letter}{k}",
            "Ahar                      Station   38.474 N 47.059 E   Altitude 1360m   Azimuth L 352   T 82",
            "Epicenter 38.520 N 46.860 E   FD 12 Km", "INSTR PERIOD =  .019 SEC   DAMPING =  .640",
            f"NO. OF POINTS ={header['points']:7.0f}      DURATION ={header['duration']:8.3f}",
            f"UNITS ARE SECONDS AND {one.unit}", "",
        ]  # fmt: skip
        integers, reals = [0.0] * 100, [0.0] * 50
        integers[27] = header["i28"]
        reals[0], reals[1], reals[2], reals[4], reals[8] = 0.0188324, 0.64, header["r3"], header["r5"], header["r9"]
        for start in range(0, 100, 16):
            cells = "".join(f"{one:05.0f}" if one else f"{0:5d}" for one in integers[start : start + 16])
            lines.append(cells[:_WIDE].ljust(_WIDE))
        for start in range(0, 50, 8):
            lines.append("".join(number(one) for one in reals[start : start + 8])[:_WIDE].ljust(_WIDE))
        for start in range(0, len(one.values), 10):
            lines.append("".join(number(value) for value in one.values[start : start + 10]))
        lines.append("/&")
    return ("\n".join(lines) + "\n").encode()
