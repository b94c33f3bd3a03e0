"""The law of the remaining residual: at most three terms of a general law, as a formula and in words."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.signatures import absorber

# chosen; see docs/decisions/0023
MOST_TERMS = 3
LEAST_SHARE = 0.05  # of the power that the general law explains: the least gain of one more term


@dataclass(frozen=True)
class Law:
    """The selected terms as a formula and in words, and the share of the general law's power that they explain."""

    formula: str
    words: str
    share: float


def law(recordings: Recordings, fitted: Fitted) -> Law | None:
    """The law of the part of the residual that the fitted parameters cannot absorb; None where no term explains any of it.

    The terms are selected one after another by orthogonal least squares. Source: Chen, Billings and Luo (1989), Int. J. Control
    50, 1873-1896.
    """
    absorbed = absorber(fitted.jacobian)
    terms = [recordings.component.features(fitted.parts, one) for one in recordings.data]
    columns, names = [], []
    for same in zip(*terms, strict=True):
        change = recordings.joined([term.response for term in same])
        change = np.concatenate([change, np.zeros(len(absorbed) - len(change))])
        left = change - absorbed @ (absorbed.T @ change)
        if np.linalg.norm(left) > 1e-6 * max(1e-300, float(np.linalg.norm(change))):
            columns.append(left)
            names.append(same[0])
    if not columns:
        return None
    table = np.array(columns).T
    misfit = fitted.misfit - absorbed @ (absorbed.T @ fitted.misfit)
    whole = float(np.sum((absorber(table).T @ misfit) ** 2))
    if whole <= 0:
        return None
    chosen: list[int] = []
    reached = 0.0
    while len(chosen) < MOST_TERMS:
        spans = [float(np.sum((absorber(table[:, [*chosen, k]]).T @ misfit) ** 2)) for k in range(table.shape[1])]
        best = int(np.argmax(spans))
        if best in chosen or spans[best] - reached < LEAST_SHARE * whole:
            break
        chosen.append(best)
        reached = spans[best]
    if not chosen:
        return None
    weights = np.linalg.lstsq(table[:, chosen], misfit, rcond=None)[0]
    formula = " ".join(f"{weight:+.3g} {names[k].formula}" for weight, k in zip(weights, chosen, strict=True)).lstrip("+")
    words = "; ".join(names[k].words for k in chosen)
    return Law(formula, words, min(1.0, reached / whole))
