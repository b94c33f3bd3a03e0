"""The signals of a comparison as one binary body: a JSON head, then float32 values in the units shown.

Body: uint32 length of the head in bytes, head (JSON, padded to four bytes), values (little-endian float32). The head lists the
series in the order of their values: `item`, `role`, `form` (`envelope`: smallest and largest value of equal parts in the order
of their times; `samples`: every n-th sample), `start_s`, `step_s`, `count`. Values that are not finite are gaps.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.compare.items import Item
from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.results.channels import CHANNELS, key
from rths_engine.results.decimate import envelope

OF_STATION = ("x_cmd", "x_meas", "f_meas", "error", "ti", "d_alpha")
IN_LOOPS = ("x_cmd", "x_meas", "f_meas")
OF_FLOOR = "x_floor"
LOOP_POINTS = 2000


@dataclass(frozen=True, slots=True)
class Shown:
    """What to draw: station and floor (from 1), part of the time (s; None: no limit), number of parts of an envelope."""

    station: int = 1
    floor: int = 1
    start: float | None = None
    stop: float | None = None
    points: int = 800


def packed(items: Sequence[Item], shown: Shown) -> bytes:
    """The body for all items. Raises RecordingError where a recording cannot be read."""
    heads: list[dict[str, Any]] = []
    values: list[bytes] = []
    for index, item in enumerate(items):
        for head, series in _series(item, shown):
            heads.append({"item": index, **head, "count": len(series)})
            values.append(np.asarray(series, dtype="<f4").tobytes())
    text = json.dumps({"series": heads}, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return b"".join([struct.pack("<I", len(text)), text, *values])


@np.errstate(over="ignore")
def _series(item: Item, shown: Shown) -> Iterator[tuple[dict[str, Any], Array]]:
    recording = item.recording
    names = {role: key(role, shown.station) for role in OF_STATION} | {OF_FLOOR: key(OF_FLOOR, shown.floor)}
    part = recording.within(shown.start, shown.stop)
    read = recording.read([name for name in names.values() if recording.has(name)], part)
    first = recording.start + part.start * recording.dt
    for role, name in names.items():
        if name not in read:
            continue
        unit = CHANNELS[role].shown
        found = (read[name] - units.zero(unit)) / units.factor(unit)
        values, at, step = envelope(found, shown.points)
        times = {"start_s": first + at * recording.dt, "step_s": step * recording.dt}
        yield {"role": role, "form": "envelope", **times}, values
        if role in IN_LOOPS:
            every = max(1, -(-len(found) // LOOP_POINTS))
            yield {"role": role, "form": "samples", "start_s": first, "step_s": every * recording.dt}, found[::every]
