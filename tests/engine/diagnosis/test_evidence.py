"""Evidence and probabilities beside values computed by hand (decision 0021)."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rths_engine.diagnosis.components import Specimen
from rths_engine.diagnosis.evidence import MATERIAL, STRONG, probabilities, tempering, weighed
from rths_engine.diagnosis.fitting import Fitted
from rths_engine.diagnosis.free import numbers
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.specimen.coulomb_friction import CoulombFriction
from rths_engine.parts.specimens.linear import LinearSpecimen
from tests.engine.diagnosis.made import Gain, Wave, linear

SAMPLES = 1000
SEEN = [Seen(0.05, 0.3, 1e5, 10.0, 1e4, 0.01)] * 4


def model(squared: float, *waves: int) -> Fitted:
    """A gain and waves whose chi^2 is `squared`."""
    parts = (Gain(), *(Wave(size=0.1, storey=wave) for wave in waves))
    free = tuple(numbers(linear(), parts))
    misfit = np.full(SAMPLES, math.sqrt(squared / SAMPLES))
    return Fitted(parts, free, np.ones(len(free)), misfit, np.zeros((SAMPLES, len(free))), SAMPLES)


def test_equal_evidence_is_an_equal_chance() -> None:
    assert probabilities([7.0, 7.0, 7.0]) == pytest.approx([1 / 3] * 3, rel=1e-15)


def test_two_of_bic_apart_are_two_chances_in_e() -> None:
    """exp(0), exp(-1), exp(-3) over their sum, 1.417666."""
    assert probabilities([10.0, 12.0, 16.0]) == pytest.approx([0.705385, 0.259496, 0.035119], abs=1e-6)


def test_chances_sum_to_one_however_far_apart_the_models_are() -> None:
    found = probabilities([1e6, 0.0, 1e9])
    assert found == [0.0, 1.0, 0.0] and sum(found) == 1.0


def test_models_that_account_for_little_are_weighed_by_bic_itself() -> None:
    """300 = 6 / 0.02 is where 2 % of what effects account for reaches strong evidence: T is 1 until there."""
    before, plain, waved = model(1200.0).bic, model(1200.0), model(950.0, 1)
    assert before - waved.bic < STRONG / MATERIAL == pytest.approx(300.0)
    assert weighed([plain, waved], before, SEEN) == pytest.approx([plain.bic, waved.bic], rel=1e-12)


@pytest.mark.parametrize(("gain", "temper"), [(0.0, 1.0), (299.0, 1.0), (300.0, 1.0), (600.0, 2.0), (30_000.0, 100.0)])
def test_the_temper_is_a_fiftieth_of_the_gain_in_units_of_strong_evidence(gain: float, temper: float) -> None:
    assert tempering(-gain, 0.0) == pytest.approx(temper, rel=1e-12)


def test_of_much_that_is_accounted_for_two_percent_of_chi_squared_is_strong_evidence() -> None:
    """Two models of one number each; the best accounts for 60 000 of chi^2, so T = 200 and 1200 more are 6."""
    before = model(61_000.0)
    best, other = model(1000.0 + math.log(SAMPLES), 1), model(2200.0 + math.log(SAMPLES), 2)
    gain = before.bic - best.bic
    assert gain == pytest.approx(60_000.0 - 2 * math.log(SAMPLES), rel=1e-9)
    weights = weighed([best, other], before.bic, SEEN)
    assert weights[1] - weights[0] == pytest.approx(1200.0 / (MATERIAL * gain / STRONG), rel=1e-9)
    assert weights[0] == pytest.approx((1000.0 + math.log(SAMPLES)) / (0.02 * gain / 6) + 2 * math.log(SAMPLES), rel=1e-9)


def test_one_more_number_costs_the_logarithm_of_the_samples_whatever_the_temper() -> None:
    before = model(61_000.0).bic
    one, two = weighed([model(1000.0, 1), model(1000.0, 1, 2)], before, SEEN)
    assert two - one == pytest.approx(math.log(SAMPLES), rel=1e-9)


def test_numbers_that_are_unlikely_beforehand_add_the_square_of_their_logarithm() -> None:
    """Friction that builds up over twice what is common of the stroke: (ln 2 / 0.5)^2 = 1.92."""
    spring = LinearSpecimen(stiffness=2e6, damping=3e5)
    component = Specimen("specimen:1", (spring,))

    def of(presliding: float) -> Fitted:
        parts = (spring, CoulombFriction(friction=1e3, presliding=presliding))
        free = tuple(numbers(component, parts))
        return Fitted(parts, free, np.ones(len(free)), np.ones(SAMPLES), np.zeros((SAMPLES, len(free))), SAMPLES)

    common = 0.02 * SEEN[0].x
    slow, usual = weighed([of(2 * common), of(common)], 0.0, SEEN)
    assert slow - usual == pytest.approx((math.log(2) / 0.5) ** 2, rel=1e-9)
