"""The report of a diagnosis where there is little to say: nothing selected, numbers that are not finite, candidates alike."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest

from app.reports.diagnosis import report_html
from app.reports.diagnosis_tables import tables
from rths_engine.diagnosis.pictures import pictures
from rths_engine.diagnosis.schema import Pictures, Verdict
from rths_engine.diagnosis.verdict import diagnose
from tests.engine import recorded_specimens as made


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
    html = report_html("Clean", [], *clean)
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
    html = report_html("Broken", [], Verdict.read(verdict), Pictures.read(shown))
    assert "The noise floor is – %" in html
    assert specs(html)[0]["rows"][0]["said"][0] is None
    assert "no finite value" in html


def test_candidates_that_are_alike_and_the_next_test_are_told_in_words(clean: tuple[Verdict, Pictures]) -> None:
    pair = ["specimen:1/coulomb_friction", "sensor:f_meas.1/offset, specimen:1/backlash"]
    next_test = {"separates": pair, "signal": "a sine of 5 mm at 1 Hz, 6 cycles", "expected_lambda": 42.0}
    told = tables(Verdict.read({**clean[0].as_dict(), "indistinguishable": [pair], "next_test": next_test}))
    words = ["coulomb friction of specimen 1", "offset of sensor f_meas.1 and backlash of specimen 1"]
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
    assert reason in tables(verdict).next_test
    assert tables(verdict).next_test in report_html("Alike", [], verdict, clean[1])


def test_a_value_is_shown_with_the_digits_that_its_interval_bears(clean: tuple[Verdict, Pictures]) -> None:
    number = {"name": "gap", "label": "Free play g", "value": 2.00123e-3, "unit": "m", "shown": "mm", "factor": 1e-3}
    effect = {"component": "specimen:1", "id": "backlash", "probability": 1.0, "sentence": "It plays."}
    for ci90, shown in (([1.9e-3, 2.1e-3], "2.001"), ([2.00122e-3, 2.00124e-3], "2.00123")):
        effects = [{**effect, "parameters": [{**number, "ci90": ci90}]}]
        told = tables(Verdict.read({**clean[0].as_dict(), "effects": effects}))
        assert told.parameters[0][:3] == ["backlash of specimen 1", "Free play g", shown]
