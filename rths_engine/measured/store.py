"""A measured recording, `rths-measured/1`: channels at one uniform step, SI, one HDF5 dataset each.

Datasets `x_meas.1`, `f_meas.1`, `ag`, ... float64 (samples,) with attributes `role`, `number`, `unit`, `label`, `column`; file
attributes `schema`, `title`, `test`, `dt` (s), `start_s` (of the first sample, in the source's time), `source` (name or path),
`source_sha256`, `mapping` (YAML), `warnings` (JSON), `code_version`.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from rths_engine import __version__, files
from rths_engine.arrays import Array
from rths_engine.errors import Issue, RecordingError
from rths_engine.measured.finding import Finding
from rths_engine.measured.roles import ROLES, SI, key

SCHEMA = "rths-measured/1"
RUN = "rths-recording/1"


@dataclass(frozen=True, eq=False)
class MeasuredChannel:
    """One signal in SI. `number` is its station or floor, None where its role has one channel."""

    role: str
    number: int | None
    values: Array
    unit: str
    label: str = ""
    column: str = ""

    @property
    def key(self) -> str:
        return key(self.role, self.number)


@dataclass(frozen=True, eq=False)
class Measured:
    """Sample k of every channel is at start + k dt (s, in the source's time)."""

    dt: float
    channels: tuple[MeasuredChannel, ...]
    start: float = 0.0
    title: str = ""
    test: str | None = None
    source: str = ""
    source_sha256: str = ""
    mapping: str = ""
    warnings: tuple[Finding, ...] = ()
    of_run: bool = False  # of a run of this program, whose first sample is one controller step after the start

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
        """The signal of a role, of station or floor `number` (default 1). Raises RecordingError where it was not measured."""
        wanted = key(role, number or 1)
        for channel in self.channels:
            if channel.key == wanted:
                return channel.values
        raise RecordingError(Issue("channel", "was not measured", wanted, f"the recording holds {', '.join(self.keys)}"))

    def numbers(self, counts: str) -> list[int]:
        """Stations or floors, as `counts` says, of which something was measured."""
        return sorted({one.number for one in self.channels if one.number is not None and ROLES[one.role].counts == counts})


def save(path: Path, measured: Measured) -> None:
    """Write `measured` to `path`, whole or not at all."""
    with files.temporary(path) as written:
        with h5py.File(written, "w") as file:
            _write(file, measured)
        files.sync(written)
        written.replace(path)
        files.sync(path.parent)


def load(path: Path) -> Measured:
    """A measured recording, or a run's as one. Raises RecordingError where it is missing, damaged or of another form."""
    try:
        with h5py.File(path, "r") as file:
            schema = file.attrs.get("schema")
            if schema == SCHEMA:
                return _read(file)
    except FileNotFoundError:
        raise RecordingError(Issue("", f"there is no recording {path.name}")) from None
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise _damaged(path, error) from None
    if schema != RUN:
        raise _damaged(path, f"its schema is {schema!r}")
    from rths_engine.measured.of_run import of_run
    from rths_engine.recording import load as load_run

    return of_run(load_run(path), path.name)


def _write(file: h5py.File, measured: Measured) -> None:
    for one in measured.channels:
        options: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True}
        dataset = file.create_dataset(one.key, data=one.values, **options)
        dataset.attrs.update(role=one.role, number=one.number or 0, unit=one.unit, label=one.label, column=one.column)
    file.attrs.update(
        schema=SCHEMA,
        code_version=__version__,
        dt=measured.dt,
        start_s=measured.start,
        title=measured.title,
        test=measured.test or "",
        source=measured.source,
        source_sha256=measured.source_sha256,
        mapping=measured.mapping,
        warnings=json.dumps([warning.as_dict() for warning in measured.warnings]),
    )


def _read(file: h5py.File) -> Measured:
    attrs = file.attrs
    fields = Finding.__dataclass_fields__
    warnings = [Finding(**{name: one[name] for name in fields}) for one in json.loads(attrs["warnings"])]
    channels = tuple(_channel(file[name]) for name in file)
    if not channels or len({len(one.values) for one in channels}) > 1:
        raise ValueError("its channels are not of one length")
    dt = float(attrs["dt"])
    if not (np.isfinite(dt) and dt > 0) or not all(np.isfinite(one.values).all() for one in channels):
        raise ValueError("it holds values that are not finite")
    texts: dict[str, Any] = {name: str(attrs[name]) for name in ("title", "source", "source_sha256", "mapping")}
    return Measured(dt, channels, float(attrs["start_s"]), test=str(attrs["test"]) or None, warnings=tuple(warnings), **texts)


def _channel(dataset: h5py.Dataset) -> MeasuredChannel:
    role, number = str(dataset.attrs["role"]), int(dataset.attrs["number"]) or None
    unit, label, column = (str(dataset.attrs[name]) for name in ("unit", "label", "column"))
    if key(role, number) != dataset.name.lstrip("/") or unit not in SI.values():
        raise ValueError(f"{dataset.name} is no channel of a known role in SI")
    return MeasuredChannel(role, number, dataset[:], unit, label, column)


def _damaged(path: Path, reason: object) -> RecordingError:
    fix = "import the measurements again with `rths import`, or run the plan again"
    return RecordingError(Issue("", f"{path.name} is no complete {SCHEMA} or {RUN} recording: {reason}", fix=fix))
