"""The base classes of a plan's parts: frozen values in SI whose fields declare label, unit and bounds once.

Validation, JSON schema, labels of the web form and report all read this declaration.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar, get_args

from annotated_types import MaxLen
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator
from pydantic.fields import FieldInfo

from rths_engine.foundation import location, units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import MOST_ISSUES, Issue, PlanError, RthsError, limited

# chosen; see docs/decisions/0023
LONGEST_TEXT = 80  # characters of an invalid text that an error repeats
T = TypeVar("T", bound=BaseModel)


def quantity(
    label: str,
    unit: str = "1",
    shown: str | None = None,
    *,
    default: Any = ...,
    help: str = "",
    tests: Sequence[str] = (),
    **bounds: Any,
) -> Any:
    """Declare a field in the SI unit `unit`, which people read in `shown`. `bounds` are pydantic's gt, ge, lt and le.

    `tests` are the kinds of test that use the field. Empty: all kinds use it.
    """
    shown = shown or unit
    extra: dict[str, Any] = {"unit": unit, "shown": shown, "shown_label": units.pretty(shown), "factor": units.factor(shown)}
    extra |= {"tests": list(tests)} if tests else {}
    return Field(default, title=label, description=help or None, json_schema_extra=extra, **bounds)


class Value(BaseModel):
    """A frozen, validated value. Numbers are SI; text such as `"36007 kN/m"` is converted from its unit."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        validate_default=True,
        model_title_generator=lambda kind: getattr(kind, "title", kind.__name__),
    )

    @model_validator(mode="before")
    @classmethod
    def _read_units(cls, data: Any) -> Any:
        if not isinstance(data, Mapping):
            return data
        read = dict(data)
        for name, field in cls.model_fields.items():
            extra = field.json_schema_extra
            if name in read and isinstance(extra, dict) and "unit" in extra and not _too_long(read[name], field):
                read[name] = _in_si(read[name], str(extra["unit"]))
        return read


def kinds(union: Any) -> tuple[type[Any], ...]:
    """The classes of `Annotated[A | B, ...]` in their order: a registry's one list, whose positions are codes in the loop."""
    return get_args(get_args(union)[0])


class Part(Value):
    """A part with a compiled step. `kind` is its name in plans, `title` its name for people.

    `build(dt)` returns the parameter vector and the initial state vector of the compiled `step`.
    """

    title: ClassVar[str]

    def build(self, dt: float) -> tuple[Array, Array]:
        raise NotImplementedError


def validated(model: type[T], data: Any) -> T:
    """`data` as a `model`. Raises PlanError with every issue: its path, value and bound."""
    try:
        return model.model_validate(data)
    except ValidationError as error:
        details = error.errors(include_url=False)
        kept = [detail for detail in details if not _follows(detail, details)]
        raise PlanError(limited((_issue(detail, model) for detail in kept), len(kept))) from None


def _follows(detail: Any, details: list[Any]) -> bool:
    """Whether a list only appears too short because some of its items are not valid."""
    inside = detail["loc"]
    return detail["type"] == "too_short" and any(
        other is not detail and other["loc"][: len(inside)] == inside for other in details
    )


def _too_long(value: Any, field: FieldInfo) -> bool:
    """Whether a list is longer than its field allows; its items are not read then."""
    most = min((bound.max_length for bound in field.metadata if isinstance(bound, MaxLen)), default=math.inf)
    return isinstance(value, list | tuple) and len(value) > most


@dataclass(frozen=True, slots=True)
class _Unread:
    """Text that is not a valid quantity. pydantic rejects it in its place, and the issue states the problem."""

    text: str
    problem: str


def _in_si(value: Any, unit: str) -> Any:
    if isinstance(value, str):
        try:
            return units.parse(value, unit)
        except RthsError as error:
            return _Unread(value, error.issues[0].problem)
    if isinstance(value, list | tuple):
        return _list_in_si(value, unit)
    return value


def _list_in_si(items: list[Any] | tuple[Any, ...], unit: str) -> list[Any]:
    """The items in SI. After MOST_ISSUES texts that are no quantity, the rest stays as it is: no more are listed."""
    read, unread = [], 0
    for item in items:
        read.append(item if unread > MOST_ISSUES else _in_si(item, unit))
        unread += isinstance(read[-1], _Unread)
    return read


def _issue(detail: Any, model: type[BaseModel]) -> Issue:
    where = location.dotted(detail["loc"], model)
    problem = str(detail["msg"]).removeprefix("Value error, ")
    given = detail["input"]
    if isinstance(given, _Unread):
        return Issue(where, given.problem, given.text if len(given.text) <= LONGEST_TEXT else given.text[:LONGEST_TEXT] + "…")
    value = None if detail["type"] == "missing" or isinstance(given, dict | list) else given
    return Issue(where, _plain(detail, problem), value)


_PLAIN = {
    "greater_than": "needs a value > {gt}",
    "greater_than_equal": "needs a value >= {ge}",
    "less_than": "needs a value < {lt}",
    "less_than_equal": "needs a value <= {le}",
    "finite_number": "needs a finite number, not NaN or infinity",
    "missing": "is required",
    "too_short": "needs at least {min_length} item(s)",
    "too_long": "takes at most {max_length} item(s)",
    "string_too_short": "needs at least {min_length} character(s)",
    "string_too_long": "takes at most {max_length} characters",
    "union_tag_invalid": "{discriminator} needs to be one of {expected_tags}, not '{tag}'",
    "union_tag_not_found": "needs the field {discriminator}",
    "extra_forbidden": "is not a field of this part",
    "float_type": "needs a number",
    "float_parsing": "needs a number",
    "int_type": "needs a whole number",
    "int_parsing": "needs a whole number",
    "int_from_float": "needs a whole number",
}


def _plain(detail: Any, problem: str) -> str:
    template = _PLAIN.get(detail["type"])
    bounds = {name: f"{bound:g}" if isinstance(bound, float) else bound for name, bound in detail.get("ctx", {}).items()}
    return template.format(**bounds) if template else problem[:1].lower() + problem[1:]
