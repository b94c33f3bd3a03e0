"""The content of a record file as a format reader returns it, before units and checks."""

from __future__ import annotations

from dataclasses import dataclass

from rths_engine.foundation.arrays import Array


@dataclass(frozen=True, slots=True)
class Parsed:
    """Samples in the unit of the file. `unit` and `dt` (s) are None where the file does not state them.

    `channels` has the names of all channels in the file.
    """

    samples: Array
    format: str
    unit: str | None = None
    dt: float | None = None
    title: str = ""
    event: str = ""
    station: str = ""
    component: str = ""
    channels: tuple[str, ...] = ()
    channel: int = 1
