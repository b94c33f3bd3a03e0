"""Which effects were left out: forward by evidence with swaps, up to three."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rths_engine.diagnosis.detect import Detection, detect
from rths_engine.diagnosis.fitting import Fitted, Recordings, evaluated, fit
from rths_engine.diagnosis.noise import Noise, autoregressive
from rths_engine.diagnosis.signatures import Signatures, absorber, best_first, signatures
from rths_engine.part import Part
from rths_engine.physics.effect import Effect

MOST_EFFECTS = 3
TRIED = 6
FINAL = 8  # evaluations of a fit that only the noise has changed
WHITE = Noise(np.ones(1), 1.0)
WORTH = 6.0  # of BIC: strong evidence (Kass and Raftery 1995)


@dataclass(frozen=True)
class Selection:
    """Baseline refitted, the model chosen, every model tried, and the detection at each stage."""

    recordings: Recordings
    baseline: Fitted
    chosen: Fitted
    tried: tuple[Fitted, ...]
    detections: tuple[Detection, ...]

    @property
    def effects(self) -> tuple[Part, ...]:
        return self.chosen.parts[1:]


def select(recordings: Recordings, level: float, random: np.random.Generator) -> Selection:
    rough = fit(recordings, [recordings.component.baseline])
    recordings = with_noise(recordings, rough)
    chosen, tried, detections = fit(recordings, rough.parts), [], []
    for _ in range(MOST_EFFECTS + 1):
        found = signatures(recordings, chosen)
        detections.append(detect(recordings, chosen, found, random))
        if detections[-1].p_value > level or len(chosen.parts) > MOST_EFFECTS:
            break
        fits = [fit(recordings, [*chosen.parts, effect]) for effect in _promising(found, detections[-1])]
        fits += _swapped(recordings, chosen, fits)
        best = min(fits, key=_bic, default=chosen)
        if best.bic > chosen.bic - WORTH:
            break
        tried += fits
        recordings = with_noise(recordings, best)
        chosen = fit(recordings, best.parts)
    return _compared(recordings, rough, chosen, tried, detections)


def with_noise(recordings: Recordings, fitted: Fitted) -> Recordings:
    """With the noise that is left when everything the library could still explain is taken out of the residual."""
    plain = replace(recordings, noise=WHITE)
    now = evaluated(plain, fitted.parts)
    explained = absorber(np.column_stack([now.jacobian, signatures(plain, now).rows.T]))
    return replace(recordings, noise=autoregressive(now.misfit - explained @ (explained.T @ now.misfit)))


def _promising(found: Signatures, detection: Detection) -> list[Effect]:
    places = best_first(found, detection.scores)
    near = [place for place in places if detection.scores[place] > 0.5 * detection.largest]
    return [found.effects[place] for place in near[:TRIED]]


def _swapped(recordings: Recordings, chosen: Fitted, fits: list[Fitted]) -> list[Fitted]:
    """The newest effect of the best extension instead of each of those chosen before."""
    if len(chosen.parts) == 1 or not fits:
        return []
    newest = min(fits, key=_bic).parts[-1]
    kept = [[part for place, part in enumerate(chosen.parts) if place != gone] for gone in range(1, len(chosen.parts))]
    return [fit(recordings, [*parts, newest]) for parts in kept]


def _compared(
    recordings: Recordings, baseline: Fitted, chosen: Fitted, tried: list[Fitted], detections: list[Detection]
) -> Selection:
    """Every model once more under the final noise, so that their evidence compares."""
    models = {tuple(sorted(type(part).__name__ for part in one.parts[1:])): one for one in [baseline, *tried, chosen]}
    again = [fit(recordings, one.parts, FINAL) for one in models.values() if one is not chosen]
    ranked = sorted([chosen, *again], key=_bic)
    plain = next(one for one in ranked if len(one.parts) == 1)
    return Selection(recordings, plain, ranked[0], tuple(ranked), tuple(detections))


def _bic(fitted: Fitted) -> float:
    return fitted.bic
