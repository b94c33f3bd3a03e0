"""The proof of each claim: what held-out data lose where one effect alone is left out and everything else is refitted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rths_engine.diagnosis.calibration import Facts, probability
from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.doubts import Rejected, claimed, doubtful, seen_by, unconfirmed
from rths_engine.diagnosis.evidence import MATERIAL
from rths_engine.diagnosis.flexible import flexible
from rths_engine.diagnosis.gain import Gain, Scale
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.diagnosis.proof import Proof, effects_of, planned_parts
from rths_engine.diagnosis.select import Selection, chosen_instead, examined, excluding, ranked, reduced
from rths_engine.diagnosis.stacking import stacked
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect

# chosen; see docs/decisions/0023
HALF = 0.5  # share of the held-out error beyond the noise: where more remains, an effect is at most a part of the mismatch
SURE = 2.0  # standard deviations of what a general law explains of noise
CERTAIN = 2.0  # standard deviations of the noise's power: a smaller remainder may be noise
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
        """The same claims as a part of the mismatch: a general law explains much of what they leave, or none is probable."""
        facts = [replace(claim.facts, part_of_it=True) for claim in self.claims]
        pairs = zip(self.claims, facts, strict=True)
        found = tuple(replace(claim, facts=one, probability=probability(one)) for claim, one in pairs)
        return replace(self, claims=found, part_of_it=True)


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
        proof = Proof.of(selection, held)
        gains = {key(one): proof.gain(selection, one) for one in effects_of(selection)}
        doubt = doubtful(selection, proof, gains)
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


def _claims(selection: Selection, proof: Proof, gains: dict[Any, Gain], rejected: Sequence[Rejected]) -> Claims:
    held = proof.heldout
    planned, chosen, noise = held.error(proof.planned), held.error(proof.chosen), held.noise
    sure = noise * (1 + CERTAIN * float(np.sqrt(2 * proof.scale.memory / max(1, held.samples))))
    beyond = planned - noise
    remaining = max(0.0, chosen - noise) / beyond if planned > sure else None
    part_of_it = remaining is not None and (chosen - sure) / beyond > HALF
    shares = {
        key(one): None if remaining is None else min(1.0, max(0.0, (held.error(proof.without[key(one)]) - chosen) / beyond))
        for one in claimed(selection)
    }
    claims = [one for one in claimed(selection) if gains[key(one)].clear or (shares[key(one)] or 0.0) > MATERIAL]
    rest = [unconfirmed(one, gains[key(one)]) for one in claimed(selection) if all(one is not claim for claim in claims)]
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
            doubted=not own.clear or bool(physics.SEARCHES[type(one)].caution(seen_by(selection, one))),
        )
        found.append(Claim(one, own, share, float(np.sqrt(without)), facts, probability(facts)))
    whole = Claims(
        selection,
        tuple(found),
        (*rejected, *rest),
        remaining,
        part_of_it,
        replicated,
        held.other_motion,
        planned > sure,
        (float(np.sqrt(planned)), float(np.sqrt(chosen))),
    )
    unlikely = found and max(one.probability for one in found) < HALF
    return whole.as_part() if unlikely else whole


def _mass(selection: Selection, proof: Proof) -> tuple[dict[Any, float], float]:
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
    last, planned = selection.detections[-1], selection.recordings.misfit(planned_parts(selection))
    explained = float(planned @ planned) - selection.chosen.squared
    sure = last.explained - last.expected - SURE * float(np.sqrt(2 * last.expected))
    return max(0.0, sure) / max(explained, 1e-300)


def evidence_of(selection: Selection, effect: Effect) -> float:
    """Probability of an effect by the evidence of the library's models: the sum over the models that contain it."""
    base = len(selection.recordings.component.base)
    pairs = zip(selection.chances, selection.tried, strict=True)
    return min(1.0, sum(chance for chance, model in pairs if any(key(part) == key(effect) for part in model.parts[base:])))
