"""The law of the remaining residual: at most three terms of a general law, each confirmed by held-out data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rths_engine.diagnosis.components.component import Feature
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.free import moved
from rths_engine.diagnosis.gain import Scale, gain
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.diagnosis.signatures import absorber
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
MOST_TERMS = 3
LEAST_SHARE = 0.05  # of the power that the general law explains, and of the held-out error: the least gain of one more term
TRIES = 6  # terms that held-out data may refuse before the search ends
CERTAIN = 2.0  # standard deviations of the noise's power: a smaller held-out error may be noise


@dataclass(frozen=True)
class Term:
    """A term of the law: its coefficient in SI units of the force, its formula, and the sizes that scale the formula."""

    coefficient: float
    formula: str
    words: str
    place: str
    sizes: Any


@dataclass(frozen=True)
class Law:
    """The terms of the law.

    `share` is the share of the general law's power on the fitted data that they explain; `held_out_share` is the share of the
    held-out squared error beyond the noise that they explain.
    """

    terms: tuple[Term, ...]
    share: float
    held_out_share: float

    @property
    def words(self) -> str:
        return "; ".join(one.words for one in self.terms)


def law(recordings: Recordings, fitted: Fitted, heldout: Sequence[Any] = ()) -> Law | None:
    """The law of the residual beside a fitted model; None where held-out data confirm no term.

    Orthogonal least squares proposes one term after another: the term that explains most of the fitted residual without the
    part that the fitted parameters absorb. A term stays where its held-out gain is clearly above zero and at least LEAST_SHARE
    of the held-out error beyond the noise; the fitted parameters move with it. `heldout` are the data of held-out recordings;
    without them, the held-out blocks of the fitted recordings are used.

    Source: Chen, Billings and Luo (1989), Int. J. Control 50, 1873-1896.
    """
    absorbed = absorber(fitted.jacobian)
    first = recordings.data[0]
    terms = [recordings.component.features(fitted.parts, one, first) for one in recordings.data]
    offers = []
    for same in zip(*terms, strict=True):
        change = recordings.joined([term.response for term in same])
        change = np.concatenate([change, np.zeros(len(absorbed) - len(change))])
        left = change - absorbed @ (absorbed.T @ change)
        if np.linalg.norm(left) > 1e-6 * max(1e-300, float(np.linalg.norm(change))):
            offers.append((same[0], change, left))
    misfit = fitted.misfit - absorbed @ (absorbed.T @ fitted.misfit)
    if not offers:
        return None
    table = np.array([left for _, _, left in offers]).T
    whole = _explained(table, misfit)
    proof = _Proof.of(recordings, fitted, heldout, terms)
    if whole <= 0 or not proof.clear:
        return None
    chosen: list[int] = []
    refused: list[int] = []
    reached, rows, found = 0.0, proof.before, None
    while len(chosen) < MOST_TERMS and len(refused) < TRIES:
        rest = [k for k in range(table.shape[1]) if k not in chosen and k not in refused]
        spans = [_explained(table[:, [*chosen, k]], misfit) for k in rest]
        if not rest or max(spans) - reached < LEAST_SHARE * whole:
            break
        best = rest[int(np.argmax(spans))]
        tried = [offers[k][:2] for k in (*chosen, best)]
        weights, after = proof.after(tried)
        if not proof.better(rows, after):
            refused.append(best)
            continue
        chosen.append(best)
        reached, rows = max(spans), after
        named = tuple(_term(one, weight) for (one, _), weight in zip(tried, weights, strict=True))
        found = Law(named, min(1.0, reached / whole), min(1.0, proof.share(after)))
    return found


def _term(one: Feature, weight: float) -> Term:
    return Term(float(weight) * one.unit, one.formula, one.words, one.place, one.sizes)


def _name(one: Feature) -> tuple[str, str]:
    return one.formula, one.place


def _explained(columns: Array, misfit: Array) -> float:
    return float(np.sum((absorber(columns).T @ misfit) ** 2))


@dataclass(frozen=True)
class _Proof:
    """The held-out data of a law, their residuals beside the fitted model, and the response to each term by its name."""

    held: HeldOut
    fitted: Fitted
    before: list[Array]
    responses: list[dict[tuple[str, str], Array]]

    @classmethod
    def of(cls, recordings: Recordings, fitted: Fitted, heldout: Sequence[Any], terms: list[list[Feature]]) -> _Proof:
        held, first = HeldOut.of(recordings, heldout).suited(fitted.parts), recordings.data[0]
        if heldout:
            terms = [recordings.component.features(fitted.parts, one, first) for one in heldout]
        responses = [{_name(term): term.response for term in row} for row in terms]
        return cls(held, fitted, held.residuals(fitted.parts), responses)

    @property
    def clear(self) -> bool:
        """True where the held-out error is above the noise by more than the scatter of the noise's power."""
        scatter = np.sqrt(2 * self.held.memory(self.held.whitened(self.before)) / max(1, self.held.samples))
        return self.beyond > CERTAIN * float(scatter) * self.held.noise

    @property
    def beyond(self) -> float:
        return self.held.error(self.before) - self.held.noise

    def share(self, after: list[Array]) -> float:
        """Share of the held-out squared error beyond the noise that a law explains."""
        return (self.held.error(self.before) - self.held.error(after)) / self.beyond

    def after(self, terms: Sequence[tuple[Feature, Array]]) -> tuple[Array, list[Array]]:
        """The coefficients of the terms, fitted together with the free parameters, and the held-out residuals with them."""
        free = self.fitted.free
        columns = np.column_stack([-self.fitted.jacobian, *(change for _, change in terms)])
        size = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
        solved = np.linalg.lstsq(columns / size, self.fitted.misfit, rcond=1e-9)[0] / size
        steps, weights = np.split(solved, [len(free)])
        parts = moved(self.fitted.parts, free, self.fitted.z + steps)
        found = []
        pairs = zip(self.held.residuals(parts), self.held.masks, self.responses, strict=True)
        for residual, mask, responses in pairs:
            law = sum(weight * responses[_name(one)] for weight, (one, _) in zip(weights, terms, strict=True))
            found.append(self.held.about_zero(residual - law, mask))
        return weights, found

    def better(self, before: list[Array], after: list[Array]) -> bool:
        """True where the residuals `after` are clearly smaller than those `before`."""
        if self.share(after) - self.share(before) < LEAST_SHARE:
            return False
        white, without = self.held.whitened(after), self.held.whitened(before)
        scale = Scale.of(self.held, white)
        return gain(scale, white, without, self.held.blocks(scale.memory), self.held.other_motion).clear
