"""Columns of nested data, as in JSON, MATLAB and HDF5 files: `{force: {data: [...], dt: 0.01, units: kN}, ...}`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from rths_engine.formats.table import Column, Table, refuse_many, spread
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
DEEPEST = 12
_STEP = re.compile(r"(dt|delta_?t|time_?step|sampling_?(interval|period)|ts)(_s)?", re.IGNORECASE)
_RATE = re.compile(r"(fs|rate|freq|frequency|(sampling|sample)_?(freq|frequency|rate))(_hz)?", re.IGNORECASE)
_UNIT = re.compile(r"units?", re.IGNORECASE)
_OF = re.compile(r"(.+?)[ _](units?)|(units?)[ _](?:of[ _])?(.+)", re.IGNORECASE)
_VALUES = {"data", "values", "value", "signal", "signals", "y"}
_NAMES = {"columns", "names", "channels", "labels", "header", "headers"}


def table(tree: Mapping[str, Any], format: str) -> Table:
    """A table of every numeric array with more than one sample; its name is its path with `/` between the keys."""
    hints: dict[str, str] = {}
    columns = list(_columns("", tree, None, hints, DEEPEST))
    return Table(format, tuple(_distinct(columns)), hints=hints)


def _columns(path: str, node: Mapping[str, Any], dt: float | None, hints: dict[str, str], depth: int) -> list[Column]:
    if depth == 0:
        return []
    dt = _step(node) or dt
    arrays = {name: found for name, value in node.items() if (found := array(value)) is not None and found.size > 1}
    texts = {str(name): value for name, value in node.items() if isinstance(value, str)}
    unit = next((text for name, text in texts.items() if _UNIT.fullmatch(name)), "")
    of = _units_of(texts)
    hints |= {f"{path}/{name}".strip("/"): text for name, text in of.items() if name not in arrays}
    names = next((_texts(node[name]) for name in node if str(name).lower() in _NAMES), [])
    listed = next((_texts(value) for name, value in node.items() if _UNIT.fullmatch(str(name))), [])
    columns: list[Column] = []
    for name, values in arrays.items():
        own = of.get(name, unit)
        collapsed = path if path and str(name).lower() in _VALUES and len(arrays) == 1 else f"{path}/{name}".strip("/")
        signals = spread(collapsed, values, names if values.ndim == 2 else (), own, dt)
        if len(listed) == len(signals) > 1:
            signals = [Column(one.name, one.values, text, one.dt) for one, text in zip(signals, listed, strict=True)]
        columns += signals
    for name, value in node.items():
        inside = _records(value) if isinstance(value, list) else value
        if isinstance(inside, Mapping):
            columns += _columns(f"{path}/{name}".strip("/"), inside, dt, hints, depth - 1)
    return columns


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


def _records(rows: list[Any]) -> dict[str, Any] | None:
    """Rows `[{t: 0, x: 1}, ...]` as columns."""
    if not rows or not all(isinstance(row, dict) for row in rows):
        return None
    return {name: [row.get(name) for row in rows] for name in rows[0] if not isinstance(rows[0][name], dict | list | str)}


def _step(node: Mapping[str, Any]) -> float | None:
    for name, value in node.items():
        number = _number(value)
        if number is None or number <= 0:
            continue
        plain = re.sub(r"[ \-]+", "_", str(name).strip())
        if _STEP.fullmatch(plain):
            return number
        if _RATE.fullmatch(plain):
            return 1 / number
    return None


def _number(value: Any) -> float | None:
    found = np.asarray(value) if isinstance(value, int | float | np.ndarray | np.generic) else None
    if found is None or isinstance(value, bool) or found.size != 1 or found.dtype.kind not in "fiu":
        return None
    number = float(found.reshape(-1)[0])
    return number if np.isfinite(number) and abs(number) < 1e12 else None


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
        result.append(Column(name, column.values, column.unit, column.dt))
    return result
