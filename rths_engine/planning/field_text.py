"""The value of a declared field as text, in the unit that people read."""

from __future__ import annotations

from typing import Any

from pydantic.fields import FieldInfo

LISTED = 12  # a longer list is shown as its number of values; chosen, see docs/decisions/0023
DIGITS = 6  # significant digits; chosen, see docs/decisions/0023


def declared(info: FieldInfo) -> dict[str, Any]:
    """Unit, factor and titles of a field."""
    return info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}


def written(value: Any, info: FieldInfo, digits: int = DIGITS) -> str:
    """The text of a field's value in the shown unit, with `digits` significant digits."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple | list):
        return ", ".join(written(item, info, digits) for item in value) if len(value) <= LISTED else f"{len(value)} values"
    if isinstance(value, float):
        return f"{value / declared(info).get('factor', 1.0):.{digits}g}".replace("-", "−")
    return str(declared(info).get("titles", {}).get(value, value))
