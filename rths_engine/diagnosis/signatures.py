"""Signatures: the change that a left-out effect, or a term of a general law, makes to the output.

A signature does not contain the part that the fitted parameters can absorb.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import qr

from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.parallel import each
from rths_engine.foundation.arrays import Array
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import F_SENSOR, FORCE, X_SENSOR, Effect

# chosen; see docs/decisions/0023
ABSORBED = 0.01  # of the size of a change: a smaller remainder comes from the curvature of the fitted parameters
ALONG = 0.5  # cosine with the change that the planned parameters made
SLOW = 0.15  # Hz
LEAST, NEAR = 0.01, 0.5  # of a starting size: the smallest size tried; the size from which the starting size is kept
ALIKE = 1e-6  # of the largest singular value: smaller directions depend on the others
NOTHING = 1e-9  # of the size of a change: a smaller signature is rounding


@dataclass(frozen=True)
class Signatures:
    """Whitened signatures as unit vectors `rows` (K, N), without the part that the fitted parameters absorb."""

    effects: tuple[Effect, ...]  # (K) effect of each signature
    rows: Array
    sizes: Array  # (K) length of each signature before scaling
    two_sided: Array  # (K) true where the effect can have both signs
    instead: Array  # (K) cosine of each effect's change with the change that the planned parameters made

    def scores(self, misfits: Array) -> Array:
        """Scores: components of the misfit (N) or misfits (B, N) along each signature; standard normal for pure noise."""
        along = misfits @ self.rows.T
        found: Array = np.where(self.two_sided, np.abs(along), along)
        return found


def signatures(recordings: Recordings, fitted: Fitted, sized: bool = True) -> Signatures:
    """Signatures of all effects that the component can leave out, at their starting sizes, beside the fitted model.

    With `sized`, each signature is computed again at the size that the misfit shows along it, because large effects need not
    resemble small ones.
    """
    component = recordings.component
    present = component.present(fitted.parts)
    guesses = [guess for guess in component.hypotheses(recordings.data[0]) if key(guess) not in present]
    before = recordings.joined(recordings.predicted(fitted.parts))
    absorbed = absorber(fitted.jacobian)

    moved, misfit = _moved(fitted), fitted.misfit - absorbed @ (absorbed.T @ fitted.misfit)

    def seen(guess: Effect) -> tuple[Effect, Array, float, float] | None:
        change = recordings.joined(recordings.predicted([*fitted.parts, guess])) - before
        beyond, size = _beyond(change, absorbed), float(np.linalg.norm(change))
        along = float(abs(change @ moved)) / max(size, 1e-300)
        if beyond is None or (beyond[1] < ABSORBED * size and along < ALONG):
            return None
        return guess, *beyond, along

    def left(guess: Effect) -> tuple[Effect, Array, float, float] | None:
        first = seen(guess)
        if first is None or not sized:
            return first
        share = float(misfit @ first[1]) / first[2]
        share = share if share > 0 or _two_sided(guess) else LEAST
        if abs(share) > NEAR:
            return first
        share = float(np.copysign(max(abs(share), LEAST), share))
        if _proportional(guess, fitted):
            return _times(guess, share), np.sign(share) * first[1], abs(share) * first[2], first[3]
        return seen(_times(guess, share)) or first

    found = [row for row in each(left, guesses) if row is not None]
    return Signatures(
        tuple(guess for guess, _, _, _ in found),
        np.array([row for _, row, _, _ in found]).reshape(len(found), len(absorbed)),
        np.array([size for _, _, size, _ in found]),
        np.array([_two_sided(guess) for guess, _, _, _ in found], dtype=bool),
        np.array([along for _, _, _, along in found]),
    )


def _moved(fitted: Fitted) -> Array:
    """Unit vector of the change that the planned parameters made to the output; zero where none has a planned value."""
    known = np.isfinite([number.spread for number in fitted.free])
    planned = np.array([number.planned for number in fitted.free])
    change: Array = fitted.jacobian[: fitted.samples, known] @ (fitted.z - planned)[known]
    return change / max(float(np.linalg.norm(change)), 1e-300)


def general(recordings: Recordings, fitted: Fitted) -> Array:
    """Orthonormal columns (N, r) that span the general law of motion, energy and time, without the absorbed part."""
    return absorber(general_terms(recordings, fitted))


def general_terms(recordings: Recordings, fitted: Fitted) -> Array:
    """Unit columns (N, K), one for each term of the general law, without changes slower than SLOW.

    Such slow changes have too few waves in a recording to distinguish noise from a law.
    """
    absorbed = absorber(np.column_stack([fitted.jacobian, _slow(recordings, len(fitted.misfit))]))
    first = recordings.data[0]
    terms = [recordings.component.features(fitted.parts, one, first) for one in recordings.data]
    columns = []
    for same in zip(*terms, strict=True):
        column = _beyond(recordings.joined([term.response for term in same]), absorbed)
        if column is not None:
            columns.append(column[0])
    return np.array(columns).T if columns else np.zeros((len(absorbed), 0))


def _slow(recordings: Recordings, rows: int) -> Array:
    """Columns (rows, M): cosines slower than SLOW, for each channel of each recording."""
    still = [np.zeros_like(one.measured) for one in recordings.data]
    columns = []
    for place, one in enumerate(recordings.data):
        channels, count = one.measured.shape
        middle = (np.arange(count) + 0.5) / count
        for channel in range(channels):
            for half_waves in range(int(2 * SLOW * count * one.step) + 1):
                wave = still[place].copy()
                wave[channel] = np.cos(np.pi * half_waves * middle)
                columns.append(recordings.joined([*still[:place], wave, *still[place + 1 :]]))
    return np.pad(np.array(columns).T, ((0, rows - len(columns[0])), (0, 0)))


def absorber(jacobian: Array) -> Array:
    """Orthonormal columns that span the columns of a Jacobian."""
    scale = np.linalg.norm(jacobian, axis=0)
    used = jacobian[:, scale > 0] / scale[scale > 0]
    if not used.shape[1]:
        return np.zeros((len(jacobian), 0))
    basis, triangle = qr(used, mode="economic", check_finite=False)
    left, values, _ = np.linalg.svd(triangle)
    spanned: Array = basis @ left[:, values > ALIKE * values[0]]
    return spanned


def best_first(found: Signatures, scores: Array) -> Sequence[int]:
    """Indices of the best signature of each effect, with the highest score first."""
    order = np.argsort(-scores)
    seen = set()
    places = []
    for place in order:
        kind = key(found.effects[place])
        if kind not in seen:
            seen.add(kind)
            places.append(int(place))
    return places


def _free(change: Array, absorbed: Array) -> Array:
    """The change of the output without the absorbed part."""
    change = np.concatenate([change, np.zeros(len(absorbed) - len(change))])
    left: Array = change - absorbed @ (absorbed.T @ change)
    return left


def _beyond(change: Array, absorbed: Array) -> tuple[Array, float] | None:
    """The change without the absorbed part, as a unit vector, and its length; None where nothing remains."""
    if not np.isfinite(change).all():
        return None
    left = _free(change, absorbed)
    size = float(np.linalg.norm(left))
    if size <= NOTHING * max(1.0, float(np.linalg.norm(change))):
        return None
    return left / size, size


def _times(guess: Effect, share: float) -> Effect:
    resized: Effect = physics.SEARCHES[type(guess)].times(guess, share)
    return resized


def _proportional(guess: Effect, fitted: Fitted) -> bool:
    """Whether the change of the output is proportional to the size of the effect, so that its signature needs no replay."""
    beside = [part for part in fitted.parts if isinstance(part, Effect)]
    return _adds(guess) and all(_adds(part) for part in beside)


def _adds(effect: Effect) -> bool:
    return effect.hook in (FORCE, F_SENSOR, X_SENSOR) and physics.SEARCHES[type(effect)].proportional


def _two_sided(effect: Effect) -> bool:
    return _signed(type(effect))


@lru_cache(maxsize=256)
def _signed(kind: type[Effect]) -> bool:
    schema = kind.model_json_schema()["properties"]
    return any(schema[name].get("minimum", schema[name].get("exclusiveMinimum", -1.0)) < 0 for name in kind.neutral)
