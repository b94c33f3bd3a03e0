"""A left-out effect: a part nested in a component of the plan. At its neutral values it changes nothing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts.structures.assembled import Assembled

# where an effect acts: in the loop, or before it on a part, on the structure's matrices or on the ground motion
COMMAND, PISTON, INPUT, SERIES, FORCE, HEAT, X_SENSOR, F_SENSOR, STOREY, PART, MATRICES, GROUND = range(12)


class Effect(Part):
    """A left-out effect: a part nested in a component of the plan. At its neutral values it changes nothing.

    `step(p, s, y, x, v, w, t, dt) -> y` replaces the signal y at the effect's `hook`:

    COMMAND   y compensated command, x and v of the piston at the last substep, w force on it
    PISTON    y piston displacement, x and v of the command it follows, w force on it
    INPUT     y displacement that reaches the specimen, x and v of the piston, w force of the specimen at the last substep
    SERIES    y flexibility (m/N) before the specimen, which the loop solves with it
    FORCE     y force of the specimen, x and v of the specimen's end after INPUT, w current (1 where the current is not known)
    HEAT      y, x and v as for FORCE, whose effects act before; w temperature (K) of the specimen
    X_SENSOR  y displacement reading; F_SENSOR  y force reading; x and v of the piston, w the true value
    STOREY    y force against the drift of a storey, 0 on entry; x and v of the drift, w elastic force of the storey

    t is the time (s) of the substep and dt (s) its length. With the `neutral` values `step` returns y, except for rounding.
    Effects without a step act before the run: PART by `amended`, MATRICES by `assembled`, GROUND by `shaken`.
    """

    hook: ClassVar[int]
    neutral: ClassVar[Mapping[str, float]]

    @property
    def id(self) -> str:
        """The name of the effect in plans and diagnoses, unique within a component."""
        return str(type(self).model_fields["kind"].default)

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
    """The component's part after all its PART effects."""
    for effect in effects:
        if effect.hook == PART:
            part = effect.amended(part)
    return part
