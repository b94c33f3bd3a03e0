"""What every object of a diagnosis's JSON is: a frozen value whose fields declare their meaning and their unit."""

from __future__ import annotations

import math
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field

NUMBERS = "1"  # unit of a number that has no dimension
AS_STATED = "stated in `unit`"  # of a number whose unit stands beside it


class Form(BaseModel):
    """A frozen object. Numbers are SI and finite; null stands where a number was never computed or is not finite."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        serialize_by_alias=True,
        json_schema_serialization_defaults_required=True,
    )

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """JSON Schema (draft 2020-12) of what `as_dict` gives."""
        return cls.model_json_schema(mode="serialization")

    @classmethod
    def read(cls, stored: Any) -> Self:
        """The object from its JSON data. Raises pydantic's ValidationError where they are of another form."""
        return cls.model_validate(stored)

    def as_dict(self) -> dict[str, Any]:
        """JSON data: every field, null included."""
        return self.model_dump(mode="json")


def field(meaning: str, unit: str | None = None, **more: Any) -> Any:
    """Declare a field by its meaning and, where it holds numbers, their SI unit."""
    return Field(description=meaning, json_schema_extra={"unit": unit} if unit else None, **more)


def finite(value: float) -> float | None:
    """The number, or None where it is infinite or not a number."""
    return value if math.isfinite(value) else None
