"""What a format reader finds in a file, before units and checks."""

from __future__ import annotations

from dataclasses import dataclass

from rths_engine.foundation.arrays import Array


@dataclass(frozen=True, slots=True)
class Parsed:
    """Samples in the file's unit. `unit` and `dt` (s) are None where the file does not say; `channels` names all there are."""

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
