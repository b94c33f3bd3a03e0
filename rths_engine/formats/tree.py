"""Columns of nested data, as in JSON, MATLAB and HDF5 files: `{force: {data: [...], dt: 0.01, units: kN}, ...}`.

A list of channels, `[{name: force, unit: kN, rate: 250, data: [...]}, ...]`, gives one column for each channel.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rths_engine.formats.attributes import Attributes
from rths_engine.formats.statement import Statement
from rths_engine.formats.table import Column, Table, refuse_many, spread
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
DEEPEST = 12
_UNIFORM = 1e-3  # of a step: between a stated step and the mean step of a time array
_SAME = 0.02  # of a step: the same, in the unit of time that fits best
_JITTER = 0.5  # of a step: time stamps that differ more from equal steps are not compared with a stated step
_OF = re.compile(r"(.+?)[ _](units?)|(units?)[ _](?:of[ _])?(.+)", re.IGNORECASE)
_VALUES = {"data", "values", "value", "signal", "signals", "y", "samples"}
_TIME = {"t", "time", "times", "timestamps"}
_TIME_NAMED = re.compile(
    r"(?:t|[Tt]imes?|TIME|time_?stamps?|[Zz]eit|[Tt]emps|[Tt]iempo)(?P<unit>(?:[ _]| ?[(\[])[a-zµ]+[)\]]?)?"
)
_OF_TIME = ("s", "ms", "us", "min", "h")
_NAMES = {"columns", "names", "channels", "labels", "header", "headers"}
_LISTS = {"channels", "signals", "data", "series", "sensors", "traces", "columns", "variables", "measurements", "items"}
_NAME = ("name", "channel", "channel_name", "label", "title", "id", "key")
_UNITS = {"unit", "units"}
_ABOUT = {"attributes", "attrs", "properties", "meta", "metadata"}


@dataclass
class _Found:
    """What was found so far: columns, units of quantities that are not columns, statements, and what was not applied."""

    columns: list[Column] = field(default_factory=list)
    hints: dict[str, str] = field(default_factory=dict)
    statements: list[Statement] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    stated: list[str] = field(default_factory=list)  # for each column, the attribute that states its step


@dataclass(frozen=True)
class _Given:
    """What the objects around an array state: step (s) and the attribute that states it, start, marks, units by name."""

    dt: float | None = None
    where: str = ""
    start: float = 0.0
    missing: tuple[float, ...] = ()
    units: Mapping[str, str] = field(default_factory=dict)

    def and_of(self, about: Attributes, node: Mapping[str, Any]) -> _Given:
        dt, start = about.step, about.start
        units = {str(name): text for key in node if str(key).lower() in _UNITS for name, text in _mapping(node[key])}
        return _Given(
            dt or self.dt,
            about.step_name if dt else self.where,
            self.start if start is None else start,
            about.missing or self.missing,
            {**self.units, **{name: text for name, text in units.items() if isinstance(text, str)}},
        )


def table(tree: Mapping[str, Any], format: str) -> Table:
    """A table of every numeric array with more than one sample; its name is its path with `/` between the keys.

    Step and start are valid for everything below their object, unit and scale for the arrays of their object.
    """
    found = _Found()
    _collect("", tree, _Given(), found, DEEPEST)
    found.statements += step_statements(found.columns, found.stated)
    columns = tuple(_distinct(found.columns))
    return Table(format, columns, hints=found.hints, notes=tuple(found.notes), statements=tuple(found.statements))


def _collect(path: str, node: Mapping[str, Any], given: _Given, found: _Found, depth: int) -> None:
    if depth == 0:
        return
    about = Attributes.of({**{k: v for name in node if str(name).lower() in _ABOUT for k, v in _mapping(node[name])}, **node})
    given = given.and_of(about, node)
    where = f"{path}: " if path else ""
    found.notes += [f"{where}{doubt}" for doubt in about.doubts]
    first = len(found.columns)
    arrays = {str(name): one for name, value in node.items() if (one := array(value)) is not None and one.size > 1}
    if len(arrays) > 1:
        arrays = {name: one for name, one in arrays.items() if name not in about.of_values} or arrays
    texts = {str(name): value for name, value in node.items() if isinstance(value, str)}
    of = _units_of(texts)
    found.hints |= {f"{path}/{name}".strip("/"): text for name, text in of.items() if name not in arrays}
    names = next((_texts(node[name]) for name in node if str(name).lower() in _NAMES), [])
    listed = next((_texts(value) for name, value in node.items() if re.fullmatch("units?", str(name), re.IGNORECASE)), [])
    signals = [name for name in arrays if name.lower() not in _TIME]
    lone = len(signals) == 1 and (bool(path) or signals[0].lower() in _VALUES)
    if not lone and signals:
        found.notes += _unclear(path, about)
    for name, values in arrays.items():
        collapsed = path if path and name.lower() in _VALUES and lone else f"{path}/{name}".strip("/")
        own = of.get(name) or (about.unit if name in signals else "") or given.units.get(collapsed.rpartition("/")[2], "")
        values = _present(collapsed, _upright(values), given.missing, found)
        applied = ""
        if lone and name in signals:
            values, own, applied, left = about.scaled(values, own)
            found.notes += [f"{collapsed}: {text}" for text in (left, *about.others) if text]
            found.statements += about.peak(collapsed, values, own)
        columns = spread(collapsed, values, names if values.ndim == 2 else (), own, given.dt)
        if len(listed) == len(columns) > 1:
            columns = [replace(one, unit=text) for one, text in zip(columns, listed, strict=True)]
        found.columns += [replace(one, start=given.start, applied=applied) for one in columns]
        found.stated += [given.where] * len(columns)
        if lone and name in signals and columns:
            found.statements += about.statements(collapsed, [len(columns[0].values)], given.dt)
    for name, value in node.items():
        for key, inside in _inside(str(name), value):
            _collect(f"{path}/{key}".strip("/"), inside, given, found, depth - 1)
    if not lone and (counts := [len(one.values) for one in found.columns[first:]]):
        found.statements += about.statements(path, counts, given.dt)


def _present(name: str, values: Array, missing: tuple[float, ...], found: _Found) -> Array:
    """The values, with NaN for those that an attribute states to mark missing samples."""
    marked = np.isin(values, missing) if missing else np.zeros(0, bool)
    if not marked.any():
        return values
    found.notes.append(f"{name}: {int(marked.sum())} of {marked.size} samples are missing by its attributes")
    return np.where(marked, np.nan, values)


def _mapping(value: Any) -> list[tuple[str, Any]]:
    return list(value.items()) if isinstance(value, Mapping) else []


def _unclear(path: str, about: Attributes) -> list[str]:
    """Scale, gain, offset and sensitivity beside several arrays: it is not stated to which array they belong."""
    where = f"{path}: " if path else ""
    names = ", ".join(about.scaling)
    return [f"{where}{names} not applied: it is not stated to which array it belongs"] if names else []


def step_statements(columns: Sequence[Column], stated: Sequence[str]) -> list[Statement]:
    """The stated step beside the step of each time array, in its unit; without a unit, in the unit of time that fits best.

    `stated`: for each column, the attribute that states its step.
    """
    result = []
    lengths = Counter(len(one.values) for one in columns)
    for column, where in zip(columns, stated, strict=True):
        name, dt = column.name.rpartition("/")[2], column.dt
        time = _TIME_NAMED.fullmatch(name)
        if dt is None or time is None or lengths[len(column.values)] < 2 or (step := _even_step(column.values)) is None:
            continue
        written = unit_names.read(column.unit or (time["unit"] or "").strip(" ()[]_"))
        if written.dimension == "time":
            step *= written.scale * units.factor(written.unit)
        elif written.none:
            step = min((step * units.factor(one) for one in _OF_TIME), key=lambda one: abs(np.log(one / dt)))
            if abs(step / dt - 1) > _SAME:
                step = _even_step(column.values) or step
        else:
            continue
        result.append(Statement(f"time step of {name}", where, dt, step, "s", _UNIFORM * step))
    return result


def _even_step(times: Array) -> float | None:
    """The mean step of times that increase in nearly equal steps; None for others."""
    if len(times) < 3 or not np.isfinite(times).all() or not ((steps := np.diff(times)) > 0).all():
        return None
    usual = float(np.median(steps))
    return float(np.mean(steps)) if float(np.max(np.abs(steps / usual - 1))) <= _JITTER else None


def _inside(name: str, value: Any) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """The objects in a value: one object, the rows of a list as columns, or the channels of a list, each by its own name."""
    if isinstance(value, Mapping):
        if name.lower() not in _ABOUT:
            yield name, value
    elif isinstance(value, list) and value and all(isinstance(one, Mapping) for one in value):
        if any(_is_channel(one) for one in value):
            for at, one in enumerate(value, start=1):
                own = next((str(one[key]) for key in _NAME if isinstance(one.get(key), str) and one[key].strip()), str(at))
                yield own if name.lower() in _LISTS and own != str(at) else f"{name}/{own}", one
        else:
            yield name, _records(value)


def _is_channel(item: Mapping[str, Any]) -> bool:
    return any((one := array(value)) is not None and one.size > 1 for value in item.values())


def _upright(values: Array) -> Array:
    """The array with its samples along the first axis, as `spread` takes them."""
    values = np.squeeze(values)
    return values.T if values.ndim == 2 and values.shape[0] < values.shape[1] else values


def array(value: Any) -> Array | None:
    """`value` as an array of numbers; None where it is not numeric or is ragged."""
    if isinstance(value, np.ndarray):
        numeric = value.dtype.kind in "fiu" or value.dtype == bool
        if numeric:
            refuse_many(value.size)
        return np.asarray(value, dtype=float) if numeric else None
    if isinstance(value, list) and value and not isinstance(value[0], dict | str):
        try:
            found = np.array(value, dtype=float)  # null is NaN
        except (TypeError, ValueError):
            return None
        return found if found.ndim <= 2 else None
    return None


def _records(rows: list[Any]) -> dict[str, Any]:
    """Rows `[{t: 0, x: 1}, ...]` as columns."""
    return {name: [row.get(name) for row in rows] for name in rows[0] if not isinstance(rows[0][name], dict | list | str)}


def _texts(value: Any) -> list[str]:
    found = value.tolist() if isinstance(value, np.ndarray) else value
    return found if isinstance(found, list) and found and all(isinstance(item, str) for item in found) else []


def _units_of(texts: Mapping[str, str]) -> dict[str, str]:
    """Units from keys such as `displacement units`, by the quantity they name."""
    found = {}
    for name, text in texts.items():
        if match := _OF.fullmatch(name):
            found[match[1] or match[4]] = text
    return found


def _distinct(columns: list[Column]) -> list[Column]:
    seen: dict[str, int] = {}
    result = []
    for column in columns:
        seen[column.name] = seen.get(column.name, 0) + 1
        name = column.name if seen[column.name] == 1 else f"{column.name}~{seen[column.name]}"
        result.append(replace(column, name=name))
    return result
