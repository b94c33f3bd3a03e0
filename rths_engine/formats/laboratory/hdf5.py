"""HDF5 and recordings of this program: every numeric dataset, with unit, scale, start and step from its attributes.

Links to other files, external storage and virtual datasets are not followed, because they could name any file of the machine.
"""

from __future__ import annotations

import io
import json
from typing import Any

import h5py
import numpy as np

from rths_engine.formats import tree
from rths_engine.formats.expansion import Expansion
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.table import MOST_COLUMNS, Table, refuse_many
from rths_engine.foundation.errors import FileError, Issue

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
# by definition of HDF5's dimension scales and tables, and of PyTables
_OF_LIBRARIES = {
    "CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "DIMENSION_LABELS", "TITLE", "VERSION", "FLAVOR", "NROWS",
    "PYTABLES_FORMAT_VERSION", "_Netcdf4Dimid", "_Netcdf4Coordinates", "_NCProperties",
}  # fmt: skip
_RUN = "rths-recording/"


def looks_like(source: Source) -> bool:
    """Whether the content is an HDF5 file, also after a user block."""
    return any(source.head[at : at + 8] == _SIGNATURE for at in (0, 512, 1024, 2048))


def read(source: Source) -> Table:
    """Read the file. Raises FileError for errors of any kind, which a damaged file can cause."""
    raw = source.bytes()
    try:
        with h5py.File(io.BytesIO(raw), "r") as file:
            nodes = (
                _run(file, Expansion(len(raw)))
                if str(file.attrs.get("schema")).startswith(_RUN)
                else _group(file, tree.DEEPEST, Expansion(len(raw)))
            )
            return tree.table(nodes, "HDF5")
    except FileError:
        raise
    except Exception as error:
        problem = f"cannot be read as HDF5: {type(error).__name__}"
        raise FileError(Issue("file", problem, fix="write the file again, or export it as CSV")) from None


def _group(group: h5py.Group, depth: int, expansion: Expansion) -> dict[str, Any]:
    found = _attributes(group)
    for name in group:
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            continue
        expansion.node()
        item = group[name]
        if isinstance(item, h5py.Group) and depth > 0:
            found[name] = _group(item, depth - 1, expansion)
        elif isinstance(item, h5py.Dataset) and not item.is_virtual and not item.external:
            _add(found, name, item, expansion)
    return found


def _add(found: dict[str, Any], name: str, item: h5py.Dataset, expansion: Expansion) -> None:
    expansion.add(item.nbytes if item.shape is not None else 0)
    if item.dtype.kind in "fiub" and item.shape is not None:
        refuse_many(item.size)
        about = _attributes(item)
        found[name] = {**about, "data": item[()]} if about else item[()]
    elif item.dtype.names and item.ndim == 1:  # rows of named columns, such as those of a table
        refuse_many(item.size * len(item.dtype.names))
        rows = item[()]
        found[name] = {**_attributes(item), **{key: rows[key] for key in item.dtype.names if rows.dtype[key].kind in "fiub"}}
    elif item.shape == () and (text := _plain(item[()])) is not None:
        found[name] = text


def _attributes(item: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    plain = {name: _plain(value) for name, value in item.attrs.items() if name not in _OF_LIBRARIES and name[:6] != "FIELD_"}
    return {name: value for name, value in plain.items() if value is not None}


def _plain(value: Any) -> Any:
    """A text, a number or an array of numbers; None for everything else."""
    if isinstance(value, bytes):
        return value.decode("utf-8", "replace")
    if isinstance(value, np.ndarray):
        return value if value.dtype.kind in "fiub" and 0 < value.size <= MOST_COLUMNS else None
    return value if isinstance(value, str | int | float | np.number) else None


def _run(file: h5py.File, expansion: Expansion) -> dict[str, Any]:
    """Channels of the recording of a run. Its first row is at the end of the first substep."""
    signals, dt = file["signals"], float(file.attrs["dt"])
    refuse_many(signals.size)
    expansion.add(signals.nbytes)
    values = signals[()]
    channels = json.loads(file.attrs["channels"])
    return {one["key"]: {"data": values[:, k], "dt": f"{dt!r} s", "units": one["unit"]} for k, one in enumerate(channels)}


FORMAT = Format(
    key="hdf5",
    title="HDF5",
    of="measurement",
    extensions=("h5", "hdf5"),
    defined="The HDF5 file format, The HDF Group",
    header="attributes: unit, time step or rate, start, scale, gain, sensitivity, marks of missing values",
    compared="number of samples, duration, time step, peak, where attributes state them",
    looks_like=looks_like,
    read=read,
    library="h5py",
    apart=True,
)
