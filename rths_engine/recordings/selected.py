"""Chosen channels in a part of the time of a recording, measured or of a run, without reading the rest of its file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.recordings import run_file
from rths_engine.recordings.measured import store
from rths_engine.results import metrics
from rths_engine.results.channels import key

COMPUTED = {"error": ("x_cmd", "x_meas"), "ti": ("x_cmd", "x_meas")}  # role -> the channels that it is computed from


@dataclass(frozen=True, slots=True)
class Selection:
    """A recording whose samples are read on request. Sample k is at `start + k dt` (s).

    `keys` are the channels in the file, `computed` those that `read` computes: an imported recording has no tracking error.
    """

    path: Path
    of_run: bool
    dt: float
    start: float
    samples: int
    keys: tuple[str, ...]
    computed: tuple[str, ...] = ()

    @property
    def duration(self) -> float:
        """Time (s) from the start of a run, or from the first sample of an imported recording, to the last sample."""
        return max(0, self.samples - 1) * self.dt + (self.start if self.of_run else 0.0)

    def has(self, name: str) -> bool:
        return name in self.keys or name in self.computed

    def within(self, start: float | None, stop: float | None) -> slice:
        """The samples between two times, with one more at each end; None: without limit."""
        first = 0 if start is None else _index((start - self.start) / self.dt - 1, self.samples)
        last = self.samples if stop is None else _index((stop - self.start) / self.dt + 2, self.samples)
        return slice(first, max(first, last))

    def read(self, names: Sequence[str], part: slice = slice(None)) -> dict[str, Array]:
        """The channels `names` that the recording has, in SI. Raises RecordingError where the file is missing or damaged."""
        chosen = run_file.chosen if self.of_run else store.chosen
        found = chosen(self.path, [name for name in names if name in self.keys], part)
        for name in names:
            if name in self.computed:
                role, _, number = name.partition(".")
                whole = chosen(self.path, [key(one, int(number)) for one in COMPUTED[role]])
                x_cmd, x_meas = (whole[key(one, int(number))] for one in COMPUTED[role])
                found[name] = (x_cmd - x_meas if role == "error" else metrics.tracking_indicator(x_cmd, x_meas))[part]
        return found


def of_run(path: Path) -> Selection:
    """The recording of a run. Raises RecordingError where the file is missing, damaged or in another format."""
    channels, dt, samples = run_file.head(path)
    return Selection(path, True, dt, dt, samples, tuple(one.key for one in channels))


def of_measured(path: Path) -> Selection:
    """An imported recording. Raises RecordingError where the file is missing, damaged or in another format."""
    keys, dt, start, samples = store.head(path)
    stations = {int(name.partition(".")[2]) for name in keys if name.startswith("x_cmd.")}
    computed = [
        key(role, station)
        for role, needed in COMPUTED.items()
        for station in sorted(stations)
        if all(key(one, station) in keys for one in needed) and key(role, station) not in keys
    ]
    return Selection(path, False, dt, start, samples, keys, tuple(computed))


def _index(position: float, samples: int) -> int:
    return int(np.clip(np.floor(position), 0, samples))
