"""The verdict as people, pages and programs read it, beside what was judged."""

from __future__ import annotations

from typing import Any

import pytest

from rths_engine.diagnosis.result import SHOWN
from rths_engine.diagnosis.verdict import Diagnosis
from rths_engine.planning.reading import read_plan


def test_the_effect_is_told_with_its_number_its_unit_and_its_interval(played: Diagnosis, told: Any) -> None:
    chosen = played.judged[0].selection
    (effect,) = told["effects"]
    assert (effect["component"], effect["id"]) == ("specimen:1", "backlash")
    number = next(one for one in effect["parameters"] if one["name"] == "gap")
    assert number["value"] == chosen.effects[0].gap and number["unit"] == "m"  # type: ignore[attr-defined]
    place, free = next((place, free) for place, free in enumerate(chosen.chosen.free) if free.field == "gap")
    assert number["ci90"] == pytest.approx([free.from_z(end) for end in chosen.ranges[place]], rel=1e-12)
    assert number["ci90"][0] < number["value"] < number["ci90"][1]


def test_the_sentence_has_the_size_and_the_error_before_and_after_on_what_was_not_fitted(told: Any) -> None:
    sentence = told["effects"][0]["sentence"]
    assert "backlash" in sentence and "mm" in sentence
    assert "% without this effect alone and" in sentence


def test_candidates_are_ranked_and_carry_the_probability_of_their_effects(played: Diagnosis, told: Any) -> None:
    chances = [one["probability"] for one in told["candidates"]]
    assert chances == sorted(chances, reverse=True) and sum(chances) <= 1 + 1e-12
    assert len(chances) == min(SHOWN, len(played.judged[0].selection.tried))
    assert min(one["delta_bic"] for one in told["candidates"]) >= 0
    assert "specimen:1/backlash" in told["candidates"][0]["effects"]
    assert chances[0] <= told["effects"][0]["probability"] + 1e-12  # the doubt about the library is in both


def test_errors_are_those_of_the_models_and_end_near_the_noise(played: Diagnosis, told: Any) -> None:
    one, fit = played.judged[0], told["fit"]
    assert fit["baseline"]["heldout_nrmse"] == pytest.approx(one.nrmse(one.selection.baseline.parts, False))
    assert fit["extended"]["fit_nrmse"] == pytest.approx(one.nrmse(one.selection.chosen.parts, True))
    assert fit["noise_floor_nrmse"] == pytest.approx(one.noise)
    assert fit["extended"]["heldout_nrmse"] < 1.2 * one.noise < 0.5 * fit["baseline"]["heldout_nrmse"]


def test_the_components_row_is_that_of_its_first_detection(played: Diagnosis, told: Any) -> None:
    (row,) = told["components"]
    detection = played.judged[0].selection.detections[0]
    assert row["component"] == "specimen:1" and row["mismatch"] and row["p_value"] == pytest.approx(detection.p_value)
    assert row["residual_nrmse"] > row["noise_nrmse"] > 0


def test_the_extended_plan_can_be_run_and_has_the_effect(told: Any) -> None:
    plan = read_plan(told["extended_plan"])
    assert [effect.id for effect in plan.stations[0].specimen_physics] == ["backlash"]


def test_what_is_told_of_the_place_and_the_remainder_is_of_the_worst_component(told: Any) -> None:
    assert told["verdict"] == "mismatch" and told["where"]["component"] == "specimen:1"
    assert told["where"]["times_s"] and told["where"]["bands_hz"]
    assert 0 <= told["unexplained"]["fraction"] < told["fit"]["baseline"]["fit_nrmse"]
