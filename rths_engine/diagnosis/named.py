"""The effects that a diagnosis names, each with its probability, its numbers and its sentence."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rths_engine.diagnosis import schema
from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.fitting import Fitted
from rths_engine.diagnosis.judge import Judged
from rths_engine.diagnosis.separate import separation
from rths_engine.diagnosis.unknown import Law
from rths_engine.foundation import units
from rths_engine.parts import physics
from rths_engine.parts.physics import wording
from rths_engine.parts.physics.effect import Effect


def named(one: Judged, remains: Law | None) -> list[schema.NamedEffect]:
    """The effects of a component, the most probable first; `unknown` where no effect of the library explains the mismatch."""
    if one.unknown:
        return [_unknown(one, remains)]
    chosen = one.selection.chosen
    found = []
    for owner, effect in enumerate(chosen.parts):
        if owner < len(one.component.base):
            continue
        assert isinstance(effect, Effect)
        probability = min(1.0, _probability(one, effect))
        numbers = _parameters(one, owner, effect)
        effect_named = schema.NamedEffect(
            component=one.component.place(effect),
            id=effect.id,
            probability=probability,
            sentence=_sentence(one, effect, numbers),
            parameters=numbers,
        )
        without = [part for part in chosen.parts if part is not effect]
        found.append((-round(probability, 2), -separation(one.recordings, chosen.parts, without), effect_named))
    return [effect_named for _, _, effect_named in sorted(found, key=lambda one: one[:2])]


def configuration_error(one: Replayed) -> schema.NamedEffect:
    """A computed part whose replay differs by more than rounding. No probability is computed for it."""
    diverges = one.nrmse == float("inf")
    size = "the replay diverges" if diverges else f"the largest error is {100 * one.error:.3g} % of the largest value"
    return schema.NamedEffect(
        component=one.component,
        id="configuration_error",
        probability=None,
        sentence=(
            f"The recording of {one.what} differs from the replay of the plan: {size}. "
            "The controller ran with settings that differ from the plan."
        ),
        parameters=(),
    )


def models(one: Judged, model: Fitted) -> list[str]:
    """The effects of a model, each written component/id."""
    added = model.parts[len(one.component.base) :]
    return [f"{one.component.place(part)}/{part.id}" for part in added if isinstance(part, Effect)]


def _probability(one: Judged, effect: Effect) -> float:
    """Probability that an effect is present: the sum over the models that contain it."""
    pairs = zip(one.selection.chances, one.selection.tried, strict=True)
    base = len(one.component.base)
    return sum(chance for chance, model in pairs if any(key(part) == key(effect) for part in model.parts[base:]))


def _parameters(one: Judged, owner: int, effect: Effect) -> tuple[schema.Parameter, ...]:
    numbers = zip(one.selection.chosen.free, one.selection.ranges, strict=True)
    return tuple(
        schema.Parameter(
            name=number.field,
            value=getattr(effect, number.field),
            **_declared(effect, number.field),
            ci90=(number.from_z(low), number.from_z(high)),
        )
        for number, (low, high) in numbers
        if number.owner == owner
    )


def _declared(effect: Effect, name: str) -> dict[str, Any]:
    """Unit, label and scale that the effect declares for one of its parameters."""
    field = type(effect).model_fields[name]
    extra = field.json_schema_extra
    extra = extra if isinstance(extra, dict) else {}
    shown = wording.fitting(getattr(effect, name), str(extra.get("shown", "1")))
    return {
        "unit": str(extra.get("unit", "1")),
        "label": str(field.title or name),
        "shown": units.pretty(shown),
        "factor": units.factor(shown),
    }


def _sentence(one: Judged, effect: Effect, numbers: Sequence[schema.Parameter]) -> str:
    spans = ", ".join(_span(number) for number in numbers[:1])
    at = one.component.place(effect)
    subject = {"sensor": "sensor", "input": "ground motion"}.get(at.partition(":")[0], one.name)
    if at.startswith("sensor"):
        subject = f"sensor {at.partition(':')[2]}"
    elif at.startswith("structure:"):
        subject = f"structure, in storey {at.partition(':')[2]},"
    before, after = (100 * one.nrmse(parts, False) for parts in (one.selection.baseline.parts, one.selection.chosen.parts))
    search = physics.SEARCHES[type(effect)]
    cause = f"The {subject} {search.says(effect)}: {search.noun} was left out ({spans})."
    return f"{cause} The held-out error is {before:.3g} % with the planned model and {after:.3g} % with the extended model."


def _span(number: schema.Parameter) -> str:
    low, high = (end / number.factor for end in number.ci90)
    unit = f" {number.shown}" if number.shown else ""
    return f"{number.label}: {low:.3g} to {high:.3g}{unit}, 90 % interval"


def _unknown(one: Judged, remains: Law | None) -> schema.NamedEffect:
    """A mismatch that no effect of the library explains. It has no probability, because no effect was fitted for it."""
    law_words = f" The residual contains these terms: {remains.words}." if remains else ""
    best = [effect for effect in one.selection.effects if isinstance(effect, Effect)]
    nearest = f" The nearest effect, {best[-1].id.replace('_', ' ')}, explains only a part of the mismatch." if best else ""
    return schema.NamedEffect(
        component=one.component.name,
        id="unknown",
        probability=None,
        sentence=f"The {one.name} shows a mismatch that no effect of the library explains.{law_words}{nearest}",
        parameters=(),
    )
