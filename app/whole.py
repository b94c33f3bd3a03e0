"""Forms of requests that replace all of something: a field that is left out is refused, and not set to its first value."""

from __future__ import annotations

from copy import copy
from typing import Any

from pydantic import BaseModel
from pydantic_core import PydanticUndefined


class Whole(BaseModel):
    """A form whose every field is required, whatever defaults the form has that it derives from.

    A change of one field by PUT would otherwise undo all others: a rig comes back from retirement, a rule is switched off.
    """

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        for name, field in cls.model_fields.items():
            required = copy(field)
            required.default, required.default_factory = PydanticUndefined, None
            cls.model_fields[name] = required
        cls.model_rebuild(force=True)
