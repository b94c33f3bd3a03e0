"""The sentences and tables of a verdict: errors in percent, shown units, names of effects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

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
SPANS = 6  # most time spans listed
NONE = "–"  # a number that was not computed, or has no unit
WITHOUT_DRIVE = ("structure", "input")  # components for which no next test is searched


@dataclass(frozen=True, slots=True)
class Tables:
    """The content of a verdict on a page and in a report. Every entry is text, and every row begins with its heading."""

    kind: str
    sentence: str
    further: list[str]
    components: list[list[str]]
    where: list[tuple[str, str]]
    ranking: list[tuple[str, float, list[str]]]
    alike: list[str]
    parameters: list[list[str]]
    fit: list[list[str]]
    noise_floor: str
    unexplained: list[tuple[str, str]]
    next_test: str


def tables(verdict: Verdict) -> Tables:
    """The tables and sentences of a verdict."""
    told = [one.sentence for one in verdict.effects]
    sentence, *further = told or [VERDICTS[verdict.verdict]]
    return Tables(
        kind=verdict.verdict,
        sentence=sentence,
        further=further,
        components=[_component(one) for one in verdict.components],
        where=_where(verdict.where),
        ranking=[_candidate(one) for one in verdict.candidates],
        alike=[" or ".join(_named(one) for one in group) for group in verdict.indistinguishable],
        parameters=[_parameter(one, number) for one in verdict.effects for number in one.parameters],
        fit=_fit(verdict.fit),
        noise_floor=_percent(verdict.fit.noise_floor_nrmse),
        unexplained=_unexplained(verdict.unexplained),
        next_test=_next_test(verdict),
    )


def named(effects: Sequence[str]) -> str:
    """The names of effects: `specimen:1/backlash` gives `backlash of specimen 1`."""
    return " and ".join(_one(effect) for effect in effects) or "no left-out effect"


def _one(effect: str) -> str:
    place, _, name = effect.partition("/")
    kind, _, number = place.partition(":")
    return f"{name.replace('_', ' ')} of {kind}{f' {number}' if number else ''}"


def _named(group: str) -> str:
    return named(group.split(", ") if group else [])


def _component(one: ComponentVerdict) -> list[str]:
    verdict = one.verdict.replace("_", " ")
    return [one.component, verdict, _percent(one.residual_nrmse), _percent(one.noise_nrmse), _chance(one.p_value)]


def _chance(p_value: float | None) -> str:
    if p_value is None:
        return NONE
    return "< 1e-12" if p_value < LEAST_P else f"{p_value:.2g}"


def _where(place: Where | None) -> list[tuple[str, str]]:
    if not place:
        return []
    times = ", ".join(f"{start:.1f} to {end:.1f} s" for start, end in place.times_s[:SPANS])
    if len(place.times_s) > SPANS:
        times += f" and {len(place.times_s) - SPANS} more spans"
    bands = ", ".join(f"{low:.3g} to {high:.3g} Hz" for low, high in place.bands_hz)
    found = [("Component", place.component), ("Time", times), ("Frequency", bands), ("State", place.state)]
    return [(name, text) for name, text in found if text]


def _candidate(one: Candidate) -> tuple[str, float, list[str]]:
    chance = one.probability
    shown = f"{chance:.3f}" if chance >= 0.0005 or chance == 0 else "< 0.001"
    return named(one.effects), chance, [shown, f"{one.delta_bic:.0f}", _percent(one.heldout_nrmse)]


def _parameter(effect: NamedEffect, number: Parameter) -> list[str]:
    low, high = number.ci90
    unit = number.unit if number.shown is None else number.shown
    shown = [_digits(value / number.factor, (high - low) / number.factor) for value in (number.value, low, high)]
    return [
        _one(f"{effect.component}/{effect.id}"),
        number.label or number.name,
        *shown,
        NONE if unit in ("", "1") else unit,
    ]


def _digits(value: float, width: float) -> str:
    """A value with as many digits as the width of its interval justifies."""
    digits = 4
    while digits < 7 and width > 0 and abs(value) * 10.0 ** (1 - digits) > 0.2 * width:
        digits += 1
    return f"{value:.{digits}g}"


def _fit(fit: Fit) -> list[list[str]]:
    planned = ["Planned model with refitted parameters", *_errors(fit.baseline)]
    return [planned] if fit.baseline == fit.extended else [planned, ["Extended model", *_errors(fit.extended)]]


def _errors(model: Errors) -> list[str]:
    return [_percent(model.fit_nrmse), _percent(model.heldout_nrmse)]


def _unexplained(left: Unexplained) -> list[tuple[str, str]]:
    share = f"{_percent(left.fraction)} % of the RMS of the measured signal about its mean"
    found = [("Description", left.words), ("Share", share)]
    return [*found, ("Formula", left.formula)] if left.formula else found


def _next_test(verdict: Verdict) -> str:
    """The next test in words, or the reason why none is proposed."""
    found = verdict.next_test
    if found:
        first, second = (_named(one) for one in found.separates)
        expected = f"The expected λ between {first} and {second} is {found.expected_lambda:.3g}"
        return f"{_capital(found.signal)}. {expected}; a test separates two candidates from λ = 10 on."
    if not verdict.indistinguishable:
        return "No test is proposed: no two candidates are close enough to need a separating test."
    if verdict.indistinguishable[0][0].startswith(WITHOUT_DRIVE):
        return "No test is proposed: a structure has no drive whose command could be chosen."
    return "No test is proposed: no test within the limits of the rig separates these candidates."


def _percent(share: float | None) -> str:
    return NONE if share is None else f"{100 * share:.3g}"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
