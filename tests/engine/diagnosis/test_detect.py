"""Detection raises false alarms at its level, and none is missed that stands clear."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binom, chi2, gamma, norm

from rths_engine.diagnosis.detect import Detection, _upper_tail, detect, left, null_misfits, p_planned, p_value
from rths_engine.diagnosis.fitting import Fitted, fit
from rths_engine.diagnosis.noise import Noise, coloured
from rths_engine.diagnosis.signatures import general, signatures
from tests.engine.diagnosis.made import SIGMA, Gain, Linear, Wave, drive, driven, linear, noisy, recordings

DRAWS, LEVEL = 200, 0.05


def detected(component: Linear, parts: list[Gain | Wave], seed: int, taken: float = SIGMA, count: int = 300) -> Detection:
    """Of white noise of deviation SIGMA that is taken for `taken`."""
    used = recordings(component, noisy(parts, seed, count=count), sigma=taken)
    fitted = fit(used, component.base)
    drawn = null_misfits(used, fitted, np.random.default_rng(seed))
    return detect(fitted, signatures(used, fitted), general(used, fitted), drawn)


def alarms(found: list[Detection]) -> int:
    return sum(one.p_value <= LEVEL for one in found)


def test_false_alarms_are_no_more_frequent_than_the_level() -> None:
    """The three tests share the level by Bonferroni: at most LEVEL, of 200 draws a binomial number; its 99.9 % bound."""
    found = [detected(linear(), [Gain(gain=2.05)], seed) for seed in range(DRAWS)]
    assert alarms(found) <= binom.ppf(0.999, DRAWS, LEVEL)
    for each in ("p_library", "p_general"):  # each alone is uniform where nothing was left out: no test is dead
        below = sum(getattr(one, each) <= 0.2 for one in found)
        assert binom.ppf(0.001, DRAWS, 0.2) <= below <= binom.ppf(0.999, DRAWS, 0.2)


@pytest.mark.parametrize("taken", [0.7 * SIGMA, 1.5 * SIGMA])
def test_noise_of_another_level_than_it_is_taken_for_raises_no_alarm(taken: float) -> None:
    found = [detected(linear(), [Gain(gain=2.05)], seed, taken) for seed in range(DRAWS // 2)]
    assert alarms(found) <= binom.ppf(0.999, DRAWS // 2, LEVEL)


def test_coloured_noise_raises_no_alarm_where_its_colour_is_known() -> None:
    """Without its colour, noise as slow as the drive is taken for physics."""
    keep = 0.95
    counted = []
    for seed in range(60):
        random = np.random.default_rng(seed)
        noise = np.zeros(1200)
        for place in range(1, 1200):
            noise[place] = keep * noise[place - 1] + 0.03 * random.standard_normal()
        noise = noise[600:]
        used = recordings(linear(), driven(2 * drive() + noise))
        used = replace(used, noises=(coloured([np.concatenate([noise, noise[::-1]])]),))
        fitted = fit(used, [Gain()])
        drawn = null_misfits(used, fitted, random)
        counted.append(detect(fitted, signatures(used, fitted), general(used, fitted), drawn))
    assert alarms(counted) <= binom.ppf(0.999, 60, LEVEL)


def test_an_effect_ten_standard_deviations_large_is_detected() -> None:
    size = 10 * SIGMA / np.sqrt(300 * 0.05)  # the cube beyond a line has a power of about 0.05
    found = detected(linear(), [Gain(), Wave(size=size, storey=1)], 1)
    assert found.p_value < 1e-6 and found.p_library < 1e-6 and found.largest == found.scores.max()


def test_what_only_a_general_law_holds_is_detected_without_any_effect() -> None:
    found = detected(linear(waves=0), [Gain(), Wave(size=0.5, storey=1)], 2)
    assert found.p_library == 1.0 and len(found.scores) == 0
    assert found.p_general < 1e-6 and found.explained > 10 * found.expected


def test_what_is_left_after_another_model_is_what_its_own_detection_says() -> None:
    used = recordings(linear(), noisy([Gain(), Wave(size=0.5, storey=4)], 21))
    plain, whole = fit(used, [Gain()]), fit(used, [Gain(), Wave(size=0.3, storey=4)])
    drawn = [null_misfits(used, one, np.random.default_rng(0)) for one in (plain, whole)]
    before = detect(plain, signatures(used, plain), general(used, plain), drawn[0])
    other = detect(whole, signatures(used, whole), general(used, whole), drawn[1])
    found = left(before, whole, general(used, whole), drawn[1])
    assert (found.p_general, found.explained, found.expected) == (other.p_general, other.explained, other.expected)
    assert found.largest == before.largest


def test_planned_numbers_beyond_their_tolerance_are_an_alarm_of_their_own() -> None:
    """z off by d / s: chi^2 of one number."""
    data = noisy([Gain(gain=2.1)], 3)
    fitted = fit(recordings(linear(share=0.01), data), [Gain()])
    off = (fitted.z[0] - 1) / 0.01
    of_data, of_plan = float(np.sum((2 * data.x / SIGMA) ** 2)), 1 / 0.01**2
    # by 5 % of the plan, less by what the plan weighs; four standard deviations of the noise
    assert off == pytest.approx(5 * of_data / (of_data + of_plan), abs=4 / 0.01 / np.sqrt(of_data))
    assert p_planned(fitted) == pytest.approx(chi2.sf(off**2, 1), rel=1e-9)
    assert p_planned(fit(recordings(linear(), noisy([Gain(gain=2.1)], 3)), [Gain()])) == 1.0


def test_the_p_value_counts_three_tests() -> None:
    one = Detection(np.zeros(0), 0.0, 0.02, 0.5, 0.7, 0.0, 0.0)
    assert one.p_value == pytest.approx(0.06)
    assert replace(one, p_library=0.9, p_general=0.8).p_value == 1.0


def test_a_score_that_replicates_reach_is_counted_among_them() -> None:
    null = np.arange(99.0)
    assert p_value(89.0, null) == pytest.approx(11 / 100)  # 89 to 98 reach it, and itself


def test_beyond_the_replicates_the_law_of_largest_values_goes_on_and_alarms_too_rarely_rather_than_too_often() -> None:
    """Of the largest of 30 normal numbers, beyond 4 by 30 * 2 * 3.2e-5: their tail falls faster than Gumbel's through 99."""
    many = np.abs(np.random.default_rng(4).standard_normal((9900, 30))).max(axis=1)
    found = [p_value(4.0, many[start : start + 99]) for start in range(0, 9900, 99)]
    true = 1 - (1 - 2 * norm.sf(4.0)) ** 30
    assert true < float(np.median(found)) < 6 * true


def test_a_squared_length_is_told_by_the_gamma_law_of_its_replicates() -> None:
    """Squared lengths of k normal numbers are chi^2 of k, a gamma law of shape k / 2 and scale 2."""
    null = np.random.default_rng(5).chisquare(6, 20_000)
    for length in (3.0, 12.0, 25.0):
        assert np.log(_upper_tail(length, null)) == pytest.approx(np.log(gamma.sf(length, 3, scale=2)), rel=0.05, abs=0.03)


def test_replicates_are_whole_recordings_of_the_noise() -> None:
    used = replace(recordings(linear(share=0.05), noisy([Gain()], 6)), noises=(Noise.white(SIGMA),))
    fitted: Fitted = fit(used, [Gain()])
    drawn = null_misfits(used, fitted, np.random.default_rng(7))
    assert drawn.shape == (99, fitted.samples + 1)  # and how far the planned number went
    assert np.std(drawn) == pytest.approx(1.0, abs=4 / np.sqrt(2 * drawn.size))
