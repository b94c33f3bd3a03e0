"""The verdict on a plan, built from the judgements of all components."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rths_engine.diagnosis import certificate, schema
from rths_engine.diagnosis.calibration import MOST_PART
from rths_engine.diagnosis.components import Chain
from rths_engine.diagnosis.components.component import key
from rths_engine.diagnosis.described import formula, law_terms, sentence, state
from rths_engine.diagnosis.digital import Replayed
from rths_engine.diagnosis.fitting import Fitted
from rths_engine.diagnosis.judge import Judged
from rths_engine.diagnosis.locate import place
from rths_engine.diagnosis.named import configuration_error, models, named, rejected
from rths_engine.diagnosis.next_test import Motion, next_test
from rths_engine.diagnosis.remaining import Remaining
from rths_engine.diagnosis.schema.form import finite
from rths_engine.diagnosis.separate import alike
from rths_engine.planning.plan import Plan

# chosen; see docs/decisions/0023
SHOWN = 8  # candidates
ORDER = ("consistent", "recalibrate", "undetermined", "mismatch")


def verdict_of(
    plan: Plan,
    judged: Sequence[Judged],
    digital: Sequence[Replayed],
    level: float,
    extended: Plan | None,
    left: Mapping[str, Remaining],
) -> schema.Verdict:
    """The verdict on the plan.

    `level` is the false-alarm rate of one component. `extended` is the plan with the effects; None where no effect was added.
    `left` is what no named effect explains, by the name of the component.
    """
    worst = max(judged, key=lambda one: (ORDER.index(one.verdict), one.gain))
    wrong = [one for one in digital if one.differs]
    chosen = worst.selection.chosen
    near = alike(worst.recordings, chosen, worst.selection.tried, worst.selection.chances) if worst.effects else []
    remains = left.get(worst.component.name)
    ranked = sorted(judged, key=lambda one: -one.gain)
    effects = [effect for one in ranked if one.verdict == "mismatch" for effect in named(one, left.get(one.component.name))]
    return schema.Verdict(
        verdict="configuration_error" if wrong else worst.verdict,
        components=(*(_digital(one) for one in digital), *(_component(one, level) for one in judged)),
        where=_where(worst, remains) if worst.verdict in ("mismatch", "undetermined") else None,
        effects=(*(configuration_error(one) for one in wrong), *effects),
        candidates=_candidates(worst),
        indistinguishable=(tuple(_joined(worst, one) for one in (chosen, *(model for model, _ in near))),) if near else (),
        fit=_fit(worst),
        unexplained=_unexplained(worst, remains, level),
        next_test=_next_test(plan, worst, near) if near else _exploring(remains),
        remaining_share=worst.proof.remaining if worst.proof else None,
        certificate=certificate.line("chain" if isinstance(worst.component, Chain) else plan.test),
        replicated=worst.proof is not None and worst.proof.replicated,
        rejected=tuple(effect for one in ranked for effect in rejected(one)),
        extended_plan=extended.as_dict() if extended else None,
    )


def _component(one: Judged, level: float) -> schema.ComponentVerdict:
    first = one.selection.detections[0]
    return schema.ComponentVerdict(
        component=one.component.name,
        residual_nrmse=finite(one.nrmse(one.component.base, None)),
        noise_nrmse=finite(one.noise),
        p_value=finite(first.p_value),
        mismatch=first.p_value <= level,
        verdict=one.verdict,
    )


def _digital(one: Replayed) -> schema.ComponentVerdict:
    """The verdict on a computed part. It has no noise and no p-value: its replay agrees to rounding or it does not."""
    return schema.ComponentVerdict(
        component=one.component,
        residual_nrmse=finite(one.nrmse),
        noise_nrmse=None,
        p_value=None,
        mismatch=one.differs,
        verdict="configuration_error" if one.differs else "consistent",
    )


def _candidates(one: Judged) -> tuple[schema.Candidate, ...]:
    """The most probable models. Their probabilities include the doubt that the library does not hold the truth."""
    pairs = zip(one.selection.tried, one.selection.chances, strict=True)
    best = min(model.bic for model in one.selection.tried)
    rejected = {key(effect.effect) for effect in one.proof.rejected} if one.proof else set()
    refused = rejected - {key(part) for part in one.selection.chosen.parts}
    ranked = [pair for pair in pairs if not refused & {key(part) for part in pair[0].parts}][:SHOWN]
    held = 1.0
    if one.proof:
        held = min((claim.probability for claim in one.proof.claims), default=MOST_PART)
    return tuple(
        schema.Candidate(
            effects=tuple(models(one, model)),
            probability=chance * held,
            delta_bic=model.bic - best,
            heldout_nrmse=finite(one.nrmse(model.parts, False)),
        )
        for model, chance in ranked
    )


def _fit(one: Judged) -> schema.Fit:
    def both(model: Fitted) -> schema.Errors:
        fitted, held_out = one.nrmse(model.parts, True), one.nrmse(model.parts, False)
        return schema.Errors(fit_nrmse=finite(fitted), heldout_nrmse=finite(held_out))

    return schema.Fit(
        baseline=both(one.selection.baseline),
        extended=both(one.selection.chosen),
        noise_floor_nrmse=finite(one.noise),
    )


def _unexplained(one: Judged, remains: Remaining | None, level: float) -> schema.Unexplained:
    model = one.selection.chosen if one.effects or remains is None else one.selection.baseline
    beyond = finite(one.nrmse(model.parts, True) ** 2 - one.noise**2)
    fraction = None if beyond is None else max(0.0, beyond) ** 0.5
    if remains:
        return schema.Unexplained(
            fraction=fraction,
            formula=formula(remains),
            words=sentence(remains, one.name),
            size=finite(remains.size),
            unit=remains.unit,
            formula_share=remains.law.held_out_share if remains.law else None,
            state_share=remains.state_share,
            state=state(remains),
            times_s=tuple(remains.place.times),
            bands_hz=tuple(remains.place.bands),
            terms=law_terms(remains),
        )
    if one.selection.detections[-1].p_value > level:
        words = (
            "The remaining residual is noise: no effect of the library and no general law of motion, energy and time "
            "is significant in it."
        )
    elif fraction is None:
        words = f"The simulated {one.component.output} diverges, so the remaining residual has no finite size."
    else:
        words = (
            f"The residual beyond the noise is {100 * fraction:.2g} % of the RMS of the recorded {one.component.output} "
            "about its mean. It is not explained."
        )
    return schema.Unexplained(fraction=fraction, formula=None, words=words)


def _where(one: Judged, remains: Remaining | None) -> schema.Where:
    found = place(one)
    words = [found.state, state(remains) if remains else ""]
    claims = sorted(one.proof.claims if one.proof and not one.unknown else (), key=lambda claim: -claim.probability)
    effects = [one.component.place(claim.effect) for claim in claims]
    return schema.Where(
        component=effects[0] if effects else one.component.name,
        times_s=tuple(found.times),
        bands_hz=tuple(found.bands),
        state=". ".join(one for one in words if one),
    )


def _next_test(plan: Plan, one: Judged, near: list[tuple[Fitted, float]]) -> schema.NextTest | None:
    """The test that separates the chosen model and its nearest rival; None where there is no rival or no such test."""
    if not near or not plan.stations:
        return None
    limits = plan.stations[int(one.component.station or 1) - 1].limits
    best, (other, _) = one.selection.chosen, near[0]
    found = next_test(one.recordings, best.parts, other.parts, limits.displacement, limits.velocity)
    if found is None:
        return None
    return schema.NextTest(
        separates=(_joined(one, best), _joined(one, other)),
        signal=found.signal,
        expected_lambda=found.expected,
        **_command(found.motion),
    )


def _exploring(remains: Remaining | None) -> schema.NextTest | None:
    """The test that tells most about what no named effect explains; None where there is none."""
    if remains is None or remains.test is None:
        return None
    found = remains.test
    command = _command(found.motion) if found.motion else {"waveform": "recorded", "factor": found.factor}
    return schema.NextTest(separates=(), signal=found.signal, expected_lambda=None, tells=found.tells, **command)


def _command(motion: Motion) -> dict[str, Any]:
    return {
        "waveform": motion.waveform,
        "amplitude": motion.amplitude,
        "frequency": motion.frequency,
        "cycles": motion.cycles,
    }


def _joined(one: Judged, model: Fitted) -> str:
    return ", ".join(models(one, model))
