"""Read a plan and check everything in it that needs no ground motion."""

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
    """A plan from its JSON form as the model that was made to check it. Raises PlanError with every issue."""
    if not isinstance(data, Mapping):
        raise PlanError(Issue("", "a plan is a mapping of fields", fix="start from a template"))
    model = Model(validated(Plan, data))
    found = tuple(issues(model))
    if found:
        raise PlanError(found)
    _ = model.factor  # which a singular scheme has none of
    return model


def plan_from_yaml(text: str) -> Plan:
    """A plan from YAML. Raises PlanError for YAML that is not valid, as for a plan that is not valid."""
    return model_from_yaml(text).plan


def model_from_yaml(text: str) -> Model:
    """A plan from YAML as the model that was made to check it. Raises PlanError as `plan_from_yaml` does."""
    return read_model(plan_yaml.parse(text))


def plan_to_yaml(plan: Plan) -> str:
    """A plan as YAML in SI with each number's unit as a comment; `plan_from_yaml` reads the same plan back."""
    return plan_yaml.write(plan)
