"""Where in the input a pydantic error is: its location without the labels that pydantic adds for the choice of a union."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel


def path(location: Sequence[int | str], kind: Any) -> list[int | str]:
    """The keys and indices that lead into the input, from pydantic's `location` of an error in a value of the type `kind`.

    At a union, pydantic inserts the label of the chosen type after the key: `motion, record, scale, pga, pga` for
    `motion.scale.pga`. A label can equal a key, so the type decides which is which, not the input. Where the type is `Any`,
    the rest of the location is taken as keys.
    """
    found: list[int | str] = []
    kinds = choices(kind)
    for step in location:
        if len(kinds) > 1:
            kinds = _chosen(kinds, step)
            continue
        found.append(step)
        kinds = choices(inside(kinds[0], step))
    return found


def dotted(location: Sequence[int | str], kind: Any) -> str:
    """The path as text, `motion.scale.pga`: the name of a field in errors."""
    return ".".join(str(step) for step in path(location, kind))


def choices(kind: Any) -> list[Any]:
    """The types that a union allows, without None. A type that is not a union is its only choice."""
    while get_origin(kind) is Annotated:
        kind = get_args(kind)[0]
    if get_origin(kind) in (Union, UnionType):
        return [one for one in get_args(kind) if one is not NoneType]
    return [kind]


def _chosen(kinds: list[Any], label: int | str) -> list[Any]:
    """The types that remain after the label of a choice: those whose discriminating field has the label as its value."""
    return next((choices(one) for one in kinds if any(label in values for values in _constants(one))), [Any])


def _constants(kind: Any) -> Iterator[tuple[Any, ...]]:
    """The values of each field that has one constant value, such as a part's `kind`."""
    for one in choices(kind):
        if isinstance(one, type) and issubclass(one, BaseModel):
            for field in one.model_fields.values():
                if get_origin(field.annotation) is Literal and len(get_args(field.annotation)) == 1:
                    yield get_args(field.annotation)
        elif one is not kind:
            yield from _constants(one)


def inside(kind: Any, step: int | str) -> Any:
    """The type of a model's field or of a sequence's item."""
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        fields = kind.model_fields.items()
        return next((field.annotation for name, field in fields if step in (name, field.alias)), Any)
    if isinstance(step, int):
        return next(iter(get_args(kind)), Any)
    return Any
