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
from functools import lru_cache
from typing import Any

import numpy as np

from app.compare.items import Item
from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.selected import Selection
from rths_engine.results.channels import CHANNELS, key
from rths_engine.results.decimate import envelope

OF_STATION = ("x_cmd", "x_meas", "f_meas", "error", "ti", "d_alpha")
IN_LOOPS = ("x_cmd", "x_meas", "f_meas")
OF_FLOOR = "x_floor"
LOOP_POINTS = 2000
KEPT = 200  # recordings whose decimated signals stay in memory, about 0.1 MB each


@dataclass(frozen=True, slots=True)
class Shown:
    """What to draw: station and floor (from 1), part of the time (s; None: no limit), number of parts of an envelope."""

    station: int = 1
    floor: int = 1
    start: float | None = None
    stop: float | None = None
    points: int = 800
    from_start: bool = False  # whether the times of an imported recording count from its first sample


def packed(items: Sequence[Item], shown: Shown) -> bytes:
    """The body for all items. Raises RecordingError where a recording cannot be read."""
    heads: list[dict[str, Any]] = []
    values: list[bytes] = []
    for index, item in enumerate(items):
        for head, series in _series(item, shown):
            heads.append({"item": index, **head, "count": len(series)})
            values.append(series.tobytes())
    text = json.dumps({"series": heads}, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return b"".join([struct.pack("<I", len(text)), text, *values])


def _series(item: Item, shown: Shown) -> list[tuple[dict[str, Any], Array]]:
    """The series of an item. Those of the whole time are kept: another reference or another station asks for them again."""
    if shown.start is None and shown.stop is None:
        return _kept(item.recording, shown, item.recording.path.stat().st_mtime_ns)
    return list(_read(item.recording, shown))


@lru_cache(maxsize=KEPT)
def _kept(recording: Selection, shown: Shown, changed: int) -> list[tuple[dict[str, Any], Array]]:
    return list(_read(recording, shown))


@np.errstate(over="ignore")
def _read(recording: Selection, shown: Shown) -> Iterator[tuple[dict[str, Any], Array]]:
    names = {role: key(role, shown.station) for role in OF_STATION} | {OF_FLOOR: key(OF_FLOOR, shown.floor)}
    zero = recording.start if shown.from_start and not recording.of_run else 0.0
    part = recording.within(*(None if time is None else time + zero for time in (shown.start, shown.stop)))
    read = recording.read([name for name in names.values() if recording.has(name)], part)
    first = recording.start - zero + part.start * recording.dt
    for role, name in names.items():
        if name not in read:
            continue
        unit = CHANNELS[role].shown
        found = (read[name] - units.zero(unit)) / units.factor(unit)
        values, at, step = envelope(found, shown.points)
        times = {"start_s": first + at * recording.dt, "step_s": step * recording.dt}
        yield {"role": role, "form": "envelope", **times}, values.astype("<f4")
        if role in IN_LOOPS:
            every = max(1, -(-len(found) // LOOP_POINTS))
            yield (
                {"role": role, "form": "samples", "start_s": first, "step_s": every * recording.dt},
                found[::every].astype("<f4"),
            )
