"""HDF5, MATLAB v7.3 and recordings of this program: every numeric dataset, with the units from its attributes.

Links to other files, external storage and virtual datasets are not followed, because they could name any file of the machine.
"""

from __future__ import annotations

import io
import json
from typing import Any

import h5py
import numpy as np

from rths_engine.formats import tree
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table, refuse_many
from rths_engine.foundation.errors import FileError, Issue

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_RUN = "rths-recording/"


def looks_like(source: Source) -> bool:
    """Whether the content is an HDF5 file, also after a user block."""
    return any(source.head[at : at + 8] == _SIGNATURE for at in (0, 512, 1024, 2048))


def read(source: Source) -> Table:
    """Read the file. Raises FileError for errors of any kind, which a damaged file can cause."""
    raw = source.bytes()
    try:
        with h5py.File(io.BytesIO(raw), "r") as file:
            matlab = raw.startswith(b"MATLAB 7.3")
            nodes = _run(file) if str(file.attrs.get("schema")).startswith(_RUN) else _group(file, matlab, tree.DEEPEST)
            return tree.table(nodes, "MATLAB v7.3" if matlab else "HDF5")
    except FileError:
        raise
    except Exception as error:
        problem = f"cannot be read as HDF5: {type(error).__name__}"
        raise FileError(Issue("file", problem, fix="write the file again, or export it as CSV")) from None


def _group(group: h5py.Group, matlab: bool, depth: int) -> dict[str, Any]:
    found: dict[str, Any] = {name: value for name, value in group.attrs.items() if _plain(value)}
    for name in group:
        if name.startswith("#") or not isinstance(group.get(name, getlink=True), h5py.HardLink):
            continue
        item = group[name]
        if isinstance(item, h5py.Group) and depth > 0:
            found[name] = _group(item, matlab, depth - 1)
        elif isinstance(item, h5py.Dataset) and not item.is_virtual and not item.external:
            _add(found, name, item, matlab)
    return found


def _add(found: dict[str, Any], name: str, item: h5py.Dataset, matlab: bool) -> None:
    if matlab and item.attrs.get("MATLAB_class") == b"char":
        if item.dtype == np.uint16 and item.size <= 200:
            found[name] = "".join(map(chr, item[()].ravel()))
    elif item.dtype.kind in "fiub" and item.shape is not None:
        refuse_many(item.size)
        about = {key: value for key, value in item.attrs.items() if key in {"unit", "units", "dt", "fs"} and _plain(value)}
        about = {key: value.decode("utf-8", "replace") if isinstance(value, bytes) else value for key, value in about.items()}
        found[name] = {"data": item[()], **about} if about else item[()]


def _run(file: h5py.File) -> dict[str, Any]:
    """Channels of the recording of a run. Its first row is at the end of the first substep."""
    signals, dt = file["signals"], float(file.attrs["dt"])
    refuse_many(signals.size)
    values = signals[()]
    channels = json.loads(file.attrs["channels"])
    return {one["key"]: {"data": values[:, k], "dt": dt, "units": one["unit"]} for k, one in enumerate(channels)}


def _plain(value: Any) -> bool:
    return isinstance(value, str | bytes | int | float | np.number)


FORMAT = Format(
    key="hdf5",
    title="HDF5 and MATLAB v7.3",
    of="measurement",
    extensions=("h5", "hdf5", "mat"),
    defined="The HDF5 file format, The HDF Group",
    header="attributes: unit, time step or rate",
    compared="",
    looks_like=looks_like,
    read=read,
    library="h5py",
    apart=True,
)
