"""The fields of a part as rows: key, meaning, unit, and the values that it accepts."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel

from app.documents.markdown import code
from rths_engine.foundation.units import pretty

HEADS = ("field", "meaning", "SI unit", "shown in", "values (SI)", "default (SI)")
WORDS = {"number": "number", "integer": "whole number", "string": "text", "boolean": "true or false", "object": "object"}
EQUATION = re.compile(r" (=|<=) ")
MOST_SHOWN = 60  # characters of a default
Row = tuple[str, str, str, str, str, str]


def equation(kind: type[BaseModel]) -> str:
    """The equation with which the docstring opens, as code; empty where it states none."""
    summary, _, rest = (kind.__doc__ or "").partition("\n\n")
    if EQUATION.search(summary):
        words, _, after = summary.partition(": ")
        first = summary if EQUATION.search(words) else after
    else:
        first = rest.partition("\n\n")[0]
    return code(" ".join(first.split()).removesuffix("."))


def name(kind: type[BaseModel]) -> str:
    """The `kind` of a part in plans."""
    return str(kind.model_fields["kind"].default)


def rows(kind: type[BaseModel], above: str = "") -> Iterator[Row]:
    """A row for each field whose value is free (`kind` is not); the fields of nested values follow theirs."""
    schema = kind.model_json_schema()
    yield from _rows(schema, schema.get("$defs", {}), above)


def _rows(schema: Mapping[str, Any], known: Mapping[str, Any], above: str) -> Iterator[Row]:
    for key, field in schema["properties"].items():
        if "const" in field:
            continue
        meaning = "; ".join(filter(None, [str(field.get("title", "")), field.get("description", "")]))
        default = _plain(field["default"]) if "default" in field else "required"
        unit, shown = (pretty(str(field.get(one, "1"))) for one in ("unit", "shown"))
        yield code(above + key), meaning, unit, shown, _values(field), default
        inner, ending = field, ""
        while inner.get("type") == "array":
            inner, ending = inner.get("items", {}), ending + "[]"
        if "$ref" in inner:
            yield from _rows(known[inner["$ref"].rsplit("/", 1)[1]], known, f"{above}{key}{ending}.")


def _values(field: Mapping[str, Any]) -> str:
    """What a field accepts: `number, > 0, <= 1e12`."""
    if "enum" in field:
        return " or ".join(code(str(one)) for one in field["enum"])
    if "anyOf" in field:
        return " or ".join(_values(one) for one in field["anyOf"])
    if field.get("type") == "null":
        return "null"
    if field.get("type") == "array":
        return f"list{_count(field)}: {_values(field.get('items', {}))}"
    bounds = [f"{sign} {_plain(field[key])}" for key, sign in SIGNS.items() if key in field]
    return ", ".join([WORDS[str(field.get("type", "object"))], *bounds])


SIGNS = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}


def _count(field: Mapping[str, Any]) -> str:
    least, most = field.get("minItems", 0), field.get("maxItems")
    return f" of {least} to {most}" if most is not None else ""


def _plain(value: Any) -> str:
    short = f"{value:g}" if isinstance(value, float) else ""
    text = short if short and float(short) == value else json.dumps(value, ensure_ascii=False)
    return text if len(text) <= MOST_SHOWN else f"{text[:MOST_SHOWN]}…"
