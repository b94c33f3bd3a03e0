"""How a diagnosis searches for a left-out effect: apart from the law, which knows nothing of it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar

import annotated_types

from rths_engine.parts.physics.effect import Effect

# chosen; see docs/decisions/0023
TINY = 1e-12
UNSURE = 0.5  # of the logarithm of a number
PRESLIDING = 0.02  # of the stroke: friction that builds up over more is rather a hysteresis of its own
E = TypeVar("E", bound=Effect)


class Seen(NamedTuple):
    """Sizes of what a component went through (SI): from them an effect's own are guessed."""

    x: float  # largest displacement
    v: float  # largest velocity
    f: float  # largest force (of a structure: of a storey)
    time: float  # duration
    energy: float  # dissipated, sum of |f v| dt
    dt: float
    storey: int = 1  # of a structure, from 1: x and v are of its drift

    @property
    def stiffness(self) -> float:
        return self.f / max(self.x, TINY)

    @property
    def acceleration(self) -> float:
        """Largest, of a harmonic motion of this displacement and velocity."""
        return self.v * self.v / max(self.x, TINY)


class Search(Generic[E]):
    """How a diagnosis searches for one effect; `effect` is the class of its law.

    `needs` are the roles that have to be recorded, `relatives` the ids of effects that resemble it in a recording. A fit leaves
    the `held` numbers where they are, and `otherwise` says what these may as well be. A sentence of a diagnosis reads:
    "The specimen {says}: {noun} was left out."
    """

    needs: tuple[str, ...]
    relatives: tuple[str, ...] = ()
    held: tuple[str, ...] = ()
    otherwise: ClassVar[Mapping[str, float]] = {}
    noun: str

    def __init__(self, effect: type[E]):
        self.effect = effect

    def guesses(self, seen: Seen) -> Iterator[E]:
        """Values to look for the effect with: a few sizes that would show in such a recording."""
        raise NotImplementedError

    def doubt(self, effect: E, seen: Seen) -> float:
        """-2 ln of the prior odds of such numbers, beside those that are common."""
        return 0.0

    def says(self, effect: E) -> str:
        """What the effect does, with its size and unit: the middle of the sentence of a diagnosis."""
        raise NotImplementedError

    def sized(self, **sizes: float) -> E:
        """The effect with sizes moved into their bounds: a recording may hold anything."""
        fields = self.effect.model_fields
        return self.effect(**{name: _within(size, fields[name].metadata) for name, size in sizes.items()})

    def times(self, effect: E, share: float) -> E:
        """The effect with a share of its size, where that is told from zero."""
        fields, zeros = self.effect.model_fields, [name for name, neutral in effect.neutral.items() if neutral == 0.0]
        return effect.model_copy(update={name: _within(share * getattr(effect, name), fields[name].metadata) for name in zeros})


def beyond(size: float, most: float) -> float:
    """-2 ln of how likely a positive number is beyond `most`: normal in its logarithm, with a deviation of UNSURE."""
    return max(0.0, math.log(max(size, TINY) / max(most, TINY)) / UNSURE) ** 2


def _within(size: float, bounds: Iterable[Any]) -> float:
    for bound in bounds:
        match bound:
            case annotated_types.Gt(gt=low) | annotated_types.Ge(ge=low):
                size = max(size, float(low) + (TINY if isinstance(bound, annotated_types.Gt) else 0.0))  # type: ignore[arg-type]
            case annotated_types.Lt(lt=high) | annotated_types.Le(le=high):
                size = min(size, float(high))  # type: ignore[arg-type]
    return float(size)
