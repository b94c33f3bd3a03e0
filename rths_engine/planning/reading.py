"""Read a plan and check everything that does not need its ground motion."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.foundation.part import validated
from rths_engine.planning import plan_yaml
from rths_engine.planning.checks import issues
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan


def read_plan(data: Any) -> Plan:
    """A plan from its JSON form. Raises PlanError with every issue."""
    return read_model(data).plan


def read_model(data: Any) -> Model:
    """The model of a plan in JSON form, which the checks of the plan need too. Raises PlanError with every issue."""
    if not isinstance(data, Mapping):
        raise PlanError(Issue("", "a plan is a mapping of fields", fix="start from a template"))
    model = Model(validated(Plan, data))
    found = tuple(issues(model))
    if found:
        raise PlanError(found)
    _ = model.factor  # raises PlanError for a singular scheme
    return model


def plan_from_yaml(text: str) -> Plan:
    """A plan from YAML. Raises PlanError for invalid YAML and for an invalid plan."""
    return model_from_yaml(text).plan


def model_from_yaml(text: str) -> Model:
    """The model of a plan in YAML. Raises PlanError like `plan_from_yaml`."""
    return read_model(plan_yaml.parse(text))


def plan_to_yaml(plan: Plan) -> str:
    """A plan as YAML in SI, with the unit of each number as a comment. `plan_from_yaml` returns the same plan from it."""
    return plan_yaml.write(plan)
