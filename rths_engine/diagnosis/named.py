"""The effects that a diagnosis names, each with its probability, its numbers and its sentence."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rths_engine.diagnosis import schema
from rths_engine.diagnosis.claims import HALF, Claim, Claims
from rths_engine.diagnosis.described import sentence as described
from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.fitting import Fitted
from rths_engine.diagnosis.judge import Judged
from rths_engine.diagnosis.remaining import Remaining
from rths_engine.foundation import units
from rths_engine.parts import physics
from rths_engine.parts.physics import wording
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen


def named(one: Judged, remains: Remaining | None) -> list[schema.NamedEffect]:
    """The effects of a component, the most probable first.

    `unknown` comes first where no effect of the library explains the mismatch, or where the named effects are a part of it.
    """
    if one.unknown or one.proof is None:
        return [_unknown(one, remains)]
    ranked = sorted(one.proof.claims, key=lambda claim: (-round(claim.probability, 2), -claim.gain.mean))
    found = [_named(one, one.proof, claim) for claim in ranked]
    return [_unknown(one, remains), *found] if one.proof.part_of_it else found


def rejected(one: Judged) -> list[schema.RejectedEffect]:
    """The effects that the evidence selected and the held-out data did not confirm."""
    return [
        schema.RejectedEffect(
            component=one.component.place(refused.effect),
            id=refused.effect.id,
            contradicted=refused.contradicted,
            reason=refused.reason,
            gain=refused.gain.mean if refused.gain else None,
            gain_ci90=refused.gain.ci90 if refused.gain else None,
        )
        for refused in (one.proof.rejected if one.proof else ())
    ]


def _named(one: Judged, proof: Claims, claim: Claim) -> schema.NamedEffect:
    owner = next(place for place, part in enumerate(one.selection.chosen.parts) if part is claim.effect)
    numbers = _parameters(one, owner, claim.effect)
    return schema.NamedEffect(
        component=one.component.place(claim.effect),
        id=claim.effect.id,
        probability=claim.probability,
        sentence=_sentence(one, proof, claim, numbers),
        parameters=numbers,
        part_of_it=proof.part_of_it,
        gain=claim.gain.mean,
        gain_ci90=claim.gain.ci90,
        share_of_error=claim.share,
        blocks=claim.gain.blocks,
        other_motion=claim.gain.other_motion,
    )


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


def _sentence(one: Judged, proof: Claims, claim: Claim, numbers: Sequence[schema.Parameter]) -> str:
    effect = claim.effect
    spans = ", ".join(_span(number) for number in numbers[:1])
    at = one.component.place(effect)
    subject = {"sensor": "sensor", "input": "ground motion"}.get(at.partition(":")[0], one.name)
    if at.startswith("sensor"):
        subject = f"sensor {at.partition(':')[2]}"
    elif at.startswith("structure:"):
        subject = f"structure, in storey {at.partition(':')[2]},"
    search = physics.SEARCHES[type(effect)]
    the = "Part of it: the" if proof.part_of_it else "The"
    cause = f"{the} {subject} {search.says(effect)}: {search.noun} was left out ({spans})."
    return " ".join(filter(None, (cause, _proof(proof, claim), search.caution(_seen(one, effect)))))


def _seen(one: Judged, effect: Effect) -> Seen:
    seen = one.component.seen(one.recordings.data[0])
    return seen[getattr(effect, "storey", 1) - 1]


def _proof(proof: Claims, claim: Claim) -> str:
    """The proof of one claim: the held-out error with and without the effect."""
    if not claim.gain.other_motion and proof.other_motion:
        return "The held-out recordings do not test this effect; the fitted motion alone shows it."
    motion = "another motion" if claim.gain.other_motion else "the same motion"
    errors = f"{100 * claim.error_without:.3g} % without this effect alone and {100 * proof.errors[1]:.3g} % with it"
    doubt = "" if claim.gain.clear else " Its own gain is not clearly above zero."
    return f"The held-out error is {errors} ({claim.gain.blocks} blocks of {motion}).{doubt}"


def _span(number: schema.Parameter) -> str:
    low, high = (end / number.factor for end in number.ci90)
    unit = f" {number.shown}" if number.shown else ""
    return f"{number.label}: {low:.3g} to {high:.3g}{unit}, 90 % interval"


def _remaining(one: Judged) -> str:
    """The sentence on what is unexplained, where the named effects are a part of the mismatch."""
    share = one.proof.remaining if one.proof else None
    if share is None or share <= HALF:
        return f"The cause of the mismatch of the {one.name} is uncertain."
    remains = f"{100 * min(1.0, share):.0f} % of the held-out error beyond the noise remains"
    return f"Most of the mismatch of the {one.name} is unexplained: {remains}."


def _unknown(one: Judged, remains: Remaining | None) -> schema.NamedEffect:
    """A mismatch that no effect of the library explains. It has no probability, because no effect was fitted for it."""
    law_words = f" {described(remains, one.name)}" if remains else ""
    part = one.proof is not None and one.proof.part_of_it and not one.unknown
    if part:
        sentence = f"{_remaining(one)}{law_words}"
    else:
        best = [effect for effect in one.selection.effects if isinstance(effect, Effect)]
        nearest = f" The nearest effect, {best[-1].id.replace('_', ' ')}, explains only a part of the mismatch." if best else ""
        sentence = f"The {one.name} shows a mismatch that no effect of the library explains.{law_words}{nearest}"
    return schema.NamedEffect(component=one.component.name, id="unknown", probability=None, sentence=sentence, parameters=())
