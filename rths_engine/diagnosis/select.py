"""Selection of the left-out effects: forward by evidence with swaps, up to three effects."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

import numpy as np

from rths_engine.diagnosis.components.component import Loose, key
from rths_engine.diagnosis.detect import Detection, detect, left, null_misfits
from rths_engine.diagnosis.evidence import MATERIAL, STRONG, probabilities, tempering, weighed
from rths_engine.diagnosis.fitting import ROUGH, Fitted, Recordings, compared, fit
from rths_engine.diagnosis.noise_of import first_noise, weighted, with_noise
from rths_engine.diagnosis.parallel import each
from rths_engine.diagnosis.ranges import ranges
from rths_engine.diagnosis.signatures import Signatures, best_first, general, signatures
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.offset import ForceOffset

# chosen; see docs/decisions/0023
MOST_EFFECTS = 3  # without the offset of the load cell
TRIED = 8
WEAK = 0.25  # of the best score: effects with smaller scores are not tried
HOPELESS = 60.0  # difference of BIC to the best model: models behind it are not fitted to the end
FINAL = 8  # evaluations of a fit after a change of the noise only


@dataclass(frozen=True)
class Selection:
    """The refitted planned parts, the selected model, all fitted models ranked by evidence, and the detection of each stage."""

    recordings: Recordings
    baseline: Fitted
    chosen: Fitted
    tried: tuple[Fitted, ...]
    chances: tuple[float, ...]  # probability of each model in `tried`
    detections: tuple[Detection, ...]
    ranges: tuple[tuple[float, float], ...]  # 90 % intervals of z of the selected model

    @property
    def effects(self) -> tuple[Part, ...]:
        return self.chosen.parts[len(self.recordings.component.base) :]


def select(
    recordings: Recordings, level: float, random: np.random.Generator, told: Callable[[float], None] = lambda share: None
) -> Selection:
    """Select the left-out effects of one component.

    `level` is the false-alarm rate of the component. `told` receives the share of the work that is done.
    """
    component = recordings.component
    plain = first_noise(recordings)
    rough = fit(plain, component.base)
    component.settle(rough.parts, recordings.data)
    plain = weighted(plain, rough, random)
    recordings = with_noise(plain, rough)
    chosen = fit(recordings, rough.parts)
    first = chosen.bic
    tried: list[Fitted] = []
    detections: list[Detection] = []
    base, seen = len(component.base), component.seen(recordings.data[0])
    for stage in range(MOST_EFFECTS + 2):
        told((1 + stage) / (MOST_EFFECTS + 4))
        found = signatures(recordings, chosen)
        drawn = null_misfits(recordings, chosen, random)
        detections.append(detect(chosen, found, general(recordings, chosen), drawn))
        counted = [part for part in chosen.parts[base:] if not isinstance(part, ForceOffset)]
        if detections[-1].p_value > level or len(counted) == MOST_EFFECTS:
            break
        fits = _extended(recordings, chosen, found, detections[-1], level)
        fits += _swapped(recordings, chosen, fits)
        best = _best(fits or [chosen], chosen.bic, seen)
        if best.bic > chosen.bic - max(STRONG, MATERIAL * (first - best.bic)):
            break
        tried += fits
        component.settle(best.parts, recordings.data)
        recordings = with_noise(recordings, best)
        chosen = _afresh(recordings, best)
    simpler = _simplified(recordings, chosen)
    told(0.9)
    models = [*each(lambda one: compared(recordings, one), [rough, *tried]), *simpler, chosen]
    return _compared(recordings, models, [*simpler, chosen], drawn, detections, seen, random)


def reduced(selection: Selection, effect: Part) -> Fitted:
    """The selected model with one effect left out and everything else refitted; from `tried` if it was fitted before."""
    base = len(selection.recordings.component.base)
    rest = [part for part in selection.chosen.parts if part is not effect]
    kind = sorted(str(key(part)) for part in rest[base:])
    known = [one for one in selection.tried if sorted(str(key(part)) for part in one.parts[base:]) == kind]
    return known[0] if known else fit(selection.recordings, rest, ROUGH)


def chosen_instead(selection: Selection, model: Fitted) -> Selection:
    """The selection with another model as the selected model, fitted to the end, to be examined.

    The detections end with the stage that had as many effects as the model.
    """
    chosen = fit(selection.recordings, model.parts, FINAL)
    effects = len(chosen.parts) - len(selection.recordings.component.base)
    tried = tuple(chosen if one is model else one for one in selection.tried)
    return replace(selection, chosen=chosen, tried=tried, detections=selection.detections[: effects + 1], ranges=())


def ranked(selection: Selection, chances: Sequence[float]) -> Selection:
    """The selection with other probabilities of the models; the most probable model becomes the selected model."""
    order = sorted(range(len(chances)), key=lambda place: -chances[place])
    tried = tuple(selection.tried[place] for place in order)
    found = replace(selection, tried=tried, chances=tuple(chances[place] for place in order))
    return found if tried[0] is selection.chosen else chosen_instead(found, tried[0])


def excluding(selection: Selection, effect: Part) -> Selection:
    """The selection without all models that have the effect; the most probable of the others becomes the selected model.

    Where every fitted model has it, the selected model is refitted without it.
    """
    base = len(selection.recordings.component.base)
    pairs = zip(selection.tried, selection.chances, strict=True)
    kept = [(one, chance) for one, chance in pairs if all(key(part) != key(effect) for part in one.parts[base:])]
    if not kept:
        return chosen_instead(selection, reduced(selection, effect))
    whole = max(sum(chance for _, chance in kept), 1e-300)
    found = replace(selection, tried=tuple(one for one, _ in kept), chances=tuple(chance / whole for _, chance in kept))
    return chosen_instead(found, found.tried[0])


def examined(selection: Selection, random: np.random.Generator) -> Selection:
    """The selection with the intervals of the selected model, and with what a general law explains after it."""
    recordings, chosen = selection.recordings, selection.chosen
    temper = tempering(chosen.bic, selection.baseline.bic)
    drawn = null_misfits(recordings, chosen, random)
    last = left(selection.detections[-1], chosen, general(recordings, chosen), drawn)
    sure = tuple(ranges(recordings, chosen, drawn, temper))
    return replace(selection, ranges=sure, detections=(*selection.detections[:-1], last))


def _afresh(recordings: Recordings, best: Fitted) -> Fitted:
    """Fit a model again from several starts.

    The starts are the present parameters, the present parameters with the replay's own parameters reset (a kink of a model can
    trap these), and each starting size of the newest effect.
    """
    pairs = zip_longest(best.parts, recordings.component.base)
    loosened = tuple(base if isinstance(base, Loose) else part for part, base in pairs)
    newest = key(best.parts[-1])
    guesses = [guess for guess in recordings.component.hypotheses(recordings.data[0]) if key(guess) == newest]
    rough = each(lambda guess: fit(recordings, [*best.parts[:-1], guess], ROUGH), guesses)
    starts = [best.parts, loosened, min(rough, key=_bic).parts] if len(guesses) > 1 else [best.parts, loosened]
    return min(each(lambda parts: fit(recordings, parts), starts), key=_bic)


def _extended(recordings: Recordings, chosen: Fitted, found: Signatures, detection: Detection, level: float) -> list[Fitted]:
    """The selected model with one more effect: promising effects are fitted roughly, then the best are fitted to the end."""
    places = best_first(found, detection.scores)
    near = [place for place in places if detection.scores[place] > WEAK * detection.largest][:TRIED]
    starts = [[*chosen.parts, found.effects[place]] for place in near]
    if detection.p_planned <= level:
        base = recordings.component.base
        instead = best_first(found, found.instead)[:TRIED]
        starts += [[*base, *chosen.parts[len(base) :], found.effects[place]] for place in instead]
    rough = each(lambda parts: fit(recordings, parts, ROUGH), starts)
    best = min((one.bic for one in rough), default=0.0)
    return each(lambda one: fit(recordings, one.parts) if one.bic < best + HOPELESS else one, rough)


def _swapped(recordings: Recordings, chosen: Fitted, fits: list[Fitted]) -> list[Fitted]:
    """The selected model with each of its effects replaced by the newest effect of the best extension."""
    base = len(recordings.component.base)
    if len(chosen.parts) == base or not fits:
        return []
    newest = min(fits, key=_bic).parts[-1]
    kept = [[part for place, part in enumerate(chosen.parts) if place != gone] for gone in range(base, len(chosen.parts))]
    return each(lambda parts: fit(recordings, [*parts, newest]), kept)


def _simplified(recordings: Recordings, chosen: Fitted) -> list[Fitted]:
    """The selected model without one of its effects, or with a related effect of fewer parameters in its place."""
    base = len(recordings.component.base)
    if len(chosen.parts) == base:
        return []
    others: dict[str, Effect] = {}
    for effect in recordings.component.hypotheses(recordings.data[0]):
        others.setdefault(effect.id, effect)
    models = []
    for place, part in enumerate(chosen.parts[base:], start=base):
        assert isinstance(part, Effect)
        rest = [*chosen.parts[:place], *chosen.parts[place + 1 :]]
        models += [rest] if len(rest) > base else []
        for name in physics.SEARCHES[type(part)].relatives:
            relative = others.get(name)
            if relative is None or key(relative) in {key(one) for one in rest}:
                continue
            if len(type(relative).model_fields) < len(type(part).model_fields):
                models.append([*rest, relative])
    return each(lambda parts: fit(recordings, parts), models)


def _compared(
    recordings: Recordings,
    models: Sequence[Fitted],
    fresh: Sequence[Fitted],
    drawn: Array,
    detections: list[Detection],
    seen: Sequence[Seen],
    random: np.random.Generator,
) -> Selection:
    """Every model under the final noise, so that their evidence compares.

    Models are fitted once more unless they are `fresh`: fitted to these recordings already. The selected model is the last of
    them, and `drawn` are its `null_misfits`.
    """
    base = len(recordings.component.base)
    chosen = fresh[-1]
    kinds: dict[tuple[str, ...], Fitted] = {}
    for one in models:
        kind = tuple(sorted(str(key(part)) for part in one.parts[base:]))
        kinds[kind] = min(kinds.get(kind, one), one, key=_bic)
    others = list(kinds.values())
    near = [one for one in others if one.bic < chosen.bic + HOPELESS or len(one.parts) == base]
    again = each(lambda one: one if any(one is known for known in fresh) else fit(recordings, one.parts, FINAL), near)
    models = [*again, *(one for one in others if all(one is not kept for kept in near))]
    plain = next(one for one in models if len(one.parts) == base)
    weights = weighed(models, plain.bic, seen)
    order = sorted(range(len(models)), key=weights.__getitem__)
    ranked = tuple(models[place] for place in order)
    chances = tuple(probabilities([weights[place] for place in order]))
    found = Selection(recordings, plain, ranked[0], ranked, chances, tuple(detections), ())
    if ranked[0] is not chosen:
        effects = len(ranked[0].parts) - base
        return examined(replace(found, detections=found.detections[: effects + 1]), random)
    return replace(found, ranges=tuple(ranges(recordings, chosen, drawn, tempering(chosen.bic, plain.bic))))


def _best(models: Sequence[Fitted], before: float, seen: Sequence[Seen]) -> Fitted:
    return models[int(np.argmin(weighed(models, before, seen)))]


def _bic(fitted: Fitted) -> float:
    return fitted.bic
