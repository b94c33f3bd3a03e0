"""Which effects were left out: forward by evidence with swaps, up to three."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.detect import Detection, detect
from rths_engine.diagnosis.fitting import ROUGH, Fitted, Recordings, compared, fit
from rths_engine.diagnosis.noise_of import first_noise, weighted, with_noise
from rths_engine.diagnosis.parallel import each
from rths_engine.diagnosis.signatures import Signatures, best_first, general, signatures
from rths_engine.part import Part
from rths_engine.physics.effect import Effect

MOST_EFFECTS = 3
TRIED = 8
WEAK = 0.25  # of the best score: weaker effects are not tried
HOPELESS = 60.0  # of BIC behind the best
FINAL = 8  # evaluations of a fit that only the noise has changed
WORTH = 6.0  # of BIC: strong evidence (Kass and Raftery 1995)


@dataclass(frozen=True)
class Selection:
    """Planned parts refitted, the model chosen, every model tried by evidence, and the detection at each stage."""

    recordings: Recordings
    baseline: Fitted
    chosen: Fitted
    tried: tuple[Fitted, ...]
    detections: tuple[Detection, ...]

    @property
    def effects(self) -> tuple[Part, ...]:
        return self.chosen.parts[len(self.recordings.component.base) :]


def select(
    recordings: Recordings, level: float, random: np.random.Generator, told: Callable[[float], None] = lambda share: None
) -> Selection:
    """`told` hears the share of the work done."""
    plain = first_noise(recordings)
    rough = fit(plain, recordings.component.base)
    plain = weighted(plain, rough, random)
    recordings = with_noise(plain, rough)
    chosen = fit(recordings, rough.parts)
    tried: list[Fitted] = []
    detections: list[Detection] = []
    base = len(recordings.component.base)
    for stage in range(MOST_EFFECTS + 1):
        told((0.3 + 1.7 * stage) / (1.7 * MOST_EFFECTS + 2))
        found = signatures(recordings, chosen)
        detections.append(detect(recordings, chosen, found, general(recordings, chosen), random))
        if detections[-1].p_value > level or len(chosen.parts) == base + MOST_EFFECTS:
            break
        fits = _extended(recordings, chosen, found, detections[-1])
        fits += _swapped(recordings, chosen, fits)
        best = min(fits, key=_bic, default=chosen)
        if best.bic > chosen.bic - WORTH:
            break
        tried += fits
        recordings = with_noise(recordings, best)
        chosen = fit(recordings, best.parts)
    told(0.9)
    return _compared(recordings, rough, chosen, tried, detections)


def _extended(recordings: Recordings, chosen: Fitted, found: Signatures, detection: Detection) -> list[Fitted]:
    """The chosen model with each promising effect: all roughly, then the best to the end."""
    places = best_first(found, detection.scores)
    near = [place for place in places if detection.scores[place] > WEAK * detection.largest][:TRIED]
    effects: list[Effect] = [found.effects[place] for place in near]
    rough = each(lambda effect: fit(recordings, [*chosen.parts, effect], ROUGH), effects)
    best = min((one.bic for one in rough), default=0.0)
    return each(lambda one: fit(recordings, one.parts) if one.bic < best + HOPELESS else one, rough)


def _swapped(recordings: Recordings, chosen: Fitted, fits: list[Fitted]) -> list[Fitted]:
    """The newest effect of the best extension instead of each of those chosen before."""
    base = len(recordings.component.base)
    if len(chosen.parts) == base or not fits:
        return []
    newest = min(fits, key=_bic).parts[-1]
    kept = [[part for place, part in enumerate(chosen.parts) if place != gone] for gone in range(base, len(chosen.parts))]
    return each(lambda parts: fit(recordings, [*parts, newest]), kept)


def _compared(
    recordings: Recordings, baseline: Fitted, chosen: Fitted, tried: list[Fitted], detections: list[Detection]
) -> Selection:
    """Every model once more under the final noise, so that their evidence compares."""
    base = len(recordings.component.base)
    models = {tuple(sorted(str(key(part)) for part in one.parts[base:])): one for one in [baseline, *tried, chosen]}
    others = each(lambda one: compared(recordings, one), [one for one in models.values() if one is not chosen])
    near = [one for one in others if one.bic < chosen.bic + HOPELESS or len(one.parts) == base]
    again = each(lambda one: fit(recordings, one.parts, FINAL), near)
    ranked = sorted([chosen, *again, *(one for one in others if all(one is not kept for kept in near))], key=_bic)
    plain = next(one for one in ranked if len(one.parts) == base)
    return Selection(recordings, plain, ranked[0], tuple(ranked), tuple(detections))


def _bic(fitted: Fitted) -> float:
    return fitted.bic
