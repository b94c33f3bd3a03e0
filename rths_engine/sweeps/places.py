"""Fields of a plan by path: what stands there, its label, unit and bounds; and a plan with other values in its fields."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from annotated_types import Ge, Gt, Le, Lt
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rths_engine.foundation import units
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.planning.plan import Plan

Keys = tuple[str | int, ...]
EVERY = "*"
OWN = ("schema", "name", "notes", "template", "pace", "known")  # decide nothing of the result
ONE = {"Stations": "Station", "Storeys": "Storey", "Forces on floors": "Force"}  # label of a list -> that of one item


@dataclass(frozen=True, slots=True)
class Place:
    """One field of a plan: its keys, its label with the labels of the parts around it, its declaration and its value."""

    keys: Keys
    label: str
    info: FieldInfo
    value: Any

    @property
    def path(self) -> str:
        return ".".join(str(key) for key in self.keys)

    @property
    def unit(self) -> str | None:
        """SI unit; None for a field that is not a number."""
        extra = self.info.json_schema_extra
        number = isinstance(self.value, int | float) and not isinstance(self.value, bool)
        if isinstance(extra, dict) and "unit" in extra and (number or self.value is None):
            return str(extra["unit"])
        return "1" if number else None

    @property
    def shown(self) -> str:
        extra = self.info.json_schema_extra
        return str(extra.get("shown", "1")) if isinstance(extra, dict) else "1"

    @property
    def whole(self) -> bool:
        """Whether only whole numbers are allowed."""
        return self.info.annotation is int

    @property
    def bounds(self) -> tuple[float, float]:
        """The smallest and the largest number that the field takes, in SI."""
        low, high = -math.inf, math.inf
        for bound in self.info.metadata:
            if isinstance(bound, Ge):
                low = float(bound.ge)  # type: ignore[arg-type]
            elif isinstance(bound, Gt):
                low = math.nextafter(float(bound.gt), math.inf)  # type: ignore[arg-type]
            elif isinstance(bound, Le):
                high = float(bound.le)  # type: ignore[arg-type]
            elif isinstance(bound, Lt):
                high = math.nextafter(float(bound.lt), -math.inf)  # type: ignore[arg-type]
        return low, high

    def outside(self, value: float) -> str | None:
        """The bound that a number breaks, in words with the unit shown; None for a number that the field takes."""
        words = {Ge: ("ge", ">="), Gt: ("gt", ">"), Le: ("le", "<="), Lt: ("lt", "<")}
        low, high = self.bounds
        if low <= value <= high:
            return None
        kinds = (Ge, Gt) if value < low else (Le, Lt)
        bound = next(one for one in self.info.metadata if isinstance(one, kinds))
        name, sign = words[type(bound)]
        return f"needs a value {sign} {in_words(getattr(bound, name), self.shown)}"

    def as_dict(self) -> dict[str, Any]:
        """JSON form, for a form that offers the fields of a plan."""
        low, high = self.bounds
        return {
            "path": self.path,
            "label": self.label,
            "unit": self.unit,
            "shown": self.shown,
            "shown_label": units.pretty(self.shown),
            "factor": units.factor(self.shown),
            "whole": self.whole,
            "value": self.value,
            "lowest": low if math.isfinite(low) else None,
            "highest": high if math.isfinite(high) else None,
        }


def in_words(value: float, shown: str) -> str:
    """An SI value in the unit shown, `36007 kN/m`."""
    return f"{units.from_si(float(value), shown):.6g} {units.pretty(shown)}".rstrip()


def numbers(plan: Plan) -> list[Place]:
    """Every number of a plan that a sweep can vary, in the order of the plan."""
    names = [name for name in Plan.model_fields if name not in ("schema_", *OWN)]
    return [place for name in names for place in _below(plan, (name,), "", plan.test) if place.unit is not None]


def resolve(plan: Plan, path: str, where: str) -> list[Place]:
    """The fields that a path names; `*` stands for every item of a list. Raises PlanError at `where`."""
    keys = path.split(".")
    if keys[0] in OWN:
        raise PlanError(Issue(where, "is a field that does not change the result of a test", path, "choose another field"))
    found = list(_walk(plan, plan, keys, (), "", FieldInfo(), where, path))
    if not found:
        raise PlanError(Issue(where, "names no field: the list is empty", path, "choose another field"))
    return found


def with_values(data: Mapping[str, Any], changes: Sequence[tuple[Keys, Any]]) -> dict[str, Any]:
    """The JSON form of a plan with other values at some keys. Shares everything else with `data`, which stays as it is."""
    changed = dict(data)
    for keys, value in changes:
        inside: Any = changed
        for key in keys[:-1]:
            one = inside[key]
            inside[key] = list(one) if isinstance(one, list | tuple) else dict(one)
            inside = inside[key]
        inside[keys[-1]] = value
    return changed


def _walk(
    plan: Plan, inside: Any, keys: Sequence[str], done: Keys, label: str, info: FieldInfo, where: str, path: str
) -> Iterator[Place]:
    if not keys:
        yield Place(done, label, info, inside.model_dump(mode="json") if isinstance(inside, BaseModel) else inside)
        return
    key, rest = keys[0], keys[1:]
    if isinstance(inside, BaseModel):
        field = type(inside).model_fields.get(key)
        if field is None:
            raise PlanError(_no_field(inside, done, key, where, path))
        yield from _walk(plan, getattr(inside, key), rest, (*done, key), _within(label, field), field, where, path)
    elif isinstance(inside, tuple):
        for index in range(len(inside)) if key == EVERY else [_index(key, len(inside), done, where, path)]:
            item = _item(label, info, index)
            yield from _walk(plan, inside[index], rest, (*done, index), item, info, where, path)
    else:
        problem = f"has nothing below '{_dotted(done)}', which is one value"
        raise PlanError(Issue(where, problem, path, f"name the field itself: {_dotted(done)}"))


def _below(inside: Any, keys: Keys, label: str, test: str) -> Iterator[Place]:
    """Every field at and below the last of the keys that the kind of test uses."""
    info = type(inside).model_fields[keys[-1]]
    extra = info.json_schema_extra
    used: Any = extra.get("tests", [test]) if isinstance(extra, dict) else [test]
    if test not in used:
        return
    value, label = getattr(inside, str(keys[-1])), _within(label, info)
    if isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _below(value, (*keys, name), label, test)
    elif isinstance(value, tuple):
        for index, one in enumerate(value):
            if isinstance(one, BaseModel):
                for name in type(one).model_fields:
                    yield from _below(one, (*keys, index, name), _item(label, info, index), test)
    else:
        yield Place(keys, label, info, value)


def _within(label: str, info: FieldInfo) -> str:
    own = info.title or "Kind"
    return f"{label}: {own}" if label else own


def _item(label: str, info: FieldInfo, index: int) -> str:
    """The label of one item of a list: `Station 1`."""
    name = info.title or ""
    return f"{label.removesuffix(name)}{ONE.get(name, name)} {index + 1}"


def _no_field(inside: BaseModel, done: Keys, key: str, where: str, path: str) -> Issue:
    names = [name for name in type(inside).model_fields if done or name not in ("schema_", *OWN)]
    near = difflib.get_close_matches(key, names, 1)
    part = f"'{_dotted(done)}'" if done else "the plan"
    kind = getattr(inside, "kind", None)
    of_kind = f" of the kind '{kind}'" if kind else ""
    fix = f"did you mean {near[0]}?" if near else f"its fields: {', '.join(names)}"
    return Issue(where, f"{part}{of_kind} has no field '{key}'", path, fix)


def _index(key: str, count: int, done: Keys, where: str, path: str) -> int:
    if key.isascii() and key.isdecimal() and int(key[:9]) < count:
        return int(key)
    bound = f"an index from 0 to {count - 1}, or {EVERY} for every item" if count else "an item, but the list is empty"
    raise PlanError(Issue(where, f"'{_dotted(done)}' needs {bound}, not '{key}'", path, "correct the path"))


def _dotted(keys: Keys) -> str:
    return ".".join(str(key) for key in keys)
