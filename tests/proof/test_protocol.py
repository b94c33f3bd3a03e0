"""The protocol: truths are sealed, tampering is detected, and known answers get the right scores."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from app.cli.main import main
from rths_engine.diagnosis.schema import Verdict
from rths_engine.planning.reading import plan_from_yaml
from rths_engine.recordings.measured.store import load
from tests.proof import drawing, oracle, peer, score, seals, summary, table
from tests.proof.generator.draw import specs
from tests.proof.generator.draw_specimen import specimen_case
from tests.proof.proving import diagnosed

TRUTH: dict[str, Any] = {"effects": [], "outside": None, "about": {}}
FRICTION = {"component": "specimen:1", "id": "coulomb_friction", "form": "LuGre", "parameters": {"friction": 1000.0}}


def effect(name: str, probability: float = 0.9, **parameters: list[float]) -> dict[str, Any]:
    component, _, kind = name.partition("/")
    told = [{"name": key, "value": value, "unit": "1", "ci90": [low, high]} for key, (low, value, high) in parameters.items()]
    return {"component": component, "id": kind, "probability": probability, "sentence": "", "parameters": told}


def diagnosis(verdict: str, *effects: dict[str, Any], candidates: Sequence[list[str]] = ()) -> Verdict:
    place = {"component": effects[0]["component"], "times_s": [], "bands_hz": [], "state": ""} if effects else None
    errors = {"fit_nrmse": None, "heldout_nrmse": None}
    return Verdict.read(
        {
            "schema": "rths-diagnosis/1",
            "verdict": verdict,
            "components": [],
            "where": place,
            "effects": effects,
            "candidates": [
                {"effects": names, "probability": 0.5, "delta_bic": 0.0, "heldout_nrmse": None} for names in candidates
            ],
            "indistinguishable": [],
            "fit": {"baseline": errors, "extended": errors, "noise_floor_nrmse": None},
            "unexplained": {"fraction": None, "formula": None, "words": ""},
            "next_test": None,
            "extended_plan": None,
        }
    )


def test_a_truth_that_was_changed_after_sealing_is_found(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / "sealed" / name).mkdir(parents=True)
        (tmp_path / "sealed" / name / "truth.json").write_text("{}")
    digests = seals.seal(tmp_path / "sealed", tmp_path / "seals.json")
    assert digests["a"] != digests["b"]  # salted: equal truths have different seals
    assert json.loads((tmp_path / "seals.json").read_text()) == digests
    seals.verify(tmp_path / "sealed", digests)
    (tmp_path / "sealed" / "b" / "truth.json").write_text('{"effects": []}')
    with pytest.raises(seals.SealBroken, match="of b is not"):
        seals.verify(tmp_path / "sealed", digests)


def test_a_truth_that_was_taken_away_is_found(tmp_path: Path) -> None:
    (tmp_path / "sealed" / "a").mkdir(parents=True)
    digests = seals.seal(tmp_path / "sealed", tmp_path / "seals.json")
    with pytest.raises(seals.SealBroken, match="'gone'"):
        seals.verify(tmp_path / "sealed", {**digests, "gone": "0"})


def test_a_right_name_scores_with_its_numbers() -> None:
    said = diagnosis("mismatch", effect("specimen:1/coulomb_friction", friction=[900.0, 1050.0, 1100.0]))
    row = score.judged({**TRUTH, "effects": [FRICTION]}, said)
    assert row["located"] and row["named_first"] and row["named_top3"] and row["false_alarm"] is None
    (number,) = row["parameters"]
    assert number["covered"] and number["error"] == pytest.approx(0.05)


def test_a_wrong_name_in_the_right_place_is_only_located() -> None:
    candidates = [["specimen:1/stribeck_friction"], ["specimen:1/coulomb_friction"]]
    said = diagnosis("mismatch", effect("specimen:1/stribeck_friction"), candidates=candidates)
    row = score.judged({**TRUTH, "effects": [FRICTION]}, said)
    assert row["located"] and not row["named_first"] and row["named_top3"] and row["parameters"] == []


@pytest.mark.parametrize(
    ("verdict", "alarm"), [("consistent", False), ("recalibrate", False), ("undetermined", True), ("mismatch", True)]
)
def test_a_clean_recording_is_no_alarm_only_where_nothing_is_blamed(verdict: str, alarm: bool) -> None:
    row = score.judged(TRUTH, diagnosis(verdict))
    assert row["false_alarm"] is alarm and row["falsely_named"] is False and row["located"] is None


def test_physics_outside_the_library_has_to_be_unknown() -> None:
    truth = {**TRUTH, "outside": "cogging"}
    assert score.judged(truth, diagnosis("mismatch", effect("specimen:1/unknown")))["unknown"]
    wrong = score.judged(truth, diagnosis("mismatch", effect("specimen:1/backlash")))
    assert wrong["misnamed"] and not wrong["unknown"]


def test_of_two_effects_one_may_be_found() -> None:
    other = {**FRICTION, "id": "asymmetry"}
    row = score.judged({**TRUTH, "effects": [FRICTION, other]}, diagnosis("mismatch", effect("specimen:1/asymmetry")))
    assert row["two_one"] and not row["two_both"] and row["named_first"] is None


def test_wilsons_interval_is_the_published_one() -> None:
    """10 of 20: (0.5 + z^2/40 -+ ...) = 0.2993 to 0.7007 (Newcombe 1998, Stat. Med. 17, 857-872, has 81 of 263 as below)."""
    assert summary.wilson(10, 20) == pytest.approx([0.2993, 0.7007], abs=1e-4)
    assert summary.wilson(81, 263) == pytest.approx([0.2553, 0.3662], abs=1e-4)
    assert summary.wilson(0, 0) is None


def test_scores_are_counted_by_the_class_of_lambda() -> None:
    rows = []
    for strength, right in ((5.0, False), (50.0, True), (50.0, False), (500.0, True)):
        said = diagnosis("mismatch", effect("specimen:1/coulomb_friction" if right else "specimen:1/asymmetry", 0.8))
        judged = score.judged({**TRUTH, "effects": [FRICTION]}, said)
        rows.append(
            {
                "lambda": strength,
                "level": "plain",
                "truth": ["specimen:1/coulomb_friction"],
                "outside": None,
                "seconds": 1.0,
                **judged,
            }
        )
    rows.append(
        {
            "lambda": None,
            "level": "clean",
            "truth": [],
            "outside": None,
            "seconds": 1.0,
            **score.judged(TRUTH, diagnosis("consistent")),
        }
    )
    found = summary.summary(rows)
    first = found["named_first_rate"]
    assert [first[name]["value"] for name in ("<10", "10-25", "25-100", ">=100")] == [0.0, None, 0.5, 1.0]
    assert found["false_alarm_rate"] == {"value": 0.0, "count": 1, "wilson95": summary.wilson(0, 1)}
    assert found["calibration_error"]["value"] == pytest.approx(0.3)  # 0.8 said, half were right
    assert "specimen:1/coulomb_friction" in table.effects(rows)
    assert "named_first_rate" in table.scores(found)


def test_the_same_seed_makes_the_same_cases_and_a_quarter_is_clean() -> None:
    made = specs(200, 7)
    assert made == specs(200, 7) and made != specs(200, 8)
    assert sum(one.level == "clean" for one in made) >= 50
    assert {one.level for one in specs(20, 7, "specimen/two")} == {"two"}
    assert [one.made["names"] for one in specs(3, 7, "specimen/backlash")] == [["backlash"]] * 3


def test_a_case_is_readable_diagnosed_and_its_truth_is_not_shown(tmp_path: Path) -> None:
    spec = next(one for one in specs(60, 3, "specimen/plain") if one.made["law"] == "linear")
    shown, sealed = tmp_path / "shown" / spec.name, tmp_path / "sealed" / spec.name
    spec.case().write(shown, sealed)
    plan, recording = plan_from_yaml((shown / "plan.yaml").read_text()), load(shown / "fit.h5")
    assert plan.test == recording.test == "specimen" and recording.dt == pytest.approx(plan.substep)
    assert {"x_meas.1", "f_meas.1"} <= set(recording.keys)
    assert {file.name for file in shown.iterdir()} == {"plan.yaml", "fit.h5", "heldout.h5"}
    (tmp_path / "found").mkdir()
    run = diagnosed(shown, tmp_path / "found")
    assert run["exit"] == 0, run["said"]
    found = Verdict.read(json.loads((tmp_path / "found" / f"{spec.name}.json").read_text()))
    row = score.scored(shown, sealed, found, run)
    assert row["truth"] == [
        f"{one['component']}/{one['id']}" for one in json.loads((sealed / "truth.json").read_text())["effects"]
    ]
    assert row["lambda"] > 0 and row["verdict"] == found.verdict


def test_an_oracle_names_a_strong_effect_and_has_all_of_its_own_gain(tmp_path: Path) -> None:
    case = specimen_case(4, "plain", law="linear", names=["pinching"], wanted=300.0)
    case.write(tmp_path / "shown", tmp_path / "sealed")
    known = oracle.judged(tmp_path / "shown", tmp_path / "sealed", {"baseline": None, "extended": None})
    assert known["oracle_named_first"] is True
    assert case.truth.strength is not None
    assert 25 < known["lambda_rival"] <= 1.05 * case.truth.strength  # the baseline is one of the rivals, refitted once more
    assert oracle.gain_share(0.05, 0.01, {"baseline": 0.06, "extended": 0.02}) == pytest.approx(1.0)
    assert oracle.gain_share(0.05, 0.0499, {"baseline": 0.06, "extended": 0.02}) is None


def test_a_picture_has_a_point_for_every_rate_that_was_counted() -> None:
    rates = {name: summary.rate([{"hit": hit} for hit in hits], "hit") for name, hits in (("<10", [1, 0]), (">=100", []))}
    result = {key: {"all": rates["<10"], **rates} for key in drawing.DRAWN}
    picture = ElementTree.fromstring(drawing.svg(result))
    points = [one for one in picture.iter("{http://www.w3.org/2000/svg}circle")]
    assert len(points) == 2 * len(drawing.DRAWN)  # one of each rate, and one in the legend


@pytest.mark.skipif(not peer.installed(), reason="PySINDy is not installed (pip install '.[peer]')")
def test_the_peer_finds_the_term_that_is_there_and_none_in_noise() -> None:
    random = np.random.default_rng(1)
    rows, noise = random.standard_normal((400, 3)), random.standard_normal(400)
    assert peer.chosen(rows, 2 * rows[:, 1] + noise, ["one", "two 5", "three"]) == "two"
    assert peer.chosen(rows, noise, ["one", "two", "three"]) == "none"


def test_a_stop_yields_at_its_reach() -> None:
    assert peer.stop(np.array([0.0, 0.5, 2.0, 1.5, -3.0]), 1.0).tolist() == [0.0, 0.5, 1.0, 0.5, -1.0]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [(["--cases", "0"], "--cases = 0: needs a value >= 1"), (["--seed", "-1"], "--seed"), (["--only", "bridge"], "--only")],
)
def test_what_can_not_be_proved_is_refused(
    arguments: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["prove", *arguments, "--json", str(tmp_path / "out.json")]) == 2
    assert said in capsys.readouterr().err
