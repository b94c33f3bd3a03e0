"""MATLAB v7.3: variables, structs, cells and texts in an HDF5 file; tables and time series with the extra `formats`."""

from __future__ import annotations

import io
from dataclasses import dataclass, field, replace
from typing import Any

import h5py
import numpy as np

from rths_engine.formats import damage, tree
from rths_engine.formats.expansion import Expansion
from rths_engine.formats.format import Format
from rths_engine.formats.laboratory import matlab_objects
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table, distinct, refuse_many
from rths_engine.foundation.errors import FileError, Issue

_HEAD, _HDF5 = b"MATLAB ", b"\x89HDF\r\n\x1a\n"
# by definition of MATLAB: the classes of numbers
_NUMERIC = {"double", "single", "logical", *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64))}
_LONGEST_TEXT = 10_000  # chosen; see docs/decisions/0023


@dataclass
class _Read:
    file: h5py.File
    expansion: Expansion
    objects: dict[str, str] = field(default_factory=dict)  # class of each variable that is or contains an object
    notes: list[str] = field(default_factory=list)
    variable: str = ""


def looks_like(source: Source) -> bool:
    """Whether the content is HDF5 behind the text of a MATLAB file."""
    return source.head.startswith(_HEAD) and source.head[512:520] == _HDF5


def read(source: Source) -> Table:
    """Read the file. Raises FileError for errors of any kind, which a damaged file can cause."""
    raw = source.bytes()
    with damage.refused("MATLAB v7.3", "save it again, or export it as CSV"), h5py.File(io.BytesIO(raw), "r") as file:
        state = _Read(file, Expansion(len(raw)))
        variables: dict[str, Any] = {}
        for name in file:
            if name.startswith("#") or not isinstance(file.get(name, getlink=True), h5py.HardLink):
                continue
            state.variable = name
            value = _value(state, file[name], tree.DEEPEST)
            if value is not None:
                variables[name] = value
    found = matlab_objects.read(raw, state.objects)
    known = {name: value for name, value in variables.items() if name not in found.read}
    table = tree.table({**known, **found.tree}, "MATLAB v7.3")
    columns, notes = distinct([*table.columns, *found.columns]), (*state.notes, *found.notes, *table.notes)
    if not columns:
        told = "; ".join(notes) or "its variables are texts or single numbers"
        raise FileError(Issue("file", f"contains no column of numbers: {told}", fix="save the signals as arrays or structs"))
    return replace(table, columns=columns, notes=notes, statements=(*table.statements, *found.statements))


def _value(state: _Read, item: h5py.Group | h5py.Dataset, depth: int) -> Any:
    """A struct as a mapping, a struct array as a list of mappings, a cell by its numbers, an array or a text; else None."""
    state.expansion.node()
    of_class = _class(item)
    if "MATLAB_object_decode" in item.attrs or (of_class and of_class not in {*_NUMERIC, "char", "cell", "struct"}):
        if of_class != "function_handle":
            top = item.parent == state.file
            state.objects.setdefault(state.variable, of_class if top else "")
        return None
    if depth == 0 or "MATLAB_empty" in item.attrs:
        return None
    if isinstance(item, h5py.Group):
        if "MATLAB_sparse" in item.attrs:
            state.notes.append(f"{item.name.strip('/')} is a sparse matrix: left out")
            return None
        return _struct(state, item, depth)
    if item.is_virtual or item.external or item.shape is None:
        return None
    refuse_many(item.size)
    state.expansion.add(item.nbytes)
    if of_class == "char":
        return "".join(map(chr, item[()].ravel())) if item.dtype.kind == "u" and item.size <= _LONGEST_TEXT else None
    if item.dtype == h5py.ref_dtype:
        inside = [_value(state, state.file[one], depth - 1) for one in item[()].ravel() if one]
        texts = [one for one in inside if isinstance(one, str)]
        return texts if len(texts) == len(inside) else {str(k): one for k, one in enumerate(inside, start=1) if one is not None}
    return np.asarray(item[()]).T if item.dtype.kind in "fiub" else None


def _struct(state: _Read, group: h5py.Group, depth: int) -> Any:
    """A struct. Its fields are references where it is an array of structs."""
    fields = {name: group[name] for name in group if isinstance(group.get(name, getlink=True), h5py.HardLink)}
    many = [one for one in fields.values() if isinstance(one, h5py.Dataset) and one.dtype == h5py.ref_dtype and not _class(one)]
    if many and len(many) == len(fields):
        size = many[0].size
        refuse_many(size * len(fields))
        rows = [
            {name: _value(state, state.file[one[()].ravel()[k]], depth - 1) for name, one in fields.items() if one.size == size}
            for k in range(size)
        ]
        return [{name: one for name, one in row.items() if one is not None} for row in rows]
    found = {name: _value(state, one, depth - 1) for name, one in fields.items()}
    return {name: one for name, one in found.items() if one is not None}


def _class(item: h5py.Group | h5py.Dataset) -> str:
    found = item.attrs.get("MATLAB_class", b"")
    return found.decode("ascii", "replace") if isinstance(found, bytes) else str(found)


FORMAT = Format(
    key="matlab73",
    title="MATLAB v7.3",
    of="measurement",
    extensions=("mat",),
    defined="MAT-File Format 7.3, MathWorks: HDF5 with MATLAB's attributes",
    header="units, time step, scale and start of each struct; times and units of timetables and time series",
    compared="number of samples, time step",
    looks_like=looks_like,
    read=read,
    public=15,
    public_check="mat73 0.65 and mat-io 1.0.2",
    library="h5py; mat-io for objects (extra `formats`)",
    apart=True,
)
