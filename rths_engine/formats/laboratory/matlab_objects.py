"""Tables, timetables, time series and Simulink's outputs in MATLAB files, by their raw properties as mat-io reads them.

mat-io gives durations as whole seconds where MATLAB shows seconds, so that steps below a second would be lost; the properties
hold them in milliseconds as float64.
"""

from __future__ import annotations

import tempfile
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from rths_engine.formats import stamps
from rths_engine.formats.statement import Statement, count
from rths_engine.formats.table import Column, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError

# by definition of MATLAB: units of timeseries.TimeInfo, in s
_SECONDS = {"seconds": 1.0, "milliseconds": 1e-3, "microseconds": 1e-6, "nanoseconds": 1e-9, "minutes": 60.0, "hours": 3600.0}
_TRANSPARENT = {"Data", "Values", "Storage_"}  # properties whose names say nothing of the signal
_DEEPEST = 12  # chosen; see docs/decisions/0023


@dataclass
class Found:
    """What the objects contain: columns with their own clocks, the arrays beside them as a tree, and what was left out.

    `read`: the variables that were read.
    """

    tree: dict[str, Any] = field(default_factory=dict)
    columns: list[Column] = field(default_factory=list)
    statements: list[Statement] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    read: list[str] = field(default_factory=list)


def read(raw: bytes, names: Mapping[str, str]) -> Found:
    """The objects in the variables `names`, each with its class where the variable itself is the object.

    A note says what was left out: all of them without the extra `formats`.
    """
    found = Found()
    if not names:
        return found
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            matio = import_module("matio")
        except ImportError:
            extra = ".venv/bin/pip install -e '.[formats]'"
            found.notes += [f"{_named(*one)} is left out; to read it: {extra}" for one in names.items()]
            return found
        path = Path(folder) / "objects.mat"
        path.write_bytes(raw)
        for name, of_class in names.items():
            before = len(found.columns)
            try:
                value = matio.load_from_mat(str(path), raw_data=True, variable_names=[name])[name]
                rest = _plain(name, value, found, _DEEPEST)
            except FileError:
                raise
            except Exception as error:
                found.notes.append(f"{_named(name, of_class)} cannot be read ({type(error).__name__}): left out")
                continue
            found.read.append(name)
            if isinstance(rest, Mapping) and rest:
                found.tree[name] = rest
            elif len(found.columns) == before:
                found.notes.append(f"{_named(name, of_class)} contains no time series or table: left out")
    return found


def _named(name: str, of_class: str) -> str:
    return f"{name} (an object of MATLAB's class {of_class})" if of_class else f"{name} (it contains objects of MATLAB)"


def _plain(path: str, value: Any, found: Found, depth: int) -> Any:
    """The arrays and texts of a value as a tree. Objects on the way become columns."""
    if depth == 0 or value is None:
        return None
    if hasattr(value, "classname") and hasattr(value, "properties"):
        return _object(path, str(value.classname), value.properties, found, depth)
    if not isinstance(value, np.ndarray):
        return None
    if value.dtype.names:
        rows = [{key: _plain(f"{path}/{key}", one[key], found, depth - 1) for key in value.dtype.names} for one in value.flat]
        kept = [{key: one for key, one in row.items() if one is not None} for row in rows]
        return kept[0] if len(kept) == 1 else kept or None
    if value.dtype == object:
        items = {str(k): _plain(f"{path}/{k}", one, found, depth - 1) for k, one in enumerate(value.flat, start=1)}
        kept_items = {key: one for key, one in items.items() if one is not None}
        texts = list(kept_items.values())
        return texts if texts and all(isinstance(one, str) for one in texts) else kept_items or None
    if value.dtype.kind == "U":
        return "".join(value.flat[:1])
    return np.squeeze(value) if value.dtype.kind in "fiub" and value.size > 0 else None


def _object(path: str, kind: str, about: Any, found: Found, depth: int) -> Any:
    """The columns of an object and of the objects in it; of a simulation's output, also the arrays in it as a tree."""
    if not isinstance(about, Mapping):
        return None
    if kind == "timeseries":
        _time_series(path, about, found)
    elif kind == "timetable":
        _timetable(path, _first(about.get("any")), found)
    elif kind == "table":
        props = _first(about.get("props"))
        units = _texts(props["VariableUnits"]) if props is not None and "VariableUnits" in props.dtype.names else []
        found.columns += _variables(path, about.get("data"), _texts(about.get("varnames")), units, found)
    elif kind == "Simulink.SimulationOutput":
        return _plain(path, about.get("Data"), found, depth - 1)
    else:
        for name, one in about.items():
            inside = getattr(one, "properties", None)
            own = _text(inside.get("Name")) if isinstance(inside, Mapping) else ""
            part = own or ("" if name in _TRANSPARENT else name)
            _plain(f"{path}/{part}".rstrip("/"), one, found, depth - 1)
    return None


def _time_series(path: str, about: Mapping[str, Any], found: Found) -> None:
    clock, data_info = about["TimeInfo"].properties, about["DataInfo"].properties
    storage = about.get("Storage_")
    stored = getattr(storage, "properties", None) or {}
    own = about.get("Data_")
    values = np.asarray(own if isinstance(own, np.ndarray) and own.size else stored.get("Data", []))
    times = np.ravel(clock["Time_"])
    length = int(np.ravel(clock.get("Length", 0))[0])
    unit, factor = _text(clock.get("Units")), _SECONDS.get(_text(clock.get("Units")), 0.0)
    if values.dtype.kind not in "fiub" or values.size == 0:
        found.notes.append(f"{path} contains no numbers: left out")
        return
    refuse_many(values.size)
    samples = len(times) or length
    columns = _by_rows(path, values, samples, _text(data_info.get("Units")))
    if len(times) and columns:
        found.statements.append(count(len(times), len(columns[0].values), path, path))
    if length and columns:
        found.statements.append(count(length, len(columns[0].values), f"{path} Length", path))
    if not factor:
        found.notes.append(f"{path}: the unit of its times, {unit or 'none'}, is not known: give the step")
        found.columns += columns
    elif len(times):
        found.columns += stamps.timed(columns, Column(f"{path}/Time", times.astype(float) * factor, "s"))
    else:
        step, start = (float(np.ravel(clock[key])[0]) if np.size(clock[key]) else 0.0 for key in ("Increment_", "Start_"))
        found.columns += [replace(one, dt=step * factor or None, start=start * factor) for one in columns]


def _by_rows(path: str, values: Array, samples: int, unit: str) -> list[Column]:
    """A column, or one for each element of the matrix of a sample, in MATLAB's order."""
    values = np.squeeze(values).astype(float)
    if values.ndim < 2:
        return [Column(path, np.atleast_1d(values), unit)]
    rows = values if values.shape[0] == samples and values.ndim == 2 else np.moveaxis(values, -1, 0)
    rows = rows.reshape(rows.shape[0], -1, order="F")
    return [Column(f"{path}.{k + 1}", rows[:, k].copy(), unit) for k in range(rows.shape[1])]


def _timetable(path: str, about: Any, found: Found) -> None:
    if about is None:
        return
    columns = _variables(path, about["data"], _texts(about["varNames"]), _texts(about["varUnits"]), found)
    rows = int(np.ravel(about["numRows"])[0])
    found.statements += [count(rows, len(one.values), path, one.name) for one in columns]
    times = about["rowTimes"]
    if hasattr(times, "properties"):
        found.columns += stamps.timed(columns, Column(f"{path}/{_texts(about['dimNames'])[0]}", _times(times), "s"))
        return
    given = _first(times)
    step = _times(given["stepSize"]) if hasattr(given["stepSize"], "properties") else np.zeros(0)
    rate = float(np.ravel(given["sampleRate"])[0])
    dt = 1 / rate if bool(np.ravel(given["specifiedAsRate"])[0]) else float(step[0]) if len(step) else None
    start = float(_times(given["origin"], absolute=False)[0])
    if dt is None:
        found.notes.append(f"{path}: its step in months or days is not constant: give the step")
    found.columns += [replace(one, dt=dt, start=start) for one in columns]


def _variables(path: str, data: Any, names: Sequence[str], units: Sequence[str], found: Found) -> list[Column]:
    """The numeric variables of a table: one column, or several for a matrix."""
    columns: list[Column] = []
    for k, (name, value) in enumerate(zip(names, data.flat, strict=False)):
        unit = units[k] if k < len(units) else ""
        if hasattr(value, "properties") and value.classname in ("duration", "datetime"):
            columns.append(Column(f"{path}/{name}", _times(value), "s", quantity="time"))
        elif isinstance(value, np.ndarray) and value.dtype.kind in "fiub" and value.ndim == 2:
            refuse_many(value.size)
            parts = value.shape[1]
            columns += [
                Column(f"{path}/{name}" + (f".{j + 1}" if parts > 1 else ""), value[:, j].astype(float), unit)
                for j in range(parts)
            ]
        else:
            found.notes.append(f"{path}/{name} contains no numbers: left out")
    return columns


def _times(value: Any, absolute: bool = True) -> Array:
    """Seconds of a duration; of dates, seconds from the first (or 0 where `absolute` is False and there is one date)."""
    about = value.properties
    if "millis" in about:
        return np.ravel(np.asarray(about["millis"], dtype=float)) / 1000
    if "data" not in about:
        return np.zeros(0)
    dates = np.ravel(np.real(about["data"])).astype(float) / 1000
    return dates - dates[0] if absolute or len(dates) else dates


def _first(value: Any) -> Any:
    return value.flat[0] if isinstance(value, np.ndarray) and value.size and value.dtype.names else None


def _text(value: Any) -> str:
    return str(value.flat[0]) if isinstance(value, np.ndarray) and value.dtype.kind == "U" and value.size else ""


def _texts(value: Any) -> list[str]:
    return [_text(one) for one in value.flat] if isinstance(value, np.ndarray) and value.dtype == object else []
