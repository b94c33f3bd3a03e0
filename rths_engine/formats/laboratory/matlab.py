"""MATLAB up to v7: variables, structs, cells; tables, timetables and time series with the extra `formats`. v7.3 is HDF5."""

from __future__ import annotations

import io
import math
import warnings
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import scipy.io
from scipy.io.matlab import MatlabFunction, MatlabOpaque

from rths_engine.formats import damage, tree
from rths_engine.formats.expansion import Expansion
from rths_engine.formats.format import Format
from rths_engine.formats.laboratory import matlab_objects
from rths_engine.formats.laboratory.matlab_elements import elements
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table, distinct, refuse_many
from rths_engine.foundation.errors import FileError, Issue

_HEAD = b"MATLAB 5.0 MAT-file"
_LEAST = 1  # by definition of the format: bytes of the shortest number, as `whosmat` does not give the stored length


def looks_like(source: Source) -> bool:
    """Whether the file is a MATLAB file, by its header or its name."""
    return source.head.startswith(_HEAD) or source.extension == "mat"


def read(source: Source) -> Table:
    """Read the file. Raises FileError where no variable can be read, or where the file is cut."""
    with damage.refused("a MATLAB file", "save it again with `save -v7` or as CSV"):
        return _table(source.bytes())


def _table(raw: bytes) -> Table:
    variables: dict[str, Any] = {}
    objects: dict[str, str] = {}
    notes: list[str] = []
    expansion = Expansion(len(raw))
    if raw.startswith(_HEAD):
        for one in elements(raw):
            if one.of_class:
                objects[one.name] = one.of_class
                continue
            try:
                variables |= _loaded(one.file, expansion)
            except FileError:
                raise
            except Exception as error:
                notes.append(f"a variable at {one.where} cannot be read ({type(error).__name__}): left out")
    else:
        variables = _loaded(raw, expansion)  # a file before version 5
    if not variables and not objects:
        told = f": {'; '.join(notes)}" if notes else ""
        raise FileError(Issue("file", f"cannot be read as a MATLAB file{told}", fix="save it again with `save -v7` or as CSV"))
    objects |= {name: "" for name, value in variables.items() if _has_objects(value)}
    found = matlab_objects.read(raw, objects)
    known = {name: value for name, value in variables.items() if name not in found.read}
    table = tree.table({**known, **found.tree}, "MATLAB")
    columns = distinct([*table.columns, *found.columns])
    if not columns:
        told = "; ".join([*notes, *found.notes, *table.notes]) or "its variables are texts or single numbers"
        raise FileError(Issue("file", f"contains no column of numbers: {told}", fix="save the signals as arrays or structs"))
    statements = (*table.statements, *found.statements)
    return replace(table, columns=columns, notes=(*notes, *found.notes, *table.notes), statements=statements)


def _loaded(raw: bytes, expansion: Expansion) -> dict[str, Any]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for _, shape, _ in scipy.io.whosmat(io.BytesIO(raw)):
            refuse_many(math.prod(shape))
            expansion.add(math.prod(shape) * _LEAST)
        found = scipy.io.loadmat(io.BytesIO(raw), simplify_cells=True)
    return {name: _by_name(value) for name, value in found.items() if not name.startswith("__")}


def _by_name(value: Any) -> Any:
    """The value with the arrays of a cell under their numbers, as the fields of a struct are under their names."""
    if isinstance(value, dict):
        return {name: _by_name(one) for name, one in value.items()}
    if isinstance(value, np.ndarray) and value.dtype == object and value.dtype.names is None:
        value = list(value.flat)
    if isinstance(value, list) and any(isinstance(one, np.ndarray | list | dict) for one in value):
        if all(isinstance(one, dict) for one in value):
            return [_by_name(one) for one in value]  # a struct array
        return {str(k): _by_name(one) for k, one in enumerate(value, start=1)}
    return value


def _has_objects(value: Any) -> bool:
    if isinstance(value, MatlabOpaque) and not isinstance(value, MatlabFunction):
        return True
    inside: Iterable[Any] = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return any(_has_objects(one) for one in inside)


FORMAT = Format(
    key="matlab",
    title="MATLAB up to v7",
    of="measurement",
    extensions=("mat",),
    defined="MAT-File Format, MathWorks",
    header="units, time step, scale and start of each struct; times and units of timetables and time series",
    compared="number of samples, time step, length of each variable",
    looks_like=looks_like,
    read=read,
    public=47,
    public_check="mat-io 1.0.2; eight more differ only in cells of single numbers, which become one column",
    library="SciPy; mat-io for objects (extra `formats`)",
    apart=True,
)
