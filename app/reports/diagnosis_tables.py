"""The sentences and tables of a verdict: errors in percent, shown units, names of effects."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from app.reports.diagnosis_claims import PART, Claim, claims, doubt
from app.reports.diagnosis_names import Names, capital
from app.reports.digits import NONE, chance, percent, short
from app.shown import VERDICTS
from rths_engine.diagnosis.schema import (
    Candidate,
    ComponentVerdict,
    Errors,
    Fit,
    NamedEffect,
    Parameter,
    Unexplained,
    Verdict,
    Where,
)

LEAST_P = 1e-12  # smaller p-values are shown as < 1e-12
MOST_BIC = 1000.0  # larger differences of BIC are shown as > 1000
LEFT_OVER = 0.005  # smaller probabilities that no candidate is true are not shown
OTHERWISE = "None of these candidates"
SPANS = 6  # most time spans listed
WITHOUT_DRIVE = ("structure", "input")  # components for which no next test is searched


@dataclass(frozen=True, slots=True)
class Tables:
    """The content of a verdict on a page and in a report. Every entry is text, and every row begins with its heading."""

    kind: str
    sentence: str
    further: list[str]
    claims: list[Claim]
    doubt: list[tuple[str, str]]
    remaining: float | None
    components: list[list[str]]
    where: list[tuple[str, str]]
    ranking: list[tuple[str, float, list[str]]]
    alike: list[str]
    parameters: list[list[str]]
    fit: list[list[str]]
    noise_floor: str
    unexplained: list[tuple[str, str]]
    next_test: str


def tables(verdict: Verdict, plan: Mapping[str, Any]) -> Tables:
    """The tables and sentences of a verdict on a plan in JSON form.

    The first sentence is that of the verdict; the claims bring the sentences of the named effects.
    """
    names = Names.of(plan)
    named = claims(verdict, names)
    claimed = {capital(one.sentence) for one in named}
    sentence, *others = [names.sentence(one.sentence) for one in verdict.effects] or [VERDICTS[verdict.verdict]]
    return Tables(
        kind=verdict.verdict,
        sentence=sentence,
        further=[one for one in others if capital(one.removeprefix(PART)) not in claimed],
        claims=named,
        doubt=doubt(verdict, names),
        remaining=verdict.remaining_share,
        components=[_component(one, names) for one in verdict.components],
        where=_where(verdict.where, names),
        ranking=_ranking(verdict, names),
        alike=[" or ".join(names.candidate(one) for one in group) for group in verdict.indistinguishable],
        parameters=[_parameter(one, number, names) for one in verdict.effects for number in one.parameters],
        fit=_fit(verdict.fit),
        noise_floor=percent(verdict.fit.noise_floor_nrmse),
        unexplained=_unexplained(verdict.unexplained),
        next_test=_next_test(verdict, names),
    )


def _component(one: ComponentVerdict, names: Names) -> list[str]:
    errors = (percent(one.residual_nrmse), percent(one.noise_nrmse))
    return [capital(names.component(one.component)), one.verdict.replace("_", " "), *errors, _chance(one.p_value)]


def _chance(p_value: float | None) -> str:
    if p_value is None:
        return NONE
    return "< 1e-12" if p_value < LEAST_P else f"{p_value:.2g}"


def _where(place: Where | None, names: Names) -> list[tuple[str, str]]:
    if not place:
        return []
    times = ", ".join(f"{start:.1f} to {end:.1f} s" for start, end in place.times_s[:SPANS])
    if len(place.times_s) > SPANS:
        times += f" and {len(place.times_s) - SPANS} more spans"
    bands = ", ".join(f"{low:.3g} to {high:.3g} Hz" for low, high in place.bands_hz)
    component = capital(names.component(place.component))
    found = [("Component", component), ("Time", times), ("Frequency", bands), ("State", place.state)]
    return [(name, text) for name, text in found if text]


def _ranking(verdict: Verdict, names: Names) -> list[tuple[str, float, list[str]]]:
    """The candidates by their probability, the largest first, with the probability that none of them is true."""
    rows = [_candidate(one, names) for one in verdict.candidates]
    left = 1 - sum(one.probability for one in verdict.candidates)
    if rows and left > LEFT_OVER:
        rows.append((OTHERWISE, left, [chance(left), NONE, NONE]))
    return sorted(rows, key=lambda row: -row[1])


def _candidate(one: Candidate, names: Names) -> tuple[str, float, list[str]]:
    difference = f"> {MOST_BIC:g}" if one.delta_bic > MOST_BIC else f"{one.delta_bic:.0f}"
    shown = [chance(one.probability), percent(one.heldout_nrmse), difference]
    return names.effects(one.effects), one.probability, shown


def _parameter(effect: NamedEffect, number: Parameter, names: Names) -> list[str]:
    unit = number.unit if number.shown is None else number.shown
    shown = [short(value / number.factor) for value in (number.value, *number.ci90)]
    title = names.title(effect.component, effect.id)
    return [title, number.label or number.name.replace("_", " "), *shown, NONE if unit in ("", "1") else unit]


def _fit(fit: Fit) -> list[list[str]]:
    planned = ["Planned model with refitted parameters", *_errors(fit.baseline)]
    return [planned] if fit.baseline == fit.extended else [planned, ["Extended model", *_errors(fit.extended)]]


def _errors(model: Errors) -> list[str]:
    return [percent(model.fit_nrmse), percent(model.heldout_nrmse)]


def _unexplained(left: Unexplained) -> list[tuple[str, str]]:
    share = f"{percent(left.fraction)} % of the RMS of the measured signal about its mean"
    found = [("Description", left.words), ("Share", share)]
    if left.formula_share is not None:
        explained = f"explains {percent(left.formula_share)} % of the held-out error beyond the noise"
        return [*found, ("Formula", f"{left.formula}; it {explained}")]
    return [*found, ("Formula", left.formula)] if left.formula else found


def _next_test(verdict: Verdict, names: Names) -> str:
    """The next test in words, or the reason why none is proposed."""
    found = verdict.next_test
    if found and found.tells:
        return f"{capital(found.signal)}. {found.tells}"
    if found and found.expected_lambda is not None:
        first, second = (names.candidate(one) for one in found.separates)
        expected = f"The expected λ between {first} and {second} is {short(found.expected_lambda, 3)}"
        return f"{capital(found.signal)}. {expected}; a test separates two candidates from λ = 10 on."
    if not verdict.indistinguishable:
        return "No test is proposed: no two candidates are close enough to need a separating test."
    if verdict.indistinguishable[0][0].startswith(WITHOUT_DRIVE):
        return "No test is proposed: a structure has no drive whose command could be chosen."
    return "No test is proposed: no test within the limits of the rig separates these candidates."
