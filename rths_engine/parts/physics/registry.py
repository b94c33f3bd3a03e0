"""Lists that follow from a component's searches: its laws in the order of their codes, and the union type for plans."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from operator import or_
from typing import Annotated, Any

from pydantic import Field

from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Search


def laws(searches: Sequence[Search[Any]]) -> tuple[type[Effect], ...]:
    """The law of each search, in the order of the searches."""
    return tuple(search.effect for search in searches)


def union(kinds: Sequence[type[Effect]]) -> Any:
    """The type of a plan's field: `kind` selects the class; `channel` selects it among classes of the same kind."""
    alike: dict[str, list[type[Effect]]] = {}
    for kind in kinds:
        alike.setdefault(kind.model_fields["kind"].default, []).append(kind)
    return _discriminated("kind", [_discriminated("channel", same) for same in alike.values()])


def _discriminated(field: str, kinds: Sequence[Any]) -> Any:
    return kinds[0] if len(kinds) == 1 else Annotated[reduce(or_, kinds), Field(discriminator=field)]
