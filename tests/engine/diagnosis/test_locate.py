"""Where a residual of known time, frequency and state is found."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.fitting import evaluated
from rths_engine.diagnosis.locate import BEYOND, Place, place
from rths_engine.foundation.arrays import Array
from tests.engine.diagnosis.made import DT, SIGMA, Gain, as_judged, drive, driven, linear, recordings, selected

COUNT = 2000
TIME = DT * np.arange(COUNT)
X = drive(COUNT)


def located(residual: Array, seed: int = 1) -> Place:
    """Of a residual beside noise, where the model is right otherwise."""
    noise = SIGMA * np.random.default_rng(seed).standard_normal(COUNT)
    used = recordings(linear(), driven(2 * X + residual + noise, X))
    model = evaluated(used, [Gain(gain=2.0)])
    return place(as_judged(selected(used, model, model)))


def test_noise_alone_is_nowhere() -> None:
    found = located(np.zeros(COUNT))
    assert found.times == [] and found.state == ""
    assert found.level == pytest.approx(1.0, abs=4 / np.sqrt(200))  # RMS of 100 samples; four standard deviations
    assert len(found.level) == len(found.middle) == 20 and found.middle[0] == pytest.approx(0.5)


def test_a_residual_of_a_while_is_found_to_the_second() -> None:
    burst = np.where((TIME >= 6.0) & (TIME < 9.0) | (TIME >= 15.0) & (TIME < 16.0), 5 * SIGMA, 0.0)
    found = located(burst)
    assert found.times == [pytest.approx((6.0, 9.0)), pytest.approx((15.0, 16.0))]
    inside = (found.middle > 6) & (found.middle < 9)
    assert found.level[inside] == pytest.approx(np.sqrt(26), rel=0.1)  # of 5 beside 1
    assert np.sqrt(26) > BEYOND


def test_a_residual_to_the_end_ends_with_the_recording() -> None:
    found = located(np.where(TIME >= 18.0, 10 * SIGMA, 0.0))
    assert found.times == [pytest.approx((18.0, 20.0))]


def test_nine_tenths_of_the_power_lie_in_the_band_of_a_sine() -> None:
    """Of 20 s the frequencies are 0.05 Hz apart."""
    found = located(50 * SIGMA * np.sin(2 * np.pi * 4.0 * TIME))
    assert found.bands == [pytest.approx((4.0, 4.0), abs=0.051)]
    two = located(50 * SIGMA * (np.sin(2 * np.pi * 1.0 * TIME) + np.sin(2 * np.pi * 9.0 * TIME)))
    assert two.bands == [pytest.approx((1.0, 9.0), abs=0.051)]


def test_a_recording_that_is_simulated_whole_has_no_band() -> None:
    used = recordings(linear(), driven(2 * X, X))
    model = evaluated(used, [Gain(gain=2.0)])
    assert place(as_judged(selected(used, model, model))).bands == []


@pytest.mark.parametrize(
    ("residual", "words"),
    [
        (10 * SIGMA * X**3, "grows with displacement"),
        (10 * SIGMA * np.exp(-((X / 0.2) ** 2)), "largest at small displacement"),
        (10 * SIGMA * np.tanh(np.gradient(X, DT) / 0.01), "changes sign with the velocity"),
        (10 * SIGMA * (1 + 2 * (np.gradient(X) > 0)), "depends on the sign of the velocity"),
    ],
    ids=["cubic", "small", "friction", "one way"],
)
def test_the_state_is_told_in_words(residual: Array, words: str) -> None:
    assert words in located(residual).state
