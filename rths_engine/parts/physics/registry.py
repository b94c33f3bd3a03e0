"""What follows from a component's list of searches: its laws in the order of their codes, and their union for plans."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from operator import or_
from typing import Annotated, Any

from pydantic import Field

from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Search


def laws(searches: Sequence[Search[Any]]) -> tuple[type[Effect], ...]:
    """The laws of the effects that the searches look for, in their order."""
    return tuple(search.effect for search in searches)


def union(kinds: Sequence[type[Effect]]) -> Any:
    """The type of a plan's field: told apart by `kind`, and effects of one kind by `channel`."""
    alike: dict[str, list[type[Effect]]] = {}
    for kind in kinds:
        alike.setdefault(kind.model_fields["kind"].default, []).append(kind)
    return _told_apart("kind", [_told_apart("channel", same) for same in alike.values()])


def _told_apart(field: str, kinds: Sequence[Any]) -> Any:
    return kinds[0] if len(kinds) == 1 else Annotated[reduce(or_, kinds), Field(discriminator=field)]
