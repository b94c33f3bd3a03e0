"""A verdict in words and tables for people: percent, shown units, effects by their names."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from app.shown import VERDICTS

LEAST_P = 1e-12  # smaller chances are all nil


@dataclass(frozen=True, slots=True)
class Tables:
    """What a page and a report show of a verdict; every entry is text, every row begins with its head."""

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


def tables(verdict: dict[str, Any]) -> Tables:
    told = [one["sentence"] for one in verdict["effects"]]
    sentence, *further = told or [VERDICTS[verdict["verdict"]]]
    fit = verdict["fit"]
    return Tables(
        kind=verdict["verdict"],
        sentence=sentence,
        further=further,
        components=[_component(one) for one in verdict["components"]],
        where=_where(verdict["where"]),
        ranking=[_candidate(one) for one in verdict["candidates"]],
        alike=[" or ".join(_named(one) for one in group) for group in verdict["indistinguishable"]],
        parameters=[_parameter(one, number) for one in verdict["effects"] for number in one["parameters"]],
        fit=_fit(fit),
        noise_floor=_percent(fit["noise_floor_nrmse"]),
        unexplained=_unexplained(verdict["unexplained"]),
        next_test=_next_test(verdict["next_test"]),
    )


def named(effects: list[str]) -> str:
    """`specimen:1/backlash` for people: backlash of specimen 1."""
    return " and ".join(_one(effect) for effect in effects) or "no effect of the library"


def _one(effect: str) -> str:
    place, _, name = effect.partition("/")
    kind, _, number = place.partition(":")
    return f"{name.replace('_', ' ')} of {kind}{f' {number}' if number else ''}"


def _named(group: str) -> str:
    return named(group.split(", ") if group else [])


def _component(one: dict[str, Any]) -> list[str]:
    chance = "< 1e-12" if one["p_value"] < LEAST_P else f"{one['p_value']:.2g}"
    verdict = str(one["verdict"]).replace("_", " ")
    return [one["component"], verdict, _percent(one["residual_nrmse"]), _percent(one["noise_nrmse"]), chance]


def _where(place: dict[str, Any] | None) -> list[tuple[str, str]]:
    if not place:
        return []
    times = ", ".join(f"{start:.1f} to {end:.1f} s" for start, end in place["times_s"][:6])
    if len(place["times_s"]) > 6:
        times += f" and {len(place['times_s']) - 6} more spans"
    bands = ", ".join(f"{low:.3g} to {high:.3g} Hz" for low, high in place["bands_hz"])
    found = [("Component", place["component"]), ("Time", times), ("Frequency", bands), ("State", place["state"])]
    return [(name, text) for name, text in found if text]


def _candidate(one: dict[str, Any]) -> tuple[str, float, list[str]]:
    chance = one["probability"]
    shown = f"{chance:.3f}" if chance >= 0.0005 or chance == 0 else "< 0.001"
    return named(one["effects"]), chance, [shown, f"{one['delta_bic']:.0f}", _percent(one["heldout_nrmse"])]


def _parameter(effect: dict[str, Any], number: dict[str, Any]) -> list[str]:
    low, high = number["ci90"]
    known = number.get("factor", 1.0)
    unit = number.get("shown", number["unit"])
    shown = [_digits(value / known, (high - low) / known) for value in (number["value"], low, high)]
    return [
        _one(f"{effect['component']}/{effect['id']}"),
        number.get("label", number["name"]),
        *shown,
        "–" if unit == "1" else unit,
    ]


def _digits(value: float, width: float) -> str:
    """As many digits as the width of the interval bears."""
    digits = 4
    while digits < 7 and width > 0 and abs(value) * 10.0 ** (1 - digits) > 0.2 * width:
        digits += 1
    return f"{value:.{digits}g}"


def _fit(fit: dict[str, Any]) -> list[list[str]]:
    planned = ["Planned model, its numbers refitted", *_errors(fit["baseline"])]
    return [planned] if fit["baseline"] == fit["extended"] else [planned, ["Extended model", *_errors(fit["extended"])]]


def _errors(model: dict[str, float]) -> list[str]:
    return [_percent(model["fit_nrmse"]), _percent(model["heldout_nrmse"])]


def _unexplained(left: dict[str, Any]) -> list[tuple[str, str]]:
    found = [("In words", left["words"]), ("Share", f"{_percent(left['fraction'])} % of the deviation of what was measured")]
    return [*found, ("Formula", left["formula"])] if left["formula"] else found


def _next_test(found: dict[str, Any] | None) -> str:
    if not found:
        return ""
    names = " from ".join(_named(one) for one in found["separates"])
    expected = f"expected λ = {found['expected_lambda']:.3g}; from about 10 on they are told apart"
    return f"{_capital(found['signal'])}: it separates {names} ({expected})."


def _percent(share: float | None) -> str:
    return "–" if share is None else f"{100 * share:.3g}"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
