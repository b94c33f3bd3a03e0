"""What speaks against an effect of the selected model: which effects are left out, and which stay without a name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.components.specimen import ClockSkew
from rths_engine.diagnosis.evidence import MATERIAL
from rths_engine.diagnosis.gain import Gain
from rths_engine.diagnosis.proof import Proof, effects_of
from rths_engine.diagnosis.select import Selection
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.offset import ForceOffset
from rths_engine.parts.physics.sensor.time_skew import ForceTimeSkew

# chosen; see docs/decisions/0023
ZERO = 0.02  # of the largest force: a larger offset is more than a load cell's zero
LAG = 1e-3  # s: a larger time skew is more than the lag between the channels of one recorder
CANCELLED = 0.5  # of a time skew: the least lag that the comparison's own lag must leave of it
AGAINST = -0.9  # correlation of effects that cancel one another
NOTHING = 0.02  # of the far end of an interval: a near end within it is zero


@dataclass(frozen=True)
class Rejected:
    """An effect of the selected model that is not named, with the reason."""

    effect: Effect
    reason: str
    contradicted: str | None
    gain: Gain | None


def doubtful(selection: Selection, proof: Proof, gains: dict[Any, Gain]) -> Rejected | None:
    """The effect to leave out next, or None where the data speak against none."""
    data = selection.recordings.data[0]
    for one in effects_of(selection):
        against = physics.SEARCHES[type(one)].contradicted(one, seen_by(selection, one), data.measured, data.step)
        if against:
            return Rejected(one, f"The recording contradicts this effect: {against}.", against, gains[key(one)])
    claims = claimed(selection)
    cancelling = _cancelling(selection, claims)
    if cancelling:
        one, other = sorted(cancelling, key=lambda effect: gains[key(effect)].mean)
        reason = f"It and {_name(other)} cancel one another: each changes the output more than both together."
        return Rejected(one, reason, None, gains[key(one)])
    worst = min(claims, key=lambda one: gains[key(one)].mean / max(gains[key(one)].error, 1e-300), default=None)
    if worst is not None and gains[key(worst)].mean <= 0:
        return Rejected(worst, "Held-out data are simulated better without it.", None, gains[key(worst)])
    error = proof.heldout.error(proof.chosen)
    for one in claims:
        if proof.heldout.error(proof.without[key(one)]) < (1 - MATERIAL) * error:
            return Rejected(one, "The held-out error is smaller without it.", None, gains[key(one)])
        if _says_nothing(selection, one):
            return Rejected(one, "The 90 % interval of its size includes zero.", None, gains[key(one)])
    return None


def unconfirmed(one: Effect, own: Gain) -> Rejected:
    """An effect that stays in the model, because it was fitted with the others, and is not named."""
    return Rejected(one, "Its own gain on held-out data is not clearly above zero. It stays in the extended model.", None, own)


def claimed(selection: Selection) -> list[Effect]:
    """The effects that are claims.

    The zero of a load cell and the lag of its channel are fitted freely. Each is a claim where it is the only effect, or more
    than a zero or a lag can be.
    """
    effects = effects_of(selection)
    largest = max(float(np.max(np.abs(one.measured))) for one in selection.recordings.data)
    lag = sum(one.delay for one in selection.chosen.parts if isinstance(one, ClockSkew))

    def claimed(one: Effect) -> bool:
        alone = len(effects) == 1
        if isinstance(one, ForceOffset):
            return alone or abs(one.error) > ZERO * largest
        if isinstance(one, ForceTimeSkew):  # the comparison's own lag can cancel it
            return abs(one.delay + lag) > (CANCELLED * abs(one.delay) if alone else LAG)
        return True

    return [one for one in effects if claimed(one)]


def _says_nothing(selection: Selection, effect: Effect) -> bool:
    """True where the interval of the only size of an effect reaches its neutral value, which is zero.

    Two sizes can share one change: each interval then reaches zero where both together do not.
    """
    owner = next(place for place, part in enumerate(selection.chosen.parts) if part is effect)
    pairs = zip(selection.chosen.free, selection.ranges, strict=True)
    ends = [
        (number.from_z(low), number.from_z(high))
        for number, (low, high) in pairs
        if number.owner == owner and effect.neutral.get(number.field) == 0.0
    ]
    return len(ends) == 1 and all(low <= NOTHING * abs(high) and high >= -NOTHING * abs(low) for low, high in ends)


def _cancelling(selection: Selection, effects: Sequence[Effect]) -> tuple[Effect, Effect] | None:
    """Two effects whose changes of the fitted output oppose each other, each larger than their sum."""
    if len(effects) < 2:
        return None
    recordings, parts = selection.recordings, selection.chosen.parts
    whole = recordings.joined(recordings.predicted(parts))
    changes = {}
    for one in effects:
        rest = [part for part in parts if part is not one]
        changes[key(one)] = whole - recordings.joined(recordings.predicted(rest))
    for one, other in combinations(effects, 2):
        first, second = changes[key(one)], changes[key(other)]
        sizes = float(np.linalg.norm(first)), float(np.linalg.norm(second))
        along = float(first @ second) / max(sizes[0] * sizes[1], 1e-300)
        if along < AGAINST and min(sizes) > float(np.linalg.norm(first + second)):
            return one, other
    return None


def seen_by(selection: Selection, effect: Effect) -> Seen:
    """The amplitudes of the first recording that the effect goes through: those of its storey."""
    seen = selection.recordings.component.seen(selection.recordings.data[0])
    return seen[getattr(effect, "storey", 1) - 1]


def _name(effect: Effect) -> str:
    return effect.id.replace("_", " ")
