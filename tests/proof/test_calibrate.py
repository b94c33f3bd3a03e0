"""The calibration of probabilities, the reliability of claims, and the certificate."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.proof import certificate, drawing
from tests.proof.calibrate import SIGNS, chosen, table, weights
from tests.proof.summary import calibration, reliability

RANDOM = np.random.default_rng(1)


def test_the_cases_all_conceal_something_and_a_fifth_lies_outside_the_library() -> None:
    found = chosen(100, 5)
    assert all(spec.level != "clean" for spec in found)
    outside = sum(spec.level == "outside" for spec in found)
    assert outside >= 0.2 * len(found)


def test_the_map_recovers_odds_that_facts_make_and_keeps_the_signs() -> None:
    facts = RANDOM.normal(size=(4000, 7))
    true = np.array([0.5, 1.0, 0.5, 0.3, -1.0, -0.5, -2.0, 0.7])
    rows = [(1.0, *fact) for fact in facts]
    right = RANDOM.random(4000) < 1 / (1 + np.exp(-np.array(rows) @ true))
    found = weights(list(zip(rows, map(bool, right), strict=True)))
    assert found == pytest.approx(true, abs=0.2)
    assert all(sign * weight >= 0 for sign, weight in zip(SIGNS, found, strict=True))


def test_a_fact_that_says_the_opposite_gets_no_weight() -> None:
    facts = [(1.0, *fact) for fact in RANDOM.normal(size=(500, 7))]
    found = table([(fact, fact[6] > 0) for fact in facts], 10, 3)["weights"]
    assert found["unexplained"] == 0.0


def rows() -> list[dict[str, Any]]:
    """Ten claims at 0.95, nine of them right; ten at 0.45, four of them right."""
    said = [(0.95, place < 9) for place in range(10)] + [(0.45, place < 4) for place in range(10)]
    base = {"kind": "specimen", "false_alarm": None, "lambda": 200.0, "named_first": True}
    clean = {"kind": "specimen", "false_alarm": False, "lambda": None, "named_first": None, "claims": []}
    claims = [{"name": "specimen:1/backlash", "probability": p, "right": right} for p, right in said]
    return [{**base, "claims": [one]} for one in claims] + [clean]


def test_reliability_is_the_share_that_is_right_by_tenths_of_the_probability() -> None:
    tenths = {one["from"]: one for one in reliability(rows())}
    assert tenths[0.9]["value"] == 0.9 and tenths[0.9]["count"] == 10
    assert tenths[0.4]["value"] == 0.4 and tenths[0.1]["count"] == 0
    assert calibration(rows())["value"] == pytest.approx(0.05)
    picture = drawing.reliability({"reliability": reliability(rows())})
    assert picture.count("<circle") == 2 and picture.startswith("<svg")


def test_the_certificate_counts_false_discoveries_false_alarms_and_power_of_each_kind() -> None:
    found = certificate.certificate(rows(), 21, 9)["kinds"]["specimen"]
    assert found["false_discovery"]["value"] == pytest.approx(7 / 20) and found["false_alarm"]["count"] == 1
    assert found["power"][">=100"]["value"] == 1.0 and found["power"]["<10"]["count"] == 0
