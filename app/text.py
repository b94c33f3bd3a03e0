"""Text that every database, file and page can store."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field, StringConstraints

from app.access import stored_name
from rths_engine.foundation.errors import Issue, PlanError

_UNSTORABLE = re.compile("[\x00\ud800-\udfff]")
_PROBLEM = "has a character that can't be stored (NUL or half of a surrogate pair)"


def storable(text: str) -> str:
    """The text. Raises ValueError where it has a character that cannot be stored."""
    if _UNSTORABLE.search(text):
        raise ValueError(_PROBLEM)
    return text


Storable = Annotated[str, AfterValidator(storable)]
PersonName = Annotated[Storable, Field(max_length=80, validate_default=True), AfterValidator(stored_name)]
"""The name of who makes a request: as typed, or the account's whatever was typed."""
Named = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1), AfterValidator(storable)]
"""Text without the spaces around it, which is not blank."""


def integer(value: Any) -> Any:
    """1.0 as 1: JSON Schema takes both for an integer."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


Integer = Annotated[int, Field(strict=True), BeforeValidator(integer)]
"""A whole number of a JSON body; texts and truth values are refused."""


def cleaned(data: Any) -> Any:
    """JSON data of which every text can be stored: characters that cannot be stored become U+FFFD."""
    if isinstance(data, str):
        return _UNSTORABLE.sub("\N{REPLACEMENT CHARACTER}", data)
    if isinstance(data, dict):
        return {cleaned(key): cleaned(value) for key, value in data.items()}
    return [cleaned(one) for one in data] if isinstance(data, list | tuple) else data


def refuse_unstorable(data: Any) -> None:
    """Raise PlanError with an issue for every text in `data`, keys included, that can't be stored."""
    issues = tuple(_issues(data))
    if issues:
        raise PlanError(issues)


def _issues(data: Any) -> Iterator[Issue]:
    left: list[tuple[str, Any]] = [("", data)]
    while left:
        where, value = left.pop()
        if isinstance(value, str):
            if _UNSTORABLE.search(value):
                yield Issue(where, _PROBLEM, value, "remove the character")
        elif isinstance(value, dict):
            for key, inner in value.items():
                path = f"{where}.{key}" if where else str(key)
                left += [(path, inner), (path, key)]
        elif isinstance(value, list):
            left += [(f"{where}.{index}" if where else str(index), inner) for index, inner in _nested(value)]


def _nested(items: list[Any]) -> Iterator[tuple[int, Any]]:
    """The items that can hold text: no numbers, so that the samples of a record are skipped."""
    return ((index, item) for index, item in enumerate(items) if isinstance(item, str | dict | list))
