"""What every left-out effect is: a part nested in its component, which vanishes at its neutral values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, Self

import annotated_types

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts.structures.assembled import Assembled

# where an effect acts: in the loop, or before it on a part, on the structure's matrices or on the ground motion
COMMAND, PISTON, INPUT, SERIES, FORCE, X_SENSOR, F_SENSOR, STOREY, PART, MATRICES, GROUND = range(11)
TINY = 1e-12
UNSURE = 0.5  # of the logarithm of a number


class Seen(NamedTuple):
    """Sizes of what a component went through (SI): from them an effect guesses its own."""

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


class Effect(Part):
    """A left-out effect. `step(p, s, y, x, v, w, t, dt) -> y` replaces the signal y at its `hook`:

    COMMAND   y compensated command, x and v of the piston at the last substep, w force on it
    PISTON    y piston displacement, x and v of the command it follows, w force on it
    INPUT     y displacement that reaches the specimen, x and v of the piston, w specimen's force at the last substep
    SERIES    y flexibility (m/N) before the specimen, which the loop solves with it
    FORCE     y specimen's force, x and v of the end that INPUT left, w current (1 where none is known)
    X_SENSOR  y displacement reading; F_SENSOR  y force reading; x and v of the piston, w the true value
    STOREY    y becomes a force against the drift of a storey, from 0; x and v of the drift, w its elastic force

    t time (s) of the substep, dt (s). With the `neutral` values `step` returns y to rounding. Effects without a step change
    something before the run: PART by `amended`, MATRICES by `assembled`, GROUND by `shaken`.
    """

    hook: ClassVar[int]
    neutral: ClassVar[Mapping[str, float]]
    held: ClassVar[tuple[str, ...]] = ()  # numbers that a fit does not move
    otherwise: ClassVar[Mapping[str, float]] = {}  # what held numbers may as well be
    needs: ClassVar[tuple[str, ...]] = ()
    relatives: ClassVar[tuple[str, ...]] = ()
    noun: ClassVar[str]  # "backlash was left out"

    @classmethod
    def guesses(cls, seen: Seen) -> Iterator[Self]:
        """Values to look for the effect with: a few sizes that would show in such a recording."""
        raise NotImplementedError

    @classmethod
    def sized(cls, **sizes: float) -> Self:
        """With sizes moved into their bounds: a recording may hold anything."""
        return cls(**{name: _within(size, cls.model_fields[name].metadata) for name, size in sizes.items()})

    def times(self, share: float) -> Self:
        """With a share of its size, where that is told from zero."""
        bounds = {name: type(self).model_fields[name].metadata for name, neutral in self.neutral.items() if neutral == 0.0}
        return self.model_copy(update={name: _within(share * getattr(self, name), one) for name, one in bounds.items()})

    @property
    def id(self) -> str:
        """Its name in plans and diagnoses, unique within a component."""
        return str(type(self).model_fields["kind"].default)

    def doubt(self, seen: Seen) -> float:
        """-2 ln of how likely such numbers are beforehand, beside those that are common."""
        return 0.0

    def says(self) -> str:
        """What the effect does, with its size and unit: the middle of the sentence of a diagnosis."""
        raise NotImplementedError

    @staticmethod
    def step(p: Any, s: Any, y: float, x: float, v: float, w: float, t: float, dt: float) -> float:
        return y

    def amended(self, part: Part) -> Part:
        """PART: the component's part with the effect in it."""
        raise NotImplementedError

    def assembled(self, built: Assembled) -> Assembled:
        """MATRICES: the structure with the effect in it."""
        raise NotImplementedError

    def shaken(self, ground: Array, dt: float) -> Array:
        """GROUND: the ground acceleration (m/s^2) with the effect in it."""
        raise NotImplementedError


def amended(part: Part, effects: Sequence[Effect]) -> Part:
    """A component's part with what PART effects change of it."""
    for effect in effects:
        if effect.hook == PART:
            part = effect.amended(part)
    return part


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
