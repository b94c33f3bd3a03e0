"""A measured recording: channels at one uniform step, in SI."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.roles import ROLES, key


@dataclass(frozen=True, eq=False)
class MeasuredChannel:
    """One signal in SI. `number` is its station or floor; None for a role with only one channel.

    `moved` says how its samples came to the clock of the recording; empty where they are the samples of the file.
    """

    role: str
    number: int | None
    values: Array
    unit: str
    label: str = ""
    column: str = ""
    moved: str = ""

    @property
    def key(self) -> str:
        return key(self.role, self.number)


@dataclass(frozen=True, eq=False)
class Measured:
    """A measured recording. Sample k of every channel is at start + k dt (s, in the time of the source)."""

    dt: float
    channels: tuple[MeasuredChannel, ...]
    start: float = 0.0
    title: str = ""
    test: str | None = None
    source: str = ""
    source_sha256: str = ""
    mapping: str = ""
    warnings: tuple[Finding, ...] = ()
    of_run: bool = False  # whether it is from a run of this program: the first sample is one controller step after the start

    @property
    def samples(self) -> int:
        return len(self.channels[0].values)

    @property
    def time(self) -> Array:
        return self.start + np.arange(self.samples) * self.dt

    @property
    def keys(self) -> tuple[str, ...]:
        return tuple(channel.key for channel in self.channels)

    def has(self, role: str, number: int | None = None) -> bool:
        return key(role, number or 1) in self.keys

    def get(self, role: str, number: int | None = None) -> Array:
        """The signal of a role for station or floor `number` (default 1). Raises RecordingError where it was not measured."""
        wanted = key(role, number or 1)
        for channel in self.channels:
            if channel.key == wanted:
                return channel.values
        raise RecordingError(Issue("channel", "was not measured", wanted, f"the recording contains {', '.join(self.keys)}"))

    def numbers(self, counts: str) -> list[int]:
        """Numbers of the stations or floors (`counts`) that have at least one channel."""
        return sorted({one.number for one in self.channels if one.number is not None and ROLES[one.role].counts == counts})
