"""Plans as YAML: SI numbers, each with its unit as a comment."""

from __future__ import annotations

import io
from typing import Any

from pydantic import BaseModel

from rths_engine.foundation import units
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.planning.field_text import declared

# chosen; see docs/decisions/0023
LARGEST = 20_000_000  # characters
DEEPEST = 30


def parse(text: str) -> Any:
    """The data in a YAML (or JSON) text. Raises PlanError with the line of an error; aliases are not allowed."""
    from ruamel.yaml import YAML
    from ruamel.yaml.error import MarkedYAMLError, YAMLError
    from ruamel.yaml.events import AliasEvent, CollectionEndEvent, CollectionStartEvent

    if len(text) > LARGEST:
        raise PlanError(Issue("", f"the plan has more than {LARGEST:,} characters", fix="shorten it"))
    try:
        depth = 0
        for event in YAML(typ="safe", pure=True).parse(text):
            depth += isinstance(event, CollectionStartEvent) - isinstance(event, CollectionEndEvent)
            if depth > DEEPEST:
                raise PlanError(Issue("", f"the text is nested deeper than {DEEPEST} levels"))
            if isinstance(event, AliasEvent):
                raise PlanError(
                    Issue("", "YAML aliases (*name) are not allowed in plans", fix="write the value instead of the alias")
                )
        return YAML(typ="safe", pure=True).load(text)
    except MarkedYAMLError as error:
        line = f"line {error.problem_mark.line + 1}: " if error.problem_mark else ""
        raise PlanError(Issue("", f"{line}the text is not valid YAML: {error.problem}")) from None
    except (YAMLError, ValueError, RecursionError) as error:
        raise PlanError(Issue("", f"the text is not valid YAML: {str(error).splitlines()[0]}")) from None


def write(plan: BaseModel) -> str:
    """YAML of a plan in the order of its fields, without those of other kinds of test that keep their default."""
    from ruamel.yaml import YAML

    yaml = YAML()
    yaml.width = 120
    stream = io.StringIO()
    written = _commented(plan)
    for key in _unused(plan):
        del written[key]
    yaml.dump(written, stream)
    return stream.getvalue()


def _unused(plan: BaseModel) -> list[str]:
    """Fields that a test of the plan's kind does not read, where they have their default."""
    kind = getattr(plan, "test", None)
    return [
        field.alias or name
        for name, field in type(plan).model_fields.items()
        if kind not in declared(field).get("tests", [kind]) and getattr(plan, name) == field.default
    ]


def _commented(value: Any) -> Any:
    from ruamel.yaml.comments import CommentedMap, CommentedSeq

    if isinstance(value, BaseModel):
        result = CommentedMap()
        for name, field in type(value).model_fields.items():
            key = field.alias or name
            result[key] = _commented(getattr(value, name))
            extra = field.json_schema_extra
            if isinstance(extra, dict) and extra.get("unit", "1") != "1" and isinstance(result[key], float):
                result.yaml_add_eol_comment(_comment(result[key], str(extra["unit"]), str(extra["shown"])), key)
        return result
    if isinstance(value, dict):
        return CommentedMap(value)
    if isinstance(value, tuple):
        items = CommentedSeq(_commented(item) for item in value)
        if all(isinstance(item, float) for item in value):
            items.fa.set_flow_style()
        return items
    return value


def _comment(value: float, unit: str, shown: str) -> str:
    return unit if unit == shown else f"{unit} = {units.from_si(value, shown):g} {shown}"
