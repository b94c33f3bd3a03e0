"""A plan as tables: labels, units and factors come from the declarations of the fields."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rths_engine.planning.field_text import LISTED, declared, written

_HIDDEN = {"kind", "schema_", "name", "notes", "template"}


@dataclass(frozen=True, slots=True)
class Row:
    """A number of the plan with its label and unit."""

    label: str
    value: str
    unit: str = ""


@dataclass(frozen=True, slots=True)
class Grid:
    """A table of equal parts, one per row: for example storeys with mass, stiffness and height."""

    title: str
    columns: list[str]
    rows: list[list[str]]


@dataclass(slots=True)
class Group:
    """One part of the plan: its fields, and its lists of parts."""

    title: str
    rows: list[Row] = field(default_factory=list)
    grids: list[Grid] = field(default_factory=list)


def groups(title: str, part: BaseModel, test: str = "", leave_out: Sequence[str] = ()) -> list[Group]:
    """The groups of `part` and of each part nested in it, without fields that the kind of `test` does not use."""
    own = Group(title)
    nested: list[Group] = []
    for info, value in _fields(part, test, leave_out):
        label = info.title or ""
        if isinstance(value, BaseModel):
            if any(True for _ in _fields(value)):
                nested += groups(f"{label}: {_name(value)}" if _name(value) else label, value)
            else:
                own.rows.append(Row(label, _name(value)))
        elif isinstance(value, tuple | list) and value and isinstance(value[0], BaseModel):
            own.grids.append(_grid(label, value))
        elif isinstance(value, dict):
            own.rows += [Row(f"{label}: {path}", how) for path, how in value.items()]
        elif isinstance(value, tuple) and value and isinstance(value[0], tuple) and len(value[0]) <= LISTED:
            own.grids.append(_matrix(label, value, info))
        elif value is not None and value != ():
            own.rows.append(Row(label, written(value, info), declared(info).get("shown_label", "")))
        elif info.description:
            own.rows.append(Row(label, info.description.removeprefix("empty: ")))
    return [group for group in [own, *nested] if group.rows or group.grids]


def _matrix(title: str, rows: Sequence[Sequence[float]], info: FieldInfo) -> Grid:
    unit = declared(info).get("shown_label", "")
    columns = [str(number) for number in range(1, len(rows[0]) + 1)]
    return Grid(f"{title}, {unit}" if unit else title, columns, [[written(value, info) for value in row] for row in rows])


def _grid(title: str, parts: Sequence[BaseModel]) -> Grid:
    kept = [(name, info) for name, info in type(parts[0]).model_fields.items() if name not in _HIDDEN]
    units = [declared(info).get("shown_label", "") for _, info in kept]
    columns = [f"{info.title}, {unit}" if unit else info.title or "" for (_, info), unit in zip(kept, units, strict=True)]
    rows = [[written(getattr(part, name), info) for name, info in kept] for part in parts]
    return Grid(title, columns, rows)


def _fields(part: BaseModel, test: str = "", leave_out: Sequence[str] = ()) -> Iterator[tuple[FieldInfo, Any]]:
    for name, info in type(part).model_fields.items():
        used = not test or test in declared(info).get("tests", [test])
        if used and name not in _HIDDEN and name not in leave_out:
            yield info, getattr(part, name)


def _name(part: BaseModel) -> str:
    title = getattr(type(part), "title", "")
    return title if isinstance(title, str) else ""
