"""CSMNC files: 16 lines of header, then eight values a line with a digit less in the exponent than C writes."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Record:
    """A record. `header`: texts that replace those of the samples: `count`, `dt`, `peak`, `at`, `duration`, `unit`."""

    values: Sequence[float]
    dt: float = 0.005
    header: dict[str, str] = field(default_factory=dict)


def number(value: float) -> str:
    return re.sub(r"e([-+])0?(\d+)", lambda one: f"E{one[1].strip('+')}{int(one[2])}", f"{value:.6e}")


def written(record: Record) -> bytes:
    at = max(range(len(record.values)), key=lambda one: abs(record.values[one]))
    text = {
        "count": f"{len(record.values)}", "dt": f"{record.dt:g}", "peak": f"{record.values[at]:.3f}",
        "at": f"{(at + 1) * record.dt:.2f}", "duration": f"{len(record.values) * record.dt:g}", "unit": "CM/SEC/SEC",
        "kind": "UNCORRECTED ACCELERATION",
    } | record.header  # fmt: skip
    lines = [
        "065JZC120103153901", "0120103153957 2012-01-03 15:39:57 BTM", "ATUSHI EARTHQUAKE, ATUSHI,CHN",
        "EPICENTER  39.939N 77.339E DEPTH 9 KM", "MAGNITUDE  4.0(Ms)", "STATION: 65JZC 39.700N 77.599E",
        "SITE CONDITION: SOIL", "INSTRUMENT TYPE: ETNA/ES-T", "OBSERVING POINT: GROUND", "COMP. EW",
        f"{text['kind']}          UNIT: {text['unit']}",
        f"NO. OF POINTS:  {text['count']}  EQUALLY SPACED INTERVALS OF:  {text['dt']}  SEC",
        f"PEAK VALUE:    {text['peak']}   AT   {text['at']} SEC    DURATION:  {text['duration']} SEC",
        "PRE-EVENT TIME:  20  SEC  RECORDER TIME:  2012-01-3 15:39:44.000 BTM", "CSMNC", "",
    ]  # fmt: skip
    for start in range(0, len(record.values), 8):
        lines.append(" ".join(f"{number(one):>12s}" for one in record.values[start : start + 8]) + " ")
    return ("\n".join(lines) + "\n").encode()
