"""What each left-out effect, and each term of an unknown law, would do to the residual."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.arrays import Array
from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.parallel import each
from rths_engine.physics.effect import Effect

NOTHING = 1e-9  # of the misfit: a signature so small says nothing


@dataclass(frozen=True)
class Signatures:
    """Unit vectors (K, N), whitened, with what the fitted numbers absorb taken out; `effects` (K) made them."""

    effects: tuple[Effect, ...]
    rows: Array
    two_sided: Array  # (K)

    def scores(self, misfits: Array) -> Array:
        """The part of the misfit (N) or misfits (B, N) along each, standard normal where there is none but noise."""
        along = misfits @ self.rows.T
        found: Array = np.where(self.two_sided, np.abs(along), along)
        return found


def signatures(recordings: Recordings, fitted: Fitted) -> Signatures:
    """Of every effect that the component may leave out, at its guesses, beside the fitted model."""
    component = recordings.component
    present = {key(part) for part in fitted.parts[len(component.base) :]}
    guesses = [guess for guess in component.hypotheses(recordings.data[0]) if key(guess) not in present]
    before = recordings.joined(recordings.predicted(fitted.parts))
    absorbed = absorber(fitted.jacobian)

    def left(guess: Effect) -> Array | None:
        change = recordings.joined(recordings.predicted([*fitted.parts, guess])) - before
        return _beyond(change, absorbed)

    rows = each(left, guesses)
    kept = [(guess, row) for guess, row in zip(guesses, rows, strict=True) if row is not None]
    return Signatures(
        tuple(guess for guess, _ in kept),
        np.array([row for _, row in kept]).reshape(len(kept), -1),
        np.array([_two_sided(guess) for guess, _ in kept], dtype=bool),
    )


def general(recordings: Recordings, fitted: Fitted) -> Array:
    """Orthonormal columns (N, r) of what any law of motion, energy and time could do, beyond what the fitted numbers absorb."""
    return absorber(general_terms(recordings, fitted))


def general_terms(recordings: Recordings, fitted: Fitted) -> Array:
    """Unit columns (N, K), likewise, a term of the law each."""
    absorbed = absorber(fitted.jacobian)
    terms = [recordings.component.features(fitted.parts, one) for one in recordings.data]
    columns = []
    for same in zip(*terms, strict=True):
        column = _beyond(recordings.joined([term.response for term in same]), absorbed)
        if column is not None:
            columns.append(column)
    return np.array(columns).T if columns else np.zeros((len(absorbed), 0))


def absorber(jacobian: Array) -> Array:
    """Orthonormal columns that span the Jacobian's."""
    scale = np.linalg.norm(jacobian, axis=0)
    used = jacobian[:, scale > 0] / scale[scale > 0]
    if not used.shape[1]:
        return np.zeros((len(jacobian), 0))
    left, values, _ = np.linalg.svd(used, full_matrices=False)
    spanned: Array = left[:, values > 1e-6 * values[0]]
    return spanned


def best_first(found: Signatures, scores: Array) -> Sequence[int]:
    """Places of the best signature of each effect, the highest score first."""
    order = np.argsort(-scores)
    seen = set()
    places = []
    for place in order:
        kind = key(found.effects[place])
        if kind not in seen:
            seen.add(kind)
            places.append(int(place))
    return places


def _beyond(change: Array, absorbed: Array) -> Array | None:
    """The change (of the recordings' rows) beyond what is absorbed, of unit length; None where nothing is left."""
    if not np.isfinite(change).all():
        return None
    change = np.concatenate([change, np.zeros(len(absorbed) - len(change))])
    left = change - absorbed @ (absorbed.T @ change)
    size = float(np.linalg.norm(left))
    if size <= NOTHING * max(1.0, float(np.linalg.norm(change))):
        return None
    unit: Array = left / size
    return unit


def _two_sided(effect: Effect) -> bool:
    schema = type(effect).model_json_schema()["properties"]
    return any(schema[name].get("minimum", schema[name].get("exclusiveMinimum", -1.0)) < 0 for name in effect.neutral)
