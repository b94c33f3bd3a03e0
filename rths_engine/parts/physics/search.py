"""How a diagnosis searches for a left-out effect. The law of the effect does not depend on its search."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar

import annotated_types
import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.parts.physics.effect import Effect

# chosen; see docs/decisions/0023
TINY = 1e-12
UNSURE = 0.5  # standard deviation of the logarithm of a number
PRESLIDING = 0.02  # share of the stroke: friction that builds up over a longer displacement is more likely hysteresis
TRENDING = math.log(3.0)  # a displacement that changes threefold over the record
EVENT = 2 * math.log(9.0)  # -2 ln of the prior odds of an event in time beside a law of amplitude or energy, 1:9
E = TypeVar("E", bound=Effect)


class Seen(NamedTuple):
    """Amplitudes that a component went through (SI); the start values of an effect are derived from them."""

    x: float  # largest displacement
    v: float  # largest velocity
    f: float  # largest force (for a structure: of a storey)
    time: float  # duration
    energy: float  # dissipated energy, sum of |f v| dt
    dt: float
    storey: int = 1  # storey of a structure, from 1; x and v are those of its drift
    trend: float = 0.0  # logarithm of the RMS displacement in the last third over that in the first third
    current: float = 1.0  # largest current
    temperature: float = 293.15  # mean temperature (K)

    @property
    def stiffness(self) -> float:
        return self.f / max(self.x, TINY)

    @property
    def acceleration(self) -> float:
        """Largest acceleration of a harmonic motion with this displacement and velocity."""
        return self.v * self.v / max(self.x, TINY)


class Search(Generic[E]):
    """How a diagnosis searches for one effect; `effect` is the class of its law.

    `needs` are the roles that must be recorded. `relatives` are the ids of effects that look similar in a recording. A fit does
    not change the `held` numbers; `otherwise` gives another plausible value for each of them. Where it is `proportional`, the
    change of the signal is proportional to the numbers that `times` scales. A sentence of a diagnosis reads:
    "The specimen {says}: {noun} was left out."
    """

    needs: tuple[str, ...]
    relatives: tuple[str, ...] = ()
    held: tuple[str, ...] = ()
    otherwise: ClassVar[Mapping[str, float]] = {}
    proportional: ClassVar[bool] = False
    noun: str

    def __init__(self, effect: type[E]):
        self.effect = effect

    def guesses(self, seen: Seen) -> Iterator[E]:
        """Start values for the fit of the effect: a few sizes that would be visible in the recording."""
        raise NotImplementedError

    def doubt(self, effect: E, seen: Seen) -> float:
        """-2 ln of the prior odds of these numbers against common ones."""
        return 0.0

    def caution(self, seen: Seen) -> str:
        """A sentence on what the recording confounds with the effect; empty where nothing."""
        return ""

    def contradicted(self, effect: E, seen: Seen, measured: Array, step: float) -> str | None:
        """What in the recording contradicts the fitted effect; None where nothing. `measured` has the shape (channels, n)."""
        return None

    def says(self, effect: E) -> str:
        """What the effect does, with its size and unit: the verb phrase of a diagnosis' sentence."""
        raise NotImplementedError

    def sized(self, **sizes: float) -> E:
        """The effect with `sizes`, each moved into the bounds of its field: a recording can give sizes out of range."""
        fields = self.effect.model_fields
        return self.effect(**{name: _within(size, fields[name].metadata) for name, size in sizes.items()})

    def times(self, effect: E, share: float) -> E:
        """The effect with `share` times those of its numbers whose neutral value is 0."""
        fields, zeros = self.effect.model_fields, [name for name, neutral in effect.neutral.items() if neutral == 0.0]
        return effect.model_copy(update={name: _within(share * getattr(effect, name), fields[name].metadata) for name in zeros})


class EventSearch(Search[E]):
    """Search for an event at one moment. A law of the amplitude changes in time as well where the amplitude falls or grows."""

    def doubt(self, effect: E, seen: Seen) -> float:
        return EVENT * min(1.0, abs(seen.trend) / TRENDING)

    def caution(self, seen: Seen) -> str:
        if abs(seen.trend) < TRENDING:
            return ""
        way = "grows" if seen.trend > 0 else "falls"
        return f"The amplitude {way} over the recording too: a law that depends on the amplitude could leave a similar trace."


def trend(x: Array) -> float:
    """Logarithm of the RMS of a displacement in the last third over that in the first third; 0 where one of them rests."""
    third = max(1, len(x) // 3)
    first, last = (float(np.sqrt(np.mean((part - np.mean(x)) ** 2))) for part in (x[:third], x[-third:]))
    return math.log(last / first) if min(first, last) > TINY else 0.0


def beyond(size: float, most: float) -> float:
    """-2 ln of the relative likelihood of a number above `most`: normal in its logarithm, standard deviation UNSURE."""
    return max(0.0, math.log(max(size, TINY) / max(most, TINY)) / UNSURE) ** 2


def _within(size: float, bounds: Iterable[Any]) -> float:
    for bound in bounds:
        match bound:
            case annotated_types.Gt(gt=low) | annotated_types.Ge(ge=low):
                size = max(size, float(low) + (TINY if isinstance(bound, annotated_types.Gt) else 0.0))  # type: ignore[arg-type]
            case annotated_types.Lt(lt=high) | annotated_types.Le(le=high):
                size = min(size, float(high))  # type: ignore[arg-type]
    return float(size)
