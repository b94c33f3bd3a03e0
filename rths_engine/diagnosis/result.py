"""The verdict in the form that people, pages and programs read: `rths-diagnosis/1`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.fitting import Fitted
from rths_engine.diagnosis.judge import Judged
from rths_engine.diagnosis.locate import place
from rths_engine.diagnosis.next_test import next_test
from rths_engine.diagnosis.separate import alike, separation
from rths_engine.diagnosis.unknown import Law, law
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.planning.plan import Plan

SCHEMA = "rths-diagnosis/1"
SHOWN = 8  # candidates
ORDER = ("consistent", "recalibrate", "undetermined", "mismatch")


def as_dict(
    plan: Plan, judged: Sequence[Judged], digital: Sequence[Replayed], level: float, extended: Plan | None
) -> dict[str, Any]:
    worst = max(judged, key=lambda one: (ORDER.index(one.verdict), one.gain))
    wrong = [one for one in digital if one.differs]
    chosen = worst.selection.chosen
    near = alike(worst.recordings, chosen, worst.selection.tried) if worst.effects else []
    group = [", ".join(_names(worst, one)) for one in (chosen, *(model for model, _ in near))]
    beyond = worst.verdict == "mismatch" and worst.selection.detections[-1].p_general <= level
    remains = law(worst.recordings, chosen) if beyond or worst.verdict == "undetermined" else None
    ranked = sorted(judged, key=lambda one: -one.gain)
    effects = [effect for one in ranked if one.verdict == "mismatch" for effect in _effects(one, remains, level)]
    return {
        "schema": SCHEMA,
        "verdict": "configuration_error" if wrong else worst.verdict,
        "components": [_digital(one) for one in digital] + [_component(one, level) for one in judged],
        "where": _where(worst) if worst.verdict in ("mismatch", "undetermined") else None,
        "effects": [_configuration(one) for one in wrong] + effects,
        "candidates": _candidates(worst),
        "indistinguishable": [group] if near else [],
        "fit": _fit(worst),
        "unexplained": _unexplained(worst, remains, level),
        "next_test": _next_test(plan, worst, near),
        "extended_plan": extended.as_dict() if extended else None,
    }


def _component(one: Judged, level: float) -> dict[str, Any]:
    first = one.selection.detections[0]
    return {
        "component": one.component.name,
        "residual_nrmse": one.nrmse(one.component.base, None),
        "noise_nrmse": one.noise,
        "p_value": first.p_value,
        "mismatch": first.p_value <= level,
        "verdict": one.verdict,
    }


def _digital(one: Replayed) -> dict[str, Any]:
    return {
        "component": one.component,
        "residual_nrmse": one.nrmse,
        "noise_nrmse": 0.0,
        "p_value": 1e-300 if one.differs else 1.0,
        "mismatch": one.differs,
        "verdict": "configuration_error" if one.differs else "consistent",
    }


def _configuration(one: Replayed) -> dict[str, Any]:
    sentence = (
        f"What was recorded as {one.what} is not what the plan computes: it is off by {100 * one.error:.3g} % of the largest. "
        "The controller ran with other settings than the plan's."
    )
    return {"component": one.component, "id": "configuration_error", "probability": 1.0, "sentence": sentence, "parameters": []}


def _effects(one: Judged, remains: Law | None, level: float) -> list[dict[str, Any]]:
    if one.unknown:
        return [_unknown(one, remains, level)]
    chosen = one.selection.chosen
    likely = one.selection.chances
    ranges = one.selection.ranges
    found = []
    for owner, effect in enumerate(chosen.parts):
        if owner < len(one.component.base):
            continue
        assert isinstance(effect, Effect)
        chance = sum(p for p, model in zip(likely, one.selection.tried, strict=True) if _holds(one, model, effect))
        numbers = [
            {
                "name": number.field,
                "value": getattr(effect, number.field),
                **_unit(effect, number.field),
                "ci90": [number.from_z(low), number.from_z(high)],
            }
            for number, (low, high) in zip(chosen.free, ranges, strict=True)
            if number.owner == owner
        ]
        told: dict[str, Any] = {
            "component": one.component.place(effect),
            "id": effect.id,
            "probability": min(1.0, chance),
            "sentence": _sentence(one, effect, numbers),
            "parameters": numbers,
        }
        without = [part for part in chosen.parts if part is not effect]
        found.append((-round(told["probability"], 2), -separation(one.recordings, chosen.parts, without), told))
    return [told for _, _, told in sorted(found, key=lambda one: one[:2])]


def _sentence(one: Judged, effect: Effect, numbers: Sequence[dict[str, Any]]) -> str:
    spans = ", ".join(_span(number) for number in numbers[:1])
    at = one.component.place(effect)
    subject = {"sensor": "sensor", "input": "recorded ground motion"}.get(at.partition(":")[0], one.name)
    if at.startswith("sensor"):
        subject = f"sensor {at.partition(':')[2]}"
    elif at.startswith("structure:"):
        subject = f"structure, in storey {at.partition(':')[2]},"
    before, after = (100 * one.nrmse(parts, False) for parts in (one.selection.baseline.parts, one.selection.chosen.parts))
    search = physics.SEARCHES[type(effect)]
    told = f"The {subject} {search.says(effect)}: {search.noun} was left out ({spans})."
    return f"{told} Its model takes the error on what was not fitted from {before:.3g} % to {after:.3g} %."


def _span(number: dict[str, Any]) -> str:
    low, high = (one / number["factor"] for one in number["ci90"])
    unit = "" if number["shown"] == "1" else f" {number['shown']}"
    return f"{number['label']} {low:.3g} to {high:.3g}{unit} with 90 % confidence"


def _unknown(one: Judged, remains: Law | None, level: float) -> dict[str, Any]:
    law_words = f", {remains.words}" if remains else ""
    best = one.selection.effects
    nearest = f" The nearest known effect, {best[-1].id.replace('_', ' ')}, accounts for a part only." if best else ""  # type: ignore[attr-defined]
    return {
        "component": one.component.name,
        "id": "unknown",
        "probability": 1.0 - level,
        "sentence": f"The {one.name} does something that no effect of the library accounts for{law_words}.{nearest}",
        "parameters": [],
    }


def _candidates(one: Judged) -> list[dict[str, Any]]:
    best = min(model.bic for model in one.selection.tried)
    ranked = list(zip(one.selection.tried, one.selection.chances, strict=True))[:SHOWN]
    return [
        {
            "effects": _names(one, model),
            "probability": probability,
            "delta_bic": model.bic - best,
            "heldout_nrmse": one.nrmse(model.parts, False),
        }
        for model, probability in ranked
    ]


def _fit(one: Judged) -> dict[str, Any]:
    def both(model: Fitted) -> dict[str, float]:
        return {"fit_nrmse": one.nrmse(model.parts, True), "heldout_nrmse": one.nrmse(model.parts, False)}

    return {
        "baseline": both(one.selection.baseline),
        "extended": both(one.selection.chosen),
        "noise_floor_nrmse": one.noise,
    }


def _unexplained(one: Judged, remains: Law | None, level: float) -> dict[str, Any]:
    fraction = max(0.0, one.nrmse(one.selection.chosen.parts, True) ** 2 - one.noise**2) ** 0.5
    if one.selection.detections[-1].p_value > level:
        words = "What remains is noise as far as the library and a general law of motion, energy and time can tell."
    elif remains:
        words = f"What remains is {remains.words} ({100 * remains.share:.0f} % of it)."
    else:
        words = f"{100 * fraction:.2g} % of the deviation of the {one.component.output} is beyond the noise and not explained."
    return {"fraction": fraction, "formula": remains.formula if remains else None, "words": words}


def _where(one: Judged) -> dict[str, Any]:
    found = place(one)
    named = [one.component.place(effect) for effect in one.effects if isinstance(effect, Effect)]
    return {
        "component": named[0] if named else one.component.name,
        "times_s": [list(pair) for pair in found.times],
        "bands_hz": [list(pair) for pair in found.bands],
        "state": found.state,
    }


def _next_test(plan: Plan, one: Judged, near: list[tuple[Fitted, float]]) -> dict[str, Any] | None:
    if not near or not plan.stations:
        return None
    limits = plan.stations[int(one.component.station or 1) - 1].limits
    best, (other, _) = one.selection.chosen, near[0]
    found = next_test(one.recordings, best.parts, other.parts, limits.displacement, limits.velocity)
    if found is None:
        return None
    names = [", ".join(_names(one, model)) for model in (best, other)]
    return {"separates": names, "signal": found.signal, "expected_lambda": found.expected}


def _names(one: Judged, model: Fitted) -> list[str]:
    return [
        f"{one.component.place(part)}/{part.id}" for part in model.parts[len(one.component.base) :] if isinstance(part, Effect)
    ]


def _holds(one: Judged, model: Fitted, effect: Effect) -> bool:
    return any(key(part) == key(effect) for part in model.parts[len(one.component.base) :])


def _unit(effect: Effect, name: str) -> dict[str, Any]:
    field = type(effect).model_fields[name]
    extra = field.json_schema_extra
    extra = extra if isinstance(extra, dict) else {}
    return {
        "unit": str(extra.get("unit", "1")),
        "label": str(field.title or name),
        "shown": str(extra.get("shown_label", "")),
        "factor": float(extra.get("factor", 1.0)),  # type: ignore[arg-type]
    }
