"""The recording of a run, `rths-recording/2`: one HDF5 file for each run, complete or absent.

`/signals` float64 (substeps, channels) in SI, gzip 4 with shuffle, one column for each channel; its attributes `keys` and
`units` describe the columns. `/history` (steps + 1, 2, floors) with x and v at the integration steps. `/plan` JSON text.
`/timing` float32 (substeps, 2), only of a test in real time: how long after its due time each controller step began, and how
long its work took, in s. Attributes of the file: `schema`, `summary`, `measures` (declarations of the measures in `summary`),
`channels`, `motion` (JSON), `dt` (s), `total` (substeps of the whole test), `code_version`, `digest`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from rths_engine import __version__
from rths_engine.foundation import files
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RecordingError, RthsError
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.recordings import damage, first_form
from rths_engine.results.channels import CHANNELS, Channel
from rths_engine.results.measures import MEASURES
from rths_engine.results.result import Result

SCHEMA = "rths-recording/2"
SCHEMAS = (SCHEMA, first_form.SCHEMA)  # that `load` reads
_DAMAGE: tuple[type[Exception], ...] = (*damage.KINDS, RthsError)  # the plan in it may be refused


@dataclass(frozen=True, slots=True)
class Saved:
    """Checksum (hex SHA-256) and size (bytes) of a recording file, as the row in the database stores them."""

    sha256: str
    size: int


@dataclass(frozen=True, slots=True)
class Recording:
    """A recording read from its file. `signals` and `history` are SI; `summary` is the JSON object of the run."""

    plan: Plan
    status: str
    dt: float
    total: int
    channels: tuple[Channel, ...]
    signals: Array
    history: Array
    summary: dict[str, Any]
    attrs: dict[str, Any]

    def signal(self, key: str) -> Array:
        column: Array = self.signals[:, [channel.key for channel in self.channels].index(key)]
        return column

    @property
    def time(self) -> Array:
        """Time (s) of each row: the first substep ends one controller step after the start."""
        return np.arange(1, len(self.signals) + 1) * self.dt


def save(path: Path, result: Result) -> Saved:
    """Write `result` to `path`: temporary file in the same folder, fsync, rename. A failure leaves no file."""
    with files.temporary(path) as written:
        with h5py.File(written, "w") as file:
            _write(file, result)
        files.sync(written)
        saved = Saved(files.checksum(written), written.stat().st_size)
        written.replace(path)
        files.sync(path.parent)
    return saved


def load(path: Path) -> Recording:
    """Read a recording. Raises RecordingError where the file is missing, damaged or in another format."""
    with _opened(path) as file:
        return _read(file)


def rows(path: Path, count: int) -> tuple[tuple[Channel, ...], float, Iterator[Array]]:
    """Channels, time step (s) and signals of a recording, `count` rows at a time. Raises RecordingError as `load` does."""
    with _opened(path) as file:
        plan, items, total = _plan(file), json.loads(file.attrs["channels"]), len(file["signals"])
        channels, _ = _columns(file, items, file["signals"][:0], plan)
        dt = float(file.attrs["dt"])

    def parts() -> Iterator[Array]:
        for first in range(0, total, count):
            with _opened(path) as file:
                yield _columns(file, items, file["signals"][first : first + count], plan)[1]

    return channels, dt, parts()


def head(path: Path) -> tuple[tuple[Channel, ...], float, int]:
    """Channels, time step (s) and number of samples of a recording. Raises RecordingError as `load` does."""
    with _opened(path) as file:
        if file.attrs["schema"] == first_form.SCHEMA:
            channels, _ = _columns(file, json.loads(file.attrs["channels"]), file["signals"][:0], _plan(file))
        else:
            channels = tuple(_channel(item) for item in json.loads(file.attrs["channels"]))
        return channels, float(file.attrs["dt"]), len(file["signals"])


def chosen(path: Path, keys: Sequence[str], part: slice = slice(None)) -> dict[str, Array]:
    """The channels `keys` in a part of the samples, without reading the others. Raises RecordingError as `load` does."""
    with _opened(path) as file:
        items, dataset = json.loads(file.attrs["channels"]), file["signals"]
        if file.attrs["schema"] == first_form.SCHEMA:
            channels, signals = _columns(file, items, dataset[part], _plan(file))
            return {one.key: signals[:, k] for k, one in enumerate(channels) if one.key in keys}
        return {one["key"]: dataset[part, k] for k, one in enumerate(items) if one["key"] in keys}


@contextmanager
def _opened(path: Path) -> Iterator[h5py.File]:
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") not in SCHEMAS:
                raise ValueError(f"its schema is {file.attrs.get('schema')!r}")
            yield file
    except FileNotFoundError:
        raise RecordingError(Issue("", f"the recording {path.name} does not exist")) from None
    except RecordingError:
        raise
    except _DAMAGE as error:
        raise RecordingError(
            Issue("", f"{path.name} is not a complete {SCHEMA} recording: {error}", fix="run the plan again")
        ) from None


def _write(file: h5py.File, result: Result) -> None:
    compressed: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True} if len(result.signals) else {}
    signals = file.create_dataset("signals", data=result.signals, **compressed)
    signals.attrs.update(keys=[one.key for one in result.channels], units=[one.unit for one in result.channels])
    file.create_dataset("history", data=result.history, **compressed)
    if result.timing is not None:
        times = np.column_stack([result.timing.delays, result.timing.lengths]) * np.float32(1e-9)
        timing = file.create_dataset("timing", data=times, **compressed)
        timing.attrs.update(keys=["delay", "length"], units=["s", "s"])
    motion = {"name": result.motion.name, "sha256": result.motion.sha256, "provenance": result.motion.provenance}
    file.attrs.update(
        schema=SCHEMA,
        code_version=__version__,
        digest=result.plan.digest,
        dt=result.dt,
        total=result.total,
        summary=json.dumps(result.summary()),
        channels=json.dumps([channel.as_dict() for channel in result.channels]),
        motion=json.dumps(motion),
        measures=json.dumps([one.as_dict() for one in MEASURES]),
    )
    file.create_dataset("plan", data=json.dumps(result.plan.as_dict()))


def _read(file: h5py.File) -> Recording:
    plan, summary = _plan(file), json.loads(file.attrs["summary"])
    channels, signals = _columns(file, json.loads(file.attrs["channels"]), file["signals"][:], plan)
    dt = float(file.attrs["dt"])
    if signals.ndim != 2 or signals.shape[1] != len(channels) or not (math.isfinite(dt) and dt > 0):
        raise ValueError(f"it has samples of shape {signals.shape} in steps of {dt:g} s, and {len(channels)} channels")
    return Recording(
        plan,
        summary["status"],
        dt,
        int(file.attrs["total"]),
        channels,
        signals,
        file["history"][:],
        summary,
        dict(file.attrs),
    )


def _plan(file: h5py.File) -> Plan:
    return read_plan(json.loads(file["plan"][()]))


def _columns(file: h5py.File, items: list[dict[str, Any]], signals: Array, plan: Plan) -> tuple[tuple[Channel, ...], Array]:
    """Channels, and the rows of `signals` in the order of the channels."""
    if file.attrs["schema"] == first_form.SCHEMA:
        return first_form.translated(items, signals, plan)
    return tuple(_channel(item) for item in items), signals


def _channel(item: dict[str, Any]) -> Channel:
    channel = Channel(item["role"], item["number"], item["label"])
    if channel.role not in CHANNELS or channel.unit != item["unit"]:
        raise ValueError(f"its channel {item['key']!r} in {item['unit']} is not a known channel")
    return channel
