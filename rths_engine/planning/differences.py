"""The fields in which plans differ: path, label, unit and the value of each plan. Drafts that are not valid are read too."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from rths_engine.foundation import location, units
from rths_engine.foundation.errors import RthsError
from rths_engine.planning.field_text import DIGITS, LISTED, declared, written
from rths_engine.planning.plan import Plan

NONE = "–"  # the plan has no such field
PRESENT = "present"  # an item of a list whose items are all of one kind
ONE = {"Stations": "Station", "Storeys": "Storey", "Forces on floors": "Force"}  # name of a list -> that of one item
TEXTS = (DIGITS, 12, 17)  # significant digits, until texts of unequal values differ; 17 by definition of float64


@dataclass(frozen=True, slots=True)
class FieldDifference:
    """A field in which plans differ. `path` is that of errors, `stations.0.compensator.alpha_es`; `within` names the part.

    `values` are SI, as in the plan, one for each plan; `texts` are in the shown `unit`. A plan without the field has None.
    """

    path: str
    within: str
    label: str
    unit: str
    values: tuple[Any, ...]
    texts: tuple[str, ...]

    @property
    def title(self) -> str:
        """The label with the names of the parts around it."""
        return _titled(self.within, self.label)


@dataclass(frozen=True, slots=True)
class _Leaf:
    """A value of one plan. `item` is the path of the item of a list that holds it, such as a station; empty outside lists."""

    value: Any
    within: str
    label: str
    info: FieldInfo = field(default_factory=FieldInfo)
    item: str = ""


def differences(plans: Sequence[Mapping[str, Any]], leave_out: Sequence[str] = ()) -> list[FieldDifference]:
    """Find the fields in which `plans` (JSON form) differ, in the order of the plan.

    `leave_out` names fields of the whole plan. A missing field has its default. Text with a unit is compared as a number. A
    part that one plan lacks, such as a station, is one row; its fields are compared between the plans that have it.
    """
    found = [dict(_of_model(plan, Plan, "", "", "", plan.get("test", "hybrid"), leave_out)) for plan in plans]
    return [row for path in _order(found) if (row := _row(path, [one.get(path) for one in found], found))]


def titles(plan: Mapping[str, Any]) -> dict[str, tuple[str, str]]:
    """Map each path of a plan (JSON form, which need not be valid) to its title and its SI unit, empty for none."""
    leaves = _of_model(plan, Plan, "", "", "", plan.get("test", "hybrid"))
    return {
        path: (_titled(leaf.within, leaf.label), units.pretty(declared(leaf.info).get("unit", "1"))) for path, leaf in leaves
    }


def _titled(within: str, label: str) -> str:
    return f"{within}: {label}" if within else label


def _row(path: str, leaves: Sequence[_Leaf | None], plans: Sequence[Mapping[str, _Leaf]]) -> FieldDifference | None:
    leaf = next(one for one in leaves if one)
    comparable = [one for one, plan in zip(leaves, plans, strict=True) if one or not leaf.item or leaf.item in plan]
    first = comparable[0]
    if all(one is None or one.value is None for one in comparable):
        return None
    if all((one and one.value) == (first and first.value) and (one is None) == (first is None) for one in comparable):
        return None
    values = tuple(one.value if one else None for one in leaves)
    unit = declared(leaf.info).get("shown_label", "")
    return FieldDifference(path, leaf.within, leaf.label, unit, values, _texts(leaves))


def _texts(leaves: Sequence[_Leaf | None]) -> tuple[str, ...]:
    """Texts that differ where the values differ: with as many digits as this needs."""
    texts: list[str] = []
    for digits in TEXTS:
        texts = [NONE if one is None else _text(one, digits) for one in leaves]
        pairs = {(text, repr(one.value) if one else "") for text, one in zip(texts, leaves, strict=True)}
        if len(pairs) == len(set(texts)):
            break
    return tuple(texts)


def _text(leaf: _Leaf, digits: int) -> str:
    value = leaf.value
    if value is None:
        return (leaf.info.description or "").removeprefix("empty: ") or "empty"
    if isinstance(value, tuple):
        return _listed(value, leaf.info, digits)
    if isinstance(value, int) and not isinstance(value, bool) and declared(leaf.info).get("factor", 1.0) != 1.0:
        value = float(value)
    return written(value, leaf.info, digits) or "empty"


def _listed(values: tuple[Any, ...], info: FieldInfo, digits: int) -> str:
    """A list or a matrix; a long one as its number of values with smallest, largest and root mean square value."""
    rows = [one if isinstance(one, tuple) else (one,) for one in values]
    numbers = [one for row in rows for one in row if isinstance(one, int | float)]
    if len(numbers) > LISTED and len(numbers) == sum(map(len, rows)):
        power = (sum(one * one for one in numbers) / len(numbers)) ** 0.5
        low, high, rms = (written(float(one), info, digits) for one in (min(numbers), max(numbers), power))
        return f"{len(numbers)} values from {low} to {high}, RMS {rms}"
    between = "; " if any(len(row) > 1 for row in rows) else ", "
    return between.join(written(row, info, digits) for row in rows) or "none"


def _order(plans: Sequence[Mapping[str, _Leaf]]) -> list[str]:
    """The paths of all plans; a path that the plans before lack follows the path that it follows in its own plan."""
    order: list[str] = []
    known: set[str] = set()
    for plan in plans:
        at = 0
        for path in plan:
            if path in known:
                at = order.index(path) + 1
            else:
                order.insert(at, path)
                known.add(path)
                at += 1
    return order


Leaves = Iterator[tuple[str, _Leaf]]


def _of_model(
    data: Mapping[str, Any],
    model: type[BaseModel],
    path: str,
    within: str,
    item: str,
    test: Any,
    leave_out: Sequence[str] = (),
) -> Leaves:
    """The leaves of a part, and of keys that it does not have; without defaults that the kind of `test` does not use."""
    names = {info.alias or name: (name, info) for name, info in model.model_fields.items()}
    for key, (name, info) in names.items():
        if name != "kind" and key not in leave_out:
            default = _default(info)
            value = data.get(key, default)
            unused = test not in declared(info).get("tests", [test]) and value == default
            if value is not PydanticUndefined and not unused:
                yield from _of_field(value, info, f"{path}{key}", within, item, test)
    for key in data:
        if key not in names and key not in leave_out and isinstance(key, str):
            yield f"{path}{key}", _Leaf(_frozen(data[key]), within, f"{key} (not a field of the plan)", item=item)


def _of_field(value: Any, info: FieldInfo, path: str, within: str, item: str, test: Any) -> Leaves:
    label = info.title or path.rpartition(".")[2]
    inner = f"{within}: {label}" if within else label
    kind = info.annotation
    if isinstance(value, Mapping):
        if _model(value, kind) is None:
            if _models(kind):
                yield path, _Leaf(f"{value.get('kind')} (unknown)", within, label, item=item)
            for key, one in value.items():
                yield f"{path}.{key}", _Leaf(_frozen(one), inner, str(key), info, item)
        else:
            yield from _of_part(value, _model(value, kind), path, within, label, item, test)
    elif isinstance(value, list | tuple) and any(isinstance(one, Mapping) for one in value):
        for index, one in enumerate(value):
            numbered = f"{ONE.get(label, label)} {index + 1}"
            yield from _of_item(one, location.inside(kind, index), f"{path}.{index}", within, numbered, item, test)
    else:
        yield path, _Leaf(_in_si(value, info), within, label, info, item)


def _of_part(value: Mapping[str, Any], model: Any, path: str, within: str, label: str, item: str, test: Any) -> Leaves:
    if "kind" in model.model_fields:
        yield path, _Leaf(getattr(model, "title", model.__name__), within, label, item=item)
    yield from _of_model(value, model, f"{path}.", f"{within}: {label}" if within else label, item, test)


def _of_item(value: Any, kind: Any, path: str, within: str, label: str, around: str, test: Any) -> Leaves:
    model = _model(value, kind)
    if not isinstance(value, Mapping) or model is None:
        yield path, _Leaf(_frozen(value), within, label, item=around)
        return
    title = getattr(model, "title", model.__name__) if "kind" in model.model_fields else PRESENT
    yield path, _Leaf(title, within, label, item=around)
    yield from _of_model(value, model, f"{path}.", f"{within}: {label}" if within else label, path, test)


def _model(value: Any, kind: Any) -> Any:
    """The class of a part: the only one of its type, or the one that its field `kind` names; None where there is none."""
    found = _models(kind)
    if len(found) == 1 or not isinstance(value, Mapping):
        return found[0] if found else None
    return next((one for one in found if one.model_fields["kind"].default == value.get("kind")), None)


def _models(kind: Any) -> list[Any]:
    return [one for one in location.choices(kind) if isinstance(one, type) and issubclass(one, BaseModel)]


def _default(info: FieldInfo) -> Any:
    value = info.get_default(call_default_factory=True)
    return value.model_dump(mode="json", by_alias=True) if isinstance(value, BaseModel) else value


def _in_si(value: Any, info: FieldInfo) -> Any:
    unit = declared(info).get("unit")
    if isinstance(value, list | tuple):
        return tuple(_in_si(one, info) for one in value)
    if isinstance(value, str) and unit:
        try:
            return units.parse(value, unit)
        except RthsError:
            return value
    return value


def _frozen(value: Any) -> Any:
    """Data of no declared form, as text where it is a mapping or a list."""
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)
