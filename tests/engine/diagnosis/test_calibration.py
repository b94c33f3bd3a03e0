"""The map from the facts of a proof to a probability."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rths_engine.diagnosis.calibration import MOST_ALONE, MOST_PART, MOST_SAME, WEIGHTS, Facts, log_odds, probability

GOOD = Facts(
    mass=1.0,
    evidence=1.0,
    certainty=9.0,
    remaining=0.02,
    flexible=-1.0,
    unexplained=0.0,
    share=1.0,
    other_motion=True,
    replicated=False,
    part_of_it=False,
    doubted=False,
)
BAD = replace(GOOD, mass=0.0, evidence=0.5, certainty=1.0, remaining=0.9, flexible=0.5, unexplained=3.0)


def test_the_map_has_a_weight_for_each_fact() -> None:
    assert len(WEIGHTS) == len(GOOD.row)


def test_a_clear_proof_is_probable_and_a_doubtful_one_is_not() -> None:
    assert probability(GOOD) > 0.85 > 0.5 > probability(BAD)


def test_certainty_needs_a_second_recording_another_motion_and_little_that_remains() -> None:
    sure = (50.0, *(0.0 for _ in WEIGHTS[1:]))
    assert probability(GOOD, sure) == MOST_ALONE
    assert probability(replace(GOOD, replicated=True), sure) > 0.999
    assert probability(replace(GOOD, other_motion=False), sure) == MOST_SAME
    for doubt in ("part_of_it", "doubted"):
        assert probability(replace(GOOD, replicated=True, **{doubt: True}), sure) == MOST_PART < 0.5


@pytest.mark.parametrize(("share", "odds"), [(0.5, 0.0), (0.75, 1.0986), (0.0, -6.0), (1.0, 6.0)])
def test_log_odds_are_bounded(share: float, odds: float) -> None:
    assert log_odds(share) == pytest.approx(odds, abs=1e-3)
