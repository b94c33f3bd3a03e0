"""A measured recording, `rths-measured/1`: channels at one uniform step, SI, one HDF5 dataset each.

Datasets `x_meas.1`, `f_meas.1`, `ag`, ... float64 (samples,) with attributes `role`, `number`, `unit`, `label`, `column`; file
attributes `schema`, `title`, `test`, `dt` (s), `start_s` (of the first sample, in the source's time), `source` (name or path),
`source_sha256`, `mapping` (YAML), `warnings` (JSON), `code_version`. Datasets of a large file are not compressed: they
lie in one piece and are mapped when the recording is loaded.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from rths_engine import __version__
from rths_engine.formats.scratch import on_disk, release, write_at
from rths_engine.foundation import files
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.recordings import damage
from rths_engine.recordings.measured import blocks
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.recording import Measured, MeasuredChannel
from rths_engine.recordings.measured.roles import SI, key

SCHEMA = "rths-measured/1"
PIECE = 1 << 17  # samples of a channel on disk that are written at once; chosen, see docs/decisions/0023


def save(path: Path, measured: Measured, durable: bool = True) -> None:
    """Write `measured` to `path` completely or not at all; `durable` waits until the disk holds it."""
    with files.temporary(path) as written:
        with h5py.File(written, "w") as file:
            places = _write(file, measured)
        _fill(written, places)
        if durable:
            files.sync(written)
        written.replace(path)
        if durable:
            files.sync(path.parent)


def load(path: Path) -> Measured:
    """Read a measured recording. Raises RecordingError where the file is missing, damaged or in another format."""
    with _opened(path) as file:
        return _read(file, path)


def head(path: Path) -> tuple[tuple[str, ...], float, float, int]:
    """Keys of the channels, time step (s), time of the first sample (s) and number of samples. Raises RecordingError."""
    with _opened(path) as file:
        keys = tuple(file)
        return keys, float(file.attrs["dt"]), float(file.attrs["start_s"]), len(file[keys[0]])


def chosen(path: Path, keys: Sequence[str], part: slice = slice(None)) -> dict[str, Array]:
    """The channels `keys` in a part of the samples, without reading the others. Raises RecordingError as `load` does."""
    with _opened(path) as file:
        return {name: _samples(file[name], path)[part] for name in keys if name in file}


@contextmanager
def _opened(path: Path) -> Iterator[h5py.File]:
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") != SCHEMA or not len(file):
                raise ValueError(f"its schema is {file.attrs.get('schema')!r}")
            yield file
    except FileNotFoundError:
        raise RecordingError(Issue("", f"the recording {path.name} does not exist")) from None
    except damage.KINDS as error:
        fix = "import the measurements again"
        raise RecordingError(Issue("", f"{path.name} is not a complete {SCHEMA} recording: {error}", fix=fix)) from None


def _write(file: h5py.File, measured: Measured) -> list[tuple[int, Array]]:
    """Write all but the samples of channels on disk; returns their places in the file (bytes) and these samples."""
    places: list[tuple[int, Array]] = []
    for one in measured.channels:
        if on_disk(one.values):
            dataset = _reserved(file, one.key, len(one.values))
            places.append((dataset.id.get_offset(), one.values))
        else:
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

    return places


def _reserved(file: h5py.File, name: str, samples: int) -> h5py.Dataset:
    """A dataset of float64 in one piece of the file, not compressed, whose samples are not written yet."""
    space, settings = h5py.h5s.create_simple((samples,)), h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    settings.set_alloc_time(h5py.h5d.ALLOC_TIME_EARLY)
    settings.set_fill_time(h5py.h5d.FILL_TIME_NEVER)
    return h5py.Dataset(h5py.h5d.create(file.id, name.encode(), h5py.h5t.IEEE_F64LE, space, settings))


def _fill(path: Path, places: list[tuple[int, Array]]) -> None:
    """Write the samples of reserved datasets, on threads: the HDF5 library would write one after the other."""
    if not places:
        return
    with path.open("r+b", buffering=0) as file:

        def fill(place: tuple[int, Array]) -> None:
            at, values = place
            for part in blocks.parts(len(values), PIECE):
                write_at(file.fileno(), at + part.start * values.itemsize, values[part])
                release(values[part])

        blocks.each(fill, places, threads=True)


def _read(file: h5py.File, path: Path) -> Measured:
    attrs = file.attrs
    fields = Finding.__dataclass_fields__
    warnings = [Finding(**{name: one[name] for name in fields}) for one in json.loads(attrs["warnings"])]
    channels = tuple(_channel(file[name], path) for name in file)
    if not channels or len({len(one.values) for one in channels}) > 1:
        raise ValueError("its channels differ in length")
    dt = float(attrs["dt"])
    if not (np.isfinite(dt) and dt > 0) or not all(blocks.extent(one.values).finite for one in channels):
        raise ValueError("it contains values that are not finite")
    texts: dict[str, Any] = {name: str(attrs[name]) for name in ("title", "source", "source_sha256", "mapping")}
    return Measured(dt, channels, float(attrs["start_s"]), test=str(attrs["test"]) or None, warnings=tuple(warnings), **texts)


def _channel(dataset: h5py.Dataset, path: Path) -> MeasuredChannel:
    role, number = str(dataset.attrs["role"]), int(dataset.attrs["number"]) or None
    unit, label, column = (str(dataset.attrs[name]) for name in ("unit", "label", "column"))
    if key(role, number) != dataset.name.lstrip("/") or unit not in SI.values():
        raise ValueError(f"{dataset.name} is not a channel of a known role in SI")
    return MeasuredChannel(role, number, _samples(dataset, path), unit, label, column, str(dataset.attrs.get("moved", "")))


def _samples(dataset: h5py.Dataset, path: Path) -> Array:
    """The samples of a dataset; mapped from the file where they lie in one piece."""
    at = dataset.id.get_offset()
    if at is None or not dataset.size or dataset.dtype != np.dtype("<f8") or dataset.file.filename != str(path):
        whole: Array = dataset[:]
        return whole
    return np.memmap(path, float, "r", at, dataset.shape)
