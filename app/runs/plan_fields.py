"""Label, unit and choices of a field of a plan by its path, from the declarations of the engine."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rths_engine.foundation import location
from rths_engine.planning.differences import ONE
from rths_engine.planning.field_text import declared
from rths_engine.planning.plan import Plan

VARIES = "SI; the unit depends on the kind of the part"


@dataclass(frozen=True, slots=True)
class PlanField:
    """A field of a plan. A number in the plan is `factor` times the number in `unit`. `choices` are the texts of a choice."""

    label: str
    within: str
    unit: str
    factor: float
    numeric: bool
    help: str
    choices: tuple[tuple[str, str], ...] = ()


@lru_cache(maxsize=4096)
def plan_field(path: str) -> PlanField | None:
    """The declaration of a field by its path in a plan, `stations.0.compensator.alpha_es`; None where no plan can have it."""
    kinds: list[Any] = [Plan]
    around: list[str] = []
    found: list[FieldInfo] = []
    models: list[type[BaseModel]] = []
    for step in path.split("."):
        if step.isdecimal() and len(step) < 4:
            kinds = [one for kind in kinds for one in location.choices(location.inside(kind, int(step)))]
            if not around:
                return None
            around[-1] = f"{ONE.get(around[-1], around[-1])} {int(step) + 1}"
            continue
        models = [one for one in kinds if isinstance(one, type) and issubclass(one, BaseModel)]
        found = list(_declared(models, step))
        if not found:
            return None
        around.append(found[0].title or step)
        kinds = [one for info in found for one in location.choices(info.annotation)]
    if path.endswith(".kind") and len(around) > 1:
        choices = {model.model_fields["kind"].default: str(getattr(model, "title", model.__name__)) for model in models}
        return PlanField(around[-2], ": ".join(around[:-2]), "", 1.0, False, "kind of the part", tuple(choices.items()))
    return _of(found, around, kinds)


def _declared(models: list[type[BaseModel]], step: str) -> Iterator[FieldInfo]:
    for model in models:
        for name, info in model.model_fields.items():
            if step in (name, info.alias):
                yield info


def _of(found: list[FieldInfo], around: list[str], kinds: list[Any]) -> PlanField | None:
    if any(isinstance(one, type) and issubclass(one, BaseModel) for one in kinds):
        return None
    units = {(declared(info).get("shown_label", ""), float(declared(info).get("factor", 1.0))) for info in found}
    unit, factor = units.pop() if len(units) == 1 else ("", 1.0)
    numeric = any(one in (int, float) for one in kinds)
    help = (found[0].description or "") if not units else VARIES
    titles = declared(found[0]).get("titles", {})
    literal = [value for one in kinds if get_origin(one) is Literal for value in get_args(one)]
    choices = {str(value): str(titles.get(value, value)) for value in literal}
    return PlanField(around[-1], ": ".join(around[:-1]), unit, factor, numeric, help.split("\n")[0], tuple(choices.items()))
