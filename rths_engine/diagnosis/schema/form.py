"""The base of every object in the JSON of a diagnosis: a frozen object whose fields declare their meaning and their unit."""

from __future__ import annotations

import math
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field

NUMBERS = "1"  # the unit of a number without dimension
AS_STATED = "stated in `unit`"  # the unit of a number whose object has the field `unit`


class Form(BaseModel):
    """A frozen JSON object. Numbers are finite and in SI units; a number that was not computed or is not finite is null."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        serialize_by_alias=True,
        json_schema_serialization_defaults_required=True,
    )

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """JSON Schema (draft 2020-12) of the data that `as_dict` returns."""
        return cls.model_json_schema(mode="serialization")

    @classmethod
    def read(cls, stored: Any) -> Self:
        """The object from its JSON data. Raises pydantic's ValidationError where the data do not match the form."""
        return cls.model_validate(stored)

    def as_dict(self) -> dict[str, Any]:
        """The JSON data of the object, with every field, also where it is null."""
        return self.model_dump(mode="json")


def field(meaning: str, unit: str | None = None, **more: Any) -> Any:
    """Declare a field with its meaning and, for numbers, their SI unit."""
    return Field(description=meaning, json_schema_extra={"unit": unit} if unit else None, **more)


def finite(value: float) -> float | None:
    """The number, or None where it is infinite or not a number."""
    return value if math.isfinite(value) else None
