"""What each left-out effect would do to the residual, and which of them the residual holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.arrays import Array
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.physics.effect import Effect

NOTHING = 1e-9  # of the misfit: a signature so small says nothing


@dataclass(frozen=True)
class Signatures:
    """Unit vectors (K, N), whitened, with what the fitted numbers absorb taken out; `effects` (K) made them."""

    effects: tuple[Effect, ...]
    rows: Array
    sizes: Array  # (K) length of each before it was scaled, in standard deviations of the noise
    two_sided: Array  # (K)

    def scores(self, misfits: Array) -> Array:
        """The part of the misfit (N) or misfits (B, N) along each, standard normal where there is none but noise."""
        along = misfits @ self.rows.T
        found: Array = np.where(self.two_sided, np.abs(along), along)
        return found


def signatures(recordings: Recordings, fitted: Fitted) -> Signatures:
    """Of every effect of the component's catalogue at its guesses, beside the fitted model."""
    component = recordings.component
    seen = recordings.data[0].seen()
    present = {type(part) for part in fitted.parts[1:]}
    before = [component.predicted(fitted.parts, one) for one in recordings.data]
    absorbed = absorber(fitted.jacobian)
    effects, rows, sizes, sides = [], [], [], []
    for kind in component.catalogue:
        if kind in present:
            continue
        for guess in kind.guesses(seen):
            after = [component.predicted([*fitted.parts, guess], one) for one in recordings.data]
            change = recordings.joined([new - old for new, old in zip(after, before, strict=True)])
            if not np.isfinite(change).all():
                continue
            left = change - absorbed @ (absorbed.T @ change)
            size = float(np.linalg.norm(left))
            if size <= NOTHING * max(1.0, float(np.linalg.norm(change))):
                continue
            effects.append(guess)
            rows.append(left / size)
            sizes.append(size)
            sides.append(_two_sided(guess))
    return Signatures(tuple(effects), np.array(rows).reshape(len(rows), -1), np.array(sizes), np.array(sides, dtype=bool))


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
    seen: set[type[Effect]] = set()
    places = []
    for place in order:
        kind = type(found.effects[place])
        if kind not in seen:
            seen.add(kind)
            places.append(int(place))
    return places


def _two_sided(effect: Effect) -> bool:
    schema = type(effect).model_json_schema()["properties"]
    return any(schema[name].get("minimum", schema[name].get("exclusiveMinimum", -1.0)) < 0 for name in effect.neutral)
