"""The proof of each claim: what held-out data lose where one effect alone is left out and everything else is refitted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np

from rths_engine.diagnosis.calibration import Facts, probability
from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.components.specimen import ClockSkew
from rths_engine.diagnosis.evidence import MATERIAL
from rths_engine.diagnosis.flexible import flexible
from rths_engine.diagnosis.gain import Blocks, Gain, Scale, gain
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.diagnosis.select import Selection, chosen_instead, examined, excluding, ranked, reduced
from rths_engine.diagnosis.stacking import stacked
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.offset import ForceOffset
from rths_engine.parts.physics.sensor.time_skew import ForceTimeSkew

# chosen; see docs/decisions/0023
HALF = 0.5  # share of the held-out error beyond the noise: where more remains, an effect is at most a part of the mismatch
SURE = 2.0  # standard deviations of what a general law explains of noise
CERTAIN = 2.0  # standard deviations of the noise's power: a smaller remainder may be noise
ZERO = 0.02  # of the largest force: a larger offset is more than a load cell's zero
LAG = 1e-3  # s: a larger time skew is more than the lag between the channels of one recorder
AGAINST = -0.9  # correlation of effects that cancel one another
NOTHING = 0.02  # of the far end of an interval: a near end within it is zero
NUISANCES = (ForceOffset, ForceTimeSkew)  # free in every comparison: proved with the comparison's own zero and lag as they are
RIVALS = 8  # models whose held-out scores share the mass


@dataclass(frozen=True)
class Claim:
    """A named effect with its proof: its gain, the share of the error that it explains, and its probability."""

    effect: Effect
    gain: Gain
    share: float | None
    error_without: float  # held-out NRMSE
    facts: Facts
    probability: float


@dataclass(frozen=True)
class Rejected:
    """An effect of the selected model that is not named, with the reason."""

    effect: Effect
    reason: str
    contradicted: str | None
    gain: Gain | None


@dataclass(frozen=True)
class Claims:
    """The selection without the rejected effects, the named effects with their proof, and what remains after them."""

    selection: Selection
    claims: tuple[Claim, ...]
    rejected: tuple[Rejected, ...]
    remaining: float | None  # share of the held-out error beyond the noise; None where the planned model leaves none
    part_of_it: bool
    replicated: bool
    other_motion: bool
    clear: bool  # True where the planned model leaves a held-out error clearly beyond the noise
    errors: tuple[float, float]  # held-out NRMSE of the planned and the extended model

    @property
    def undecided(self) -> bool:
        """True where held-out data speak for an effect, but not clearly."""
        return any(one.gain is not None and one.gain.mean > 0 and one.contradicted is None for one in self.rejected)

    def as_part(self) -> Claims:
        """The same claims as a part of the mismatch: a general law explains much of what they leave."""
        facts = [replace(claim.facts, part_of_it=True) for claim in self.claims]
        pairs = zip(self.claims, facts, strict=True)
        found = tuple(replace(claim, facts=one, probability=probability(one)) for claim, one in pairs)
        return replace(self, claims=found, part_of_it=True)


@dataclass(frozen=True)
class _Proof:
    """Held-out residuals of the selected model, of the planned parts, of the model without each effect, and of rivals."""

    heldout: HeldOut
    blocks: Blocks
    scale: Scale
    chosen: list[Array]
    planned: list[Array]
    without: dict[Any, list[Array]]

    @classmethod
    def of(cls, selection: Selection, held: HeldOut) -> _Proof:
        chosen = held.residuals(selection.chosen.parts)
        scale = Scale.of(held, held.whitened(chosen))
        without = {key(one): held.residuals(_without(selection, one)) for one in _effects(selection)}
        planned = held.residuals(_planned(selection))
        return cls(held, held.blocks(scale.memory), scale, chosen, planned, without)

    def gain(self, selection: Selection, effect: Effect) -> Gain:
        """The gain of an effect on the held-out data, or on all data where the held-out data alone cannot test it."""
        held = replace(self.heldout, zeros_free=False) if isinstance(effect, NUISANCES) else self.heldout
        rest = _without(selection, effect)
        found = self._gain(selection.chosen.parts, rest, held)
        if found.tested:
            return found
        return self._gain(selection.chosen.parts, rest, held.with_fitted())

    def _gain(self, parts: Sequence[Part], rest: Sequence[Part], held: HeldOut) -> Gain:
        white, without = held.whitened(held.residuals(parts)), held.whitened(held.residuals(rest))
        scale = Scale.of(held, white)
        along = held.memory(white, [one - other for one, other in zip(without, white, strict=True)])
        return gain(replace(scale, memory=along), white, without, held.blocks(scale.memory), held.other_motion)


def proved(selection: Selection, heldout: Sequence[Any], random: np.random.Generator) -> Claims:
    """Prove every effect of the selected model on held-out data; reject effects that the data do not confirm, one by one.

    The model that evidence and held-out data together prefer is the selected model. After each rejection the rest is
    fitted and proved again. `heldout` are the data of held-out recordings; without them the held-out blocks of the fitted
    recordings are used.
    """
    held = HeldOut.of(selection.recordings, heldout).suited(selection.chosen.parts)
    rejected: list[Rejected] = []
    selection = _preferred(selection, held)
    while True:
        if selection.effects and not selection.ranges:
            selection = examined(selection, random)
        proof = _Proof.of(selection, held)
        gains = {key(one): proof.gain(selection, one) for one in _effects(selection)}
        doubt = _doubtful(selection, proof, gains)
        if doubt is None:
            return _claims(selection, proof, gains, rejected)
        rejected.append(doubt)
        if doubt.contradicted is None:
            selection = chosen_instead(selection, reduced(selection, doubt.effect))
        else:
            selection = excluding(selection, doubt.effect)


def _preferred(selection: Selection, held: HeldOut) -> Selection:
    """The selection with the models ranked by the posterior: their evidence times their held-out score.

    Evidence comes from the fitted data and the score from others, so the product counts no data twice.
    """
    scale = Scale.of(held, held.whitened(held.residuals(selection.chosen.parts)))
    blocks, count = held.blocks(scale.memory), 1 + RIVALS
    if not blocks or len(selection.tried) == 1:
        return selection
    rows = [held.whitened(held.residuals(one.parts)) for one in selection.tried[:count]]
    before = np.maximum(np.array(selection.chances[:count]), 1e-12)
    after = stacked(np.array([scale.scores(one, blocks) for one in rows]).T + np.log(before) / len(blocks))
    return ranked(selection, [*(sum(selection.chances[:count]) * after), *selection.chances[count:]])


def _without(selection: Selection, effect: Effect) -> Sequence[Part]:
    """The selected model without an effect, everything else refitted; nuisances could take the place of a nuisance and stay."""
    if isinstance(effect, NUISANCES):
        return [one for one in selection.chosen.parts if one is not effect]
    return reduced(selection, effect).parts


def _planned(selection: Selection) -> Sequence[Part]:
    """The refitted planned parts; those of the selected model where all its effects are nuisances."""
    effects = _effects(selection)
    if effects and all(isinstance(one, NUISANCES) for one in effects):
        return selection.chosen.parts[: len(selection.recordings.component.base)]
    return selection.baseline.parts


def _doubtful(selection: Selection, proof: _Proof, gains: dict[Any, Gain]) -> Rejected | None:
    """The effect to leave out next, or None where the data speak against none."""
    data = selection.recordings.data[0]
    for one in _effects(selection):
        against = physics.SEARCHES[type(one)].contradicted(one, _seen(selection, one), data.measured, data.step)
        if against:
            return Rejected(one, f"The recording contradicts this effect: {against}.", against, gains[key(one)])
    claims = _named(selection)
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


def _unconfirmed(one: Effect, own: Gain) -> Rejected:
    """An effect that stays in the model, because it was fitted with the others, and is not named."""
    return Rejected(one, "Its own gain on held-out data is not clearly above zero. It stays in the extended model.", None, own)


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


def _claims(selection: Selection, proof: _Proof, gains: dict[Any, Gain], rejected: Sequence[Rejected]) -> Claims:
    held = proof.heldout
    planned, chosen, noise = held.error(proof.planned), held.error(proof.chosen), held.noise
    sure = noise * (1 + CERTAIN * float(np.sqrt(2 * proof.scale.memory / max(1, held.samples))))
    beyond = planned - noise
    remaining = max(0.0, chosen - noise) / beyond if planned > sure else None
    part_of_it = remaining is not None and (chosen - sure) / beyond > HALF
    shares = {
        key(one): None if remaining is None else min(1.0, max(0.0, (held.error(proof.without[key(one)]) - chosen) / beyond))
        for one in _named(selection)
    }
    claims = [one for one in _named(selection) if gains[key(one)].clear or (shares[key(one)] or 0.0) > MATERIAL]
    unconfirmed = [_unconfirmed(one, gains[key(one)]) for one in _named(selection) if all(one is not claim for claim in claims)]
    named = [gains[key(one)] for one in claims]
    replicated = bool(claims) and all(one.replicated for one in named)
    mass, free = _mass(selection, proof) if claims else ({}, 0.0)
    found = []
    for one in claims:
        without, own, share = held.error(proof.without[key(one)]), gains[key(one)], shares[key(one)]
        facts = Facts(
            mass=mass[key(one)],
            evidence=evidence_of(selection, one),
            certainty=own.mean / max(own.error, 1e-300),
            remaining=0.0 if remaining is None else remaining,
            flexible=free,
            unexplained=_unexplained(selection),
            share=1.0 if share is None else share,
            other_motion=own.other_motion,
            replicated=replicated,
            part_of_it=part_of_it,
            doubted=not own.clear or bool(physics.SEARCHES[type(one)].caution(_seen(selection, one))),
        )
        found.append(Claim(one, own, share, float(np.sqrt(without)), facts, probability(facts)))
    if found and not part_of_it and max(one.probability for one in found) < HALF:
        part_of_it = True
        found = [replace(one, facts=replace(one.facts, part_of_it=True)) for one in found]
    return Claims(
        selection,
        tuple(found),
        (*rejected, *unconfirmed),
        remaining,
        part_of_it,
        replicated,
        held.other_motion,
        planned > sure,
        (float(np.sqrt(planned)), float(np.sqrt(chosen))),
    )


def _seen(selection: Selection, effect: Effect) -> Seen:
    seen = selection.recordings.component.seen(selection.recordings.data[0])
    return seen[getattr(effect, "storey", 1) - 1]


def _effects(selection: Selection) -> list[Effect]:
    return [one for one in selection.effects if isinstance(one, Effect)]


def _named(selection: Selection) -> list[Effect]:
    """The effects that are claims.

    The zero of a load cell and the lag of its channel are fitted freely. Each is a claim where it is the only effect, or more
    than a zero or a lag can be.
    """
    effects = _effects(selection)
    largest = max(float(np.max(np.abs(one.measured))) for one in selection.recordings.data)
    lag = sum(one.delay for one in selection.chosen.parts if isinstance(one, ClockSkew))

    def claimed(one: Effect) -> bool:
        alone = len(effects) == 1
        if isinstance(one, ForceOffset):
            return alone or abs(one.error) > ZERO * largest
        if isinstance(one, ForceTimeSkew):  # the comparison's own lag can cancel it
            return abs(one.delay + lag) > (HALF * abs(one.delay) if alone else LAG)
        return True

    return [one for one in effects if claimed(one)]


def _mass(selection: Selection, proof: _Proof) -> tuple[dict[Any, float], float]:
    """Share of the stacked weight of the models that contain each effect, and the held-out advantage of the flexible law.

    The models are the selected model, the model without each effect, the best rivals, the planned parts and the flexible law.
    """
    held, base = proof.heldout, len(selection.recordings.component.base)
    effects = {key(one) for one in selection.effects}
    models = [(effects, proof.chosen), *((effects - {one}, rows) for one, rows in proof.without.items())]
    for rival in selection.tried[:RIVALS]:
        kind = {key(part) for part in rival.parts[base:]}
        if all(kind != known for known, _ in models):
            models.append((kind, held.residuals(rival.parts)))
    models += [(set(), proof.planned), (set(), flexible(selection.recordings, held, selection.baseline.parts))]
    scores = np.array([proof.scale.scores(held.whitened(rows), proof.blocks) for _, rows in models]).T
    weights = stacked(scores[:, :-1])
    mass = {
        one: float(sum(weight for weight, (kind, _) in zip(weights, models[:-1], strict=True) if one in kind))
        for one in effects
    }
    sums = scores.sum(axis=0)
    return mass, float((sums[-1] - sums[0]) / max(abs(sums[-2] - sums[0]), 1e-300))


def _unexplained(selection: Selection) -> float:
    """The chi^2 that a general law explains for sure after the effects, over the chi^2 that the effects explain.

    Of what the law explains, the mean and SURE standard deviations of what it explains of noise are subtracted. The length of
    noise along r columns has the mean r and the variance 2 r.
    """
    last, planned = selection.detections[-1], selection.recordings.misfit(_planned(selection))
    explained = float(planned @ planned) - selection.chosen.squared
    sure = last.explained - last.expected - SURE * float(np.sqrt(2 * last.expected))
    return max(0.0, sure) / max(explained, 1e-300)


def evidence_of(selection: Selection, effect: Effect) -> float:
    """Probability of an effect by the evidence of the library's models: the sum over the models that contain it."""
    base = len(selection.recordings.component.base)
    pairs = zip(selection.chances, selection.tried, strict=True)
    return min(1.0, sum(chance for chance, model in pairs if any(key(part) == key(effect) for part in model.parts[base:])))


def _name(effect: Effect) -> str:
    return effect.id.replace("_", " ")
