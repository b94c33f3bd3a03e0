"""Tables of the fields in the JSON of a diagnosis."""

from __future__ import annotations

import types
import typing
from collections.abc import Iterator
from typing import Any

from app.documents.markdown import code, table
from app.reports.digits import CHANCES
from rths_engine.diagnosis.schema import Form, Pictures, Verdict

HEADS = ("field", "type", "unit", "meaning")
NAMES = {str: "text", float: "number", int: "integer", bool: "true or false"}
LISTS = {str: "texts", float: "numbers", int: "integers"}
Row = tuple[str, str, str, str]


def verdict_fields() -> str:
    """Every field of `rths-diagnosis/1`."""
    return table(HEADS, _rows(Verdict))


def chances() -> str:
    """The words for probabilities, and the smallest probability of each."""
    return table(("words", "from"), [(words, f"{least:g}") for least, words in CHANCES])


def pictures_fields() -> str:
    """Every field of `rths-diagnosis-pictures/1`."""
    return table(HEADS, _rows(Pictures))


def _rows(form: type[Form], above: str = "") -> Iterator[Row]:
    for name, field in form.model_fields.items():
        extra = field.json_schema_extra
        unit = str(extra.get("unit", "")) if isinstance(extra, dict) else ""
        path = f"{above}{field.alias or name}"
        yield code(path), _type(field.annotation), unit, str(field.description)
        for inner, ending in _inside(field.annotation):
            yield from _rows(inner, f"{path}{ending}.")


def _type(kind: Any) -> str:
    """A type in words: `object or null`, `list of numbers, some null`, `list of [number, number]`."""
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin is types.UnionType:
        return f"{_type(inner[0])} or null"
    if origin is typing.Literal:
        return " or ".join(code(str(value)) for value in inner)
    if origin is tuple:
        return f"list of {_items(inner[0])}" if inner[-1] is Ellipsis else f"[{', '.join(_type(one) for one in inner)}]"
    return NAMES.get(kind, "object")


def _items(kind: Any) -> str:
    """The type of the items of a list, in words."""
    if typing.get_origin(kind) is types.UnionType:
        return f"{_items(typing.get_args(kind)[0])}, some null"
    if typing.get_origin(kind) is tuple:
        return f"lists of {_items(typing.get_args(kind)[0])}" if typing.get_args(kind)[-1] is Ellipsis else _type(kind)
    return LISTS.get(kind, "objects")


def _inside(kind: Any) -> Iterator[tuple[type[Form], str]]:
    """The forms inside a field, each with `[]` if the field is a list."""
    inner = typing.get_args(kind)
    if isinstance(kind, type) and issubclass(kind, Form):
        yield kind, ""
    elif typing.get_origin(kind) is types.UnionType:
        for one in inner:
            yield from _inside(one)
    elif typing.get_origin(kind) is tuple:
        yield from ((form, f"[]{ending}") for form, ending in _inside(inner[0]))
