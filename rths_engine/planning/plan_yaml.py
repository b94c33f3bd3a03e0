"""Plans as YAML: SI numbers, each with its unit as a comment."""

from __future__ import annotations

import io
from typing import Any

import yaml
from pydantic import BaseModel

from rths_engine.foundation import units
from rths_engine.foundation.errors import Issue, PlanError, cut
from rths_engine.planning.field_text import declared
from rths_engine.planning.yaml_scalars import plain

# chosen; see docs/decisions/0023
LARGEST = 20_000_000  # characters
DEEPEST = 30


def parse(text: str) -> Any:
    """The data in a YAML (or JSON) text. Raises PlanError with the line of an error; aliases and tags are not allowed.

    The text is read as events of the C library libyaml, and its scalars by the core schema of YAML 1.2: without recursion, and
    in a time that grows with the length of the text only.
    """
    if len(text) > LARGEST:
        raise PlanError(Issue("", f"the plan has more than {LARGEST:,} characters", fix="shorten it"))
    try:
        return _read(text)
    except yaml.MarkedYAMLError as error:
        raise PlanError(Issue("", f"{_line(error.problem_mark)}the text is not valid YAML: {error.problem}")) from None
    except (yaml.YAMLError, ValueError) as error:
        raise PlanError(Issue("", f"the text is not valid YAML: {str(error).splitlines()[0]}")) from None


def _read(text: str) -> Any:
    """The data of the one document in a text."""
    whole: list[Any] = []
    inside: list[_Open] = []
    for event in yaml.parse(text, Loader=yaml.CSafeLoader):
        if isinstance(event, yaml.ScalarEvent) and event.tag is None:
            value: Any = plain(event.value) if event.implicit[0] else event.value
        elif isinstance(event, yaml.AliasEvent):
            raise _refused(event, "YAML aliases (*name) are not allowed", "write the value instead of the alias")
        elif isinstance(event, yaml.NodeEvent) and event.tag is not None and event.tag != "!":
            raise _refused(event, f"YAML tags ({event.tag}) are not allowed", "write the value without the tag")
        elif isinstance(event, yaml.CollectionEndEvent):
            value = inside.pop().value
        elif isinstance(event, yaml.ScalarEvent):  # "!" marks text
            value = event.value
        elif isinstance(event, yaml.CollectionStartEvent):
            if inside and inside[-1].expects_key:
                raise _refused(event, "a list or mapping cannot be the name of a field", "write the name as text")
            if len(inside) == DEEPEST:
                raise _refused(event, f"the text is nested deeper than {DEEPEST} levels", None)
            inside.append(_Open({} if isinstance(event, yaml.MappingStartEvent) else []))
            continue
        elif isinstance(event, yaml.DocumentStartEvent) and whole:
            raise _refused(event, "the text has a second document after ---", "leave one document in the text")
        else:
            continue
        if not inside:
            whole.append(value)
        elif inside[-1].expects_key:
            inside[-1].name(event)
        else:
            inside[-1].take(value)
    return whole[0] if whole else None


class _Open:
    """A mapping or a list whose end has not been read."""

    def __init__(self, value: dict[str, Any] | list[Any]):
        self.value = value
        self.key: str | None = None

    @property
    def expects_key(self) -> bool:
        return self.key is None and isinstance(self.value, dict)

    def name(self, event: Any) -> None:
        """Take a scalar as the name of the field that follows; names are text."""
        if event.value in self.value:
            raise _refused(event, f"the field {cut(event.value, 80)} is given twice", "leave one of the two")
        self.key = event.value

    def take(self, value: Any) -> None:
        if isinstance(self.value, list):
            self.value.append(value)
        elif self.key is not None:
            self.value[self.key] = value
            self.key = None


def _refused(event: Any, problem: str, fix: str | None) -> PlanError:
    return PlanError(Issue("", f"{_line(event.start_mark)}{problem}", fix=fix))


def _line(mark: Any) -> str:
    return f"line {mark.line + 1}: " if mark else ""


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
