"""A measured recording, `rths-measured/1`: channels at one uniform step, SI, one HDF5 dataset each.

Datasets `x_meas.1`, `f_meas.1`, `ag`, ... float64 (samples,) with attributes `role`, `number`, `unit`, `label`, `column`; file
attributes `schema`, `title`, `test`, `dt` (s), `start_s` (of the first sample, in the source's time), `source` (name or path),
`source_sha256`, `mapping` (YAML), `warnings` (JSON), `code_version`.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from rths_engine import __version__
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.recording import Measured, MeasuredChannel
from rths_engine.recordings.measured.roles import SI, key

SCHEMA = "rths-measured/1"


def save(path: Path, measured: Measured) -> None:
    """Write `measured` to `path` completely or not at all."""
    with files.temporary(path) as written:
        with h5py.File(written, "w") as file:
            _write(file, measured)
        files.sync(written)
        written.replace(path)
        files.sync(path.parent)


def load(path: Path) -> Measured:
    """Read a measured recording. Raises RecordingError where the file is missing, damaged or in another format."""
    try:
        with h5py.File(path, "r") as file:
            return _read(file)
    except FileNotFoundError:
        raise RecordingError(Issue("", f"the recording {path.name} does not exist")) from None
    except (OSError, KeyError, TypeError, ValueError) as error:
        fix = "import the measurements again"
        raise RecordingError(Issue("", f"{path.name} is not a complete {SCHEMA} recording: {error}", fix=fix)) from None


def _write(file: h5py.File, measured: Measured) -> None:
    for one in measured.channels:
        options: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True}
        dataset = file.create_dataset(one.key, data=one.values, **options)
        about = {"role": one.role, "number": one.number or 0, "unit": one.unit, "label": one.label}
        dataset.attrs.update(about, column=one.column, moved=one.moved)
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
    if attrs.get("schema") != SCHEMA:
        raise ValueError(f"its schema is {attrs.get('schema')!r}")
    fields = Finding.__dataclass_fields__
    warnings = [Finding(**{name: one[name] for name in fields}) for one in json.loads(attrs["warnings"])]
    channels = tuple(_channel(file[name]) for name in file)
    if not channels or len({len(one.values) for one in channels}) > 1:
        raise ValueError("its channels differ in length")
    dt = float(attrs["dt"])
    if not (np.isfinite(dt) and dt > 0) or not all(np.isfinite(one.values).all() for one in channels):
        raise ValueError("it contains values that are not finite")
    texts: dict[str, Any] = {name: str(attrs[name]) for name in ("title", "source", "source_sha256", "mapping")}
    return Measured(dt, channels, float(attrs["start_s"]), test=str(attrs["test"]) or None, warnings=tuple(warnings), **texts)


def _channel(dataset: h5py.Dataset) -> MeasuredChannel:
    role, number = str(dataset.attrs["role"]), int(dataset.attrs["number"]) or None
    unit, label, column = (str(dataset.attrs[name]) for name in ("unit", "label", "column"))
    if key(role, number) != dataset.name.lstrip("/") or unit not in SI.values():
        raise ValueError(f"{dataset.name} is not a channel of a known role in SI")
    return MeasuredChannel(role, number, dataset[:], unit, label, column, str(dataset.attrs.get("moved", "")))
