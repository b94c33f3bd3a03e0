"""The report of a diagnosis where there is little to say: nothing selected, numbers that are not finite, candidates alike."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest

from app.reports import html
from app.reports.diagnosis import document
from app.reports.diagnosis_names import ALONE, Names
from app.reports.diagnosis_tables import OTHERWISE, tables
from app.reports.digits import NONE, words
from rths_engine.diagnosis.pictures import pictures
from rths_engine.diagnosis.schema import Pictures, Verdict
from rths_engine.diagnosis.verdict import diagnose
from tests.engine import recorded_specimens as made

PLAN = {"test": "specimen", "stations": [{"name": "Damper"}]}
RATE = {"value": 0.005, "count": 400, "wilson95": [0.001, 0.018]}
CERTIFICATE = {"kind": "specimen", "false_alarm": RATE, "false_discovery": RATE, "power": RATE, "seed": 7, "commit": ""}


def report_html(title: str, facts: list[tuple[str, str]], verdict: Verdict, pictures: Pictures, plan: dict[str, Any]) -> str:
    return html.interactive(document(title, facts, verdict, pictures, plan))


@pytest.fixture(scope="module")
def clean() -> tuple[Verdict, Pictures]:
    found = diagnose(made.plan(), made.recording(3), level=1e-9)
    return found.verdict, pictures(found)


def specs(html: str) -> list[dict[str, Any]]:
    def never(name: str) -> None:
        raise AssertionError(f"{name} is no JSON")

    found = re.findall(r'<script type="application/json">(.*?)</script>', html, re.DOTALL)
    return [json.loads(text, parse_constant=never) for text in found]


def test_where_nothing_was_selected_one_simulation_is_shown(clean: tuple[Verdict, Pictures]) -> None:
    html = report_html("Clean", [], *clean, PLAN)
    names = {trace["name"] for spec in specs(html)[1:] for trace in spec["traces"]}
    assert names == {"Recording", "Simulation", "Noise"}
    assert "Extended model" not in html


def test_numbers_that_are_not_finite_are_left_out_of_tables_and_plots(clean: tuple[Verdict, Pictures]) -> None:
    verdict, shown = (one.as_dict() for one in clean)
    verdict["fit"]["noise_floor_nrmse"] = None
    component = shown["components"][0]
    component["over_time"]["level"][0] = None
    component["detail"]["blocks"][2]["before"] = None
    component["detail"]["channels"][0]["signals"]["measured"] = [None] * 3
    component["detail"]["channels"][0]["signals"]["time_s"] = [0.0, 1.0, 2.0]
    html = report_html("Broken", [], Verdict.read(verdict), Pictures.read(shown), PLAN)
    assert "The noise floor is – %" in html
    assert specs(html)[0]["rows"][0]["said"][0] is None
    assert "no finite value" in html


def test_candidates_that_are_alike_and_the_next_test_are_told_in_words(clean: tuple[Verdict, Pictures]) -> None:
    pair = ["specimen:1/coulomb_friction", "sensor:f_meas.1/offset, specimen:1/backlash"]
    next_test = {"separates": pair, "signal": "a sine of 5 mm at 1 Hz, 6 cycles", "expected_lambda": 42.0}
    told = tables(Verdict.read({**clean[0].as_dict(), "indistinguishable": [pair], "next_test": next_test}), PLAN)
    words = ["Coulomb friction (specimen of Damper)", "Offset (load cell of Damper) and Backlash (specimen of Damper)"]
    assert told.alike == [" or ".join(words)]
    between = f"The expected λ between {words[0]} and {words[1]} is 42"
    assert told.next_test.startswith(f"A sine of 5 mm at 1 Hz, 6 cycles. {between};")


@pytest.mark.parametrize(
    ("groups", "reason"),
    [
        ([], "no two candidates are close enough"),
        ([["actuator:1/gain_error", "sensor:x_meas.1/scale_error"]], "no test within the limits of the rig separates"),
        ([["structure:1/yielding", "structure:1/bouc_wen_hysteresis"]], "a structure has no drive"),
    ],
)
def test_the_report_says_why_no_next_test_is_proposed(
    clean: tuple[Verdict, Pictures], groups: list[list[str]], reason: str
) -> None:
    verdict = Verdict.read({**clean[0].as_dict(), "indistinguishable": groups, "next_test": None})
    assert reason in tables(verdict, PLAN).next_test
    assert tables(verdict, PLAN).next_test in report_html("Alike", [], verdict, clean[1], PLAN)


def effect(**more: Any) -> dict[str, Any]:
    number = {"name": "gap", "label": "Free play g", "value": 2.00123e-3, "unit": "m", "shown": "mm", "factor": 1e-3}
    parameters = [{**number, "ci90": [2.00122e-3, 1.84e2]}]
    found = {"component": "specimen:1", "id": "backlash", "probability": 0.8, "sentence": "It plays.", "parameters": parameters}
    return {**found, **more}


def with_claims(verdict: Verdict, **more: Any) -> Verdict:
    return Verdict.read({**verdict.as_dict(), "verdict": "mismatch", **more})


def test_no_number_has_more_than_four_digits(clean: tuple[Verdict, Pictures]) -> None:
    told = tables(with_claims(clean[0], effects=[effect()]), PLAN)
    assert told.parameters[0] == ["Backlash (specimen of Damper)", "Free play g", "2.001", "2.001", "1.84 × 10⁵", "mm"]


def test_each_claim_stands_with_its_own_proof_and_what_remains_is_said_first(clean: tuple[Verdict, Pictures]) -> None:
    proof = {"gain": 3.21, "gain_ci90": [1.1, 5.4], "share_of_error": 0.31, "blocks": 6, "other_motion": False}
    refused = {"component": "sensor:f_meas.1", "id": "offset", "contradicted": None, "reason": "Its interval holds zero.",
               "gain": 0.1, "gain_ci90": [-1.0, 1.2]}  # fmt: skip
    unknown = effect(id="unknown", probability=None, sentence="Most is unexplained.", parameters=[])
    named = effect(sentence="Part of it: the damper plays.", part_of_it=True, **proof)
    verdict = with_claims(clean[0], effects=[unknown, named], remaining_share=0.62, rejected=[refused], certificate=CERTIFICATE)
    told = tables(verdict, PLAN)
    assert told.sentence == "Most is unexplained." and told.further == []
    (claim,) = told.claims
    assert claim.title == "Part of it: Backlash (specimen of Damper)" and claim.words == "likely"
    assert dict(claim.facts) == {
        "Probability": "likely: 0.80",
        "Own held-out gain": "3.21 (1.1 to 5.4, 90 % interval) in log score for each block",
        "Own share of the error": "31 % of the held-out error beyond the noise",
        "Proved on": "6 held-out blocks of the same motion",
    }
    doubt = dict(told.doubt)
    assert "another amplitude or waveform" in doubt["Replication"]
    assert doubt["Not named"].startswith("Offset (load cell of Damper). Its interval holds zero.")
    assert "0.5 % (0.1 to 1.8 %, 400 cases) false alarms" in doubt["Error rates"]
    html = report_html("Doubt", [], verdict, clean[1], PLAN)
    assert html.index("Most is unexplained.") < html.index("Unexplained: 62 %") < html.index("The damper plays.")
    assert html.index("The damper plays.") < html.index("Where recording and simulation differ")


def test_candidates_are_sorted_by_probability_beside_the_chance_that_none_is_true(clean: tuple[Verdict, Pictures]) -> None:
    def candidate(probability: float, *effects: str) -> dict[str, Any]:
        return {"effects": list(effects), "probability": probability, "delta_bic": 123456789.0, "heldout_nrmse": 0.1}

    given = [candidate(0.1), candidate(0.5, "specimen:1/backlash", "specimen:1/coulomb_friction")]
    told = tables(with_claims(clean[0], candidates=given), PLAN)
    both = "Backlash and Coulomb friction (specimen of Damper)"
    assert [(name, cells) for name, _, cells in told.ranking] == [
        (both, ["0.50", "10", "> 1000"]), (OTHERWISE, ["0.40", NONE, NONE]), (ALONE, ["0.10", "10", "> 1000"])
    ]  # fmt: skip


def test_places_have_the_names_of_the_plan() -> None:
    names = Names.of({"test": "hybrid", "stations": [{"name": "Damper", "storey": 3}]})
    assert names.component("specimen:1") == "specimen of Damper, storey 3"
    assert names.sentence("The sensor f_meas.1 reads high.") == "The load cell of Damper, storey 3 reads high."
    assert names.component("actuator:2") == "actuator of station 2"
    assert names.title("structure:2", "coulomb_friction") == "Coulomb friction (storey 2 of the structure)"
    assert names.title("input", "scale_error") == "Scale error (ground motion)"
    assert names.title("specimen:1", "of_the_future") == "Of the future (specimen of Damper, storey 3)"


@pytest.mark.parametrize(
    ("probability", "replicated", "said"),
    [
        (0.99, True, "almost certain, replicated"),
        (0.99, False, "almost certain, not replicated"),
        (0.93, False, "very likely"),
        (0.6, False, "more likely than not"),
        (0.0, False, "very unlikely"),
    ],
)
def test_a_probability_is_a_word_too(probability: float, replicated: bool, said: str) -> None:
    assert words(probability, replicated) == said
