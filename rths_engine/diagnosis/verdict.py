"""What a recording says of a plan's specimens, as `rths-diagnosis/1`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import chi2

from rths_engine.arrays import Array
from rths_engine.diagnosis import measured
from rths_engine.diagnosis.component import Specimen, SpecimenData
from rths_engine.diagnosis.evidence import intervals, probabilities
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.noise import Noise
from rths_engine.diagnosis.select import Selection, select
from rths_engine.part import Part
from rths_engine.physics.effect import Effect
from rths_engine.plan import Plan
from rths_engine.recording import Recording

SCHEMA = "rths-diagnosis/1"
BLOCKS, HELD_OUT = 10, (2, 5, 8)  # of a recording's blocks in a row, these are never fitted
SHOWN = 8  # candidates
NEAR = 6.0  # of BIC: closer models are not told apart
WINDOW = 1.0  # s
ORDER = ("consistent", "recalibrate", "undetermined", "mismatch")


@dataclass(frozen=True)
class Judged:
    """One specimen: what was selected, and its verdict."""

    component: Specimen
    name: str
    selection: Selection
    verdict: str
    heldout: tuple[SpecimenData, ...]


def diagnose(
    plan: Plan, recording: Recording, heldout: Sequence[Recording] = (), level: float = 0.01, seed: int = 0
) -> dict[str, Any]:
    """Every specimen of the plan against the recording. Raises RecordingError for one that is not of this plan.

    The replays run over the whole recording; three of ten blocks are never fitted, nor are the `heldout` recordings.
    """
    measured.checked(plan, recording, "REC.h5")
    for other in heldout:
        measured.checked(plan, other, "--holdout")
    random = np.random.default_rng(seed)
    judged = []
    for number, component in enumerate(measured.specimens(plan), start=1):
        data = measured.data(recording, number)
        if data is not None:
            others = tuple(one for one in (measured.data(other, number) for other in heldout) if one is not None)
            judged.append(_judged(component, plan.stations[number - 1].name, data, others, level, random))
    worst = max(judged, key=lambda one: (ORDER.index(one.verdict), -one.selection.chosen.squared), default=None)
    effects = [effect for one in judged for effect in _effects(one)]
    return {
        "schema": SCHEMA,
        "verdict": worst.verdict if worst else "undetermined",
        "components": [_component(one, level) for one in judged],
        "where": _where(worst) if worst and worst.verdict == "mismatch" else None,
        "effects": effects,
        "candidates": _candidates(worst) if worst else [],
        "indistinguishable": _indistinguishable(worst) if worst else [],
        "fit": _fit(worst) if worst else None,
        "unexplained": _unexplained(worst, level) if worst else None,
        "next_test": None,
        "extended_plan": _extended(plan, judged).as_dict() if effects else None,
    }


def _judged(
    component: Specimen,
    name: str,
    data: SpecimenData,
    others: tuple[SpecimenData, ...],
    level: float,
    random: np.random.Generator,
) -> Judged:
    count = len(component.measured(data))
    fitted = ~np.isin(np.arange(count) * BLOCKS // count, HELD_OUT)
    selection = select(Recordings(component, (data,), (fitted,), Noise(np.ones(1), 1.0)), level, random)
    if selection.effects:
        return Judged(component, name, selection, "mismatch", others)
    if selection.detections[0].p_value <= level:
        return Judged(component, name, selection, "undetermined", others)
    planned = selection.recordings.misfit([component.baseline])
    gain = float(planned @ planned) - selection.chosen.squared
    moved = gain > chi2.ppf(1 - level, max(1, len(selection.chosen.free)))
    return Judged(component, name, selection, "recalibrate" if moved else "consistent", others)


def _component(one: Judged, level: float) -> dict[str, Any]:
    first = one.selection.detections[0]
    return {
        "component": one.component.name,
        "residual_nrmse": _nrmse(one, [one.component.baseline], None),
        "noise_nrmse": _noise(one),
        "p_value": first.p_value,
        "mismatch": first.p_value <= level,
    }


def _effects(one: Judged) -> list[dict[str, Any]]:
    chosen = one.selection.chosen
    likely = probabilities(one.selection.tried)
    ranges = intervals(chosen)
    found = []
    for owner, effect in enumerate(chosen.parts[1:], start=1):
        assert isinstance(effect, Effect)
        sentence = f"The specimen of {one.name} {effect.says()}: {effect.noun} was left out."
        found.append(
            {
                "component": one.component.name,
                "id": effect.id,
                "probability": sum(p for p, model in zip(likely, one.selection.tried, strict=True) if _holds(model, effect)),
                "sentence": sentence,
                "parameters": [
                    {
                        "name": number.field,
                        "value": getattr(effect, number.field),
                        "unit": _unit(effect, number.field),
                        "ci90": [low, high],
                    }
                    for number, (low, high) in zip(chosen.free, ranges, strict=True)
                    if number.owner == owner
                ],
            }
        )
    return found


def _candidates(one: Judged) -> list[dict[str, Any]]:
    best = one.selection.tried[0].bic
    return [
        {
            "effects": _names(one, model),
            "probability": probability,
            "delta_bic": model.bic - best,
            "heldout_nrmse": _nrmse(one, model.parts, False),
        }
        for model, probability in list(zip(one.selection.tried, probabilities(one.selection.tried), strict=True))[:SHOWN]
    ]


def _indistinguishable(one: Judged) -> list[list[str]]:
    best, *others = one.selection.tried
    if len(best.parts) == 1:
        return []
    near = [model for model in others if len(model.parts) == len(best.parts) and model.bic - best.bic < NEAR]
    return [[", ".join(_names(one, best)), ", ".join(_names(one, model))] for model in near]


def _fit(one: Judged) -> dict[str, Any]:
    def both(model: Fitted) -> dict[str, float]:
        return {"fit_nrmse": _nrmse(one, model.parts, True), "heldout_nrmse": _nrmse(one, model.parts, False)}

    baseline, chosen = one.selection.baseline, one.selection.chosen
    return {"baseline": both(baseline), "extended": both(chosen), "noise_floor_nrmse": _noise(one)}


def _unexplained(one: Judged, level: float) -> dict[str, Any]:
    left = max(0.0, _nrmse(one, one.selection.chosen.parts, True) ** 2 - _noise(one) ** 2)
    fraction = float(np.sqrt(left))
    if one.selection.detections[-1].p_value > level:
        words = "What remains is noise as far as the library of effects can tell."
    else:
        words = f"A part of {100 * fraction:.2g} % of the force's standard deviation is beyond the noise and not explained."
    return {"fraction": fraction, "formula": None, "words": words}


def _where(one: Judged) -> dict[str, Any]:
    """Windows of 1 s in which the fitted baseline is off by more than three standard deviations of the noise."""
    recordings = one.selection.recordings
    step = recordings.data[0].band.step
    residual = recordings.residuals(one.selection.baseline.parts)[0]
    width = max(1, round(WINDOW / step))
    rows = residual[: len(residual) // width * width].reshape(-1, width)
    off = np.sqrt(np.mean(rows**2, axis=1)) > 3 * recordings.noise.deviation
    edges = np.flatnonzero(np.diff(np.concatenate([[0], off.astype(int), [0]])))
    times = [[float(a * width * step), float(b * width * step)] for a, b in edges.reshape(-1, 2)]
    power = np.abs(np.fft.rfft(residual)) ** 2
    total = np.cumsum(power) / power.sum()
    frequency = np.fft.rfftfreq(len(residual), step)
    band = [float(frequency[np.searchsorted(total, share)]) for share in (0.05, 0.95)]
    return {"component": one.component.name, "times_s": times, "bands_hz": [band], "state": ""}


def _extended(plan: Plan, judged: Sequence[Judged]) -> Plan:
    stations = list(plan.stations)
    for one in judged:
        place = int(one.component.name.split(":")[1]) - 1
        if one.selection.effects:
            update = {
                "specimen": one.selection.chosen.parts[0],
                "specimen_physics": (*one.component.known, *one.selection.effects),
            }
            stations[place] = stations[place].model_copy(update=update)
    return plan.model_copy(update={"stations": tuple(stations)})


def _nrmse(one: Judged, parts: Sequence[Part], fitted: bool | None) -> float:
    """RMS error over the RMS of the measured force about its mean: of the fitted samples, of those held out, or of all."""
    recordings = one.selection.recordings
    data, mask = recordings.data[0], recordings.masks[0]
    used = np.ones(len(mask), dtype=bool) if fitted is None else mask if fitted else ~mask
    rows: list[tuple[Array, Array]] = []
    if fitted is not False or not one.heldout:
        rows.append((one.component.measured(data)[used], one.component.predicted(parts, data)[used]))
    else:
        rows += [(one.component.measured(other), one.component.predicted(parts, other)) for other in one.heldout]
    error = np.concatenate([real - simulated for real, simulated in rows])
    return float(np.sqrt(np.mean(error**2)) / np.std(np.concatenate([real for real, _ in rows])))


def _noise(one: Judged) -> float:
    recordings = one.selection.recordings
    return recordings.noise.deviation / float(np.std(one.component.measured(recordings.data[0])))


def _names(one: Judged, model: Fitted) -> list[str]:
    return [f"{one.component.name}/{part.id}" for part in model.parts[1:] if isinstance(part, Effect)]


def _holds(model: Fitted, effect: Effect) -> bool:
    return any(type(part) is type(effect) for part in model.parts[1:])


def _unit(effect: Effect, name: str) -> str:
    extra = type(effect).model_fields[name].json_schema_extra
    return str(extra["unit"]) if isinstance(extra, dict) else "1"
