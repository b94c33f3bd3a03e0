"""What all components share: bands, finer steps and the keys of hypotheses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.components.component import REPLAY_RATE, key
from rths_engine.parts.physics.sensor.offset import DisplacementOffset, ForceOffset
from rths_engine.parts.physics.specimen.backlash import Backlash
from tests.engine.diagnosis.made import DT, Driven, Gain, Wave, drive, driven, linear


def of_rate(rate: float, stepped: bool = False, count: int = 2000) -> Driven:
    x = np.sin(2 * np.pi * 0.9 * np.arange(count) / rate)
    return Driven(1 / rate, 3.0, stepped, x, x)


def test_the_output_is_compared_in_the_band_from_the_start_on() -> None:
    data = of_rate(1024)
    assert data.measured.shape == (1, 250) and data.step == pytest.approx(8 / 1024)
    assert data.time[0] == 3.0 and data.time[1] - data.time[0] == pytest.approx(data.step)


@pytest.mark.parametrize(("rate", "finer"), [(100, 11), (512, 2), (1024, 1), (2048, 1)])
def test_measured_signals_are_replayed_at_a_thousand_steps_a_second_and_more(rate: int, finer: int) -> None:
    data = of_rate(rate)
    assert data.finer == finer and data.finer * rate >= REPLAY_RATE - 1e-6
    assert replace(data, stepped=True).finer == 1


def test_a_signal_is_refined_a_quarter_of_a_step_ahead_by_a_cubic_spline() -> None:
    """Places (k + 1/4) / n; a cubic spline of 111 samples a period errs by some 5 / 384 (2 pi / 111)^4 = 1e-7."""
    data = of_rate(100)
    fine = data.refined(data.x)
    places = (np.arange(len(fine)) + 0.25) / data.finer
    inside = places < len(data.x) - 2
    assert fine[inside] == pytest.approx(np.sin(2 * np.pi * 0.9 * places[inside] / 100), abs=2e-6)  # not-a-knot at the ends
    assert np.all(data.places(10)[-3:] <= 9)


def test_steps_of_a_run_are_taken_as_they_are() -> None:
    data = of_rate(100, stepped=True)
    assert data.refined(data.x) is data.x


def test_effects_of_one_kind_and_storey_are_one_hypothesis() -> None:
    assert key(Wave(size=1.0, storey=2)) == key(Wave(size=-3.0, storey=2)) != key(Wave(size=1.0, storey=3))
    assert key(Backlash(gap=0.001)) == (Backlash, 0)
    model = [Gain(), Wave(storey=2), Wave(storey=4)]
    assert linear().present(model) == {(Wave, 2), (Wave, 4)}


def test_an_effect_of_a_sensor_is_of_the_channel_it_reads() -> None:
    component = linear()
    assert component.place(DisplacementOffset(error=1e-3)) == "sensor:x_meas.1"
    assert component.place(ForceOffset(error=1.0)) == "sensor:f_meas.1"
    assert component.place(Wave()) == "specimen:1" and component.station == "1"


def test_data_that_know_nothing_of_their_input_are_not_redrawn() -> None:
    data = driven(drive())
    assert data.input_noise == 0 and data.pressed == 0 and data.step_error is None
    assert data.redrawn(np.random.default_rng(1)) is data and data.thinned() is data and data.behind() is data
    assert data.dt == DT
