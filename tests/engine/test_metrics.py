"""Measures on signals whose answer is known by hand."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.results import metrics


def test_tracking_error_measures_of_a_hand_made_signal() -> None:
    x_cmd, x_meas = np.array([3.0, -4.0, 0.0]), np.array([2.0, -4.0, 2.0])
    assert metrics.maximum_tracking_error(x_cmd, x_meas) == 2.0
    assert metrics.rms_tracking_error(x_cmd, x_meas) == pytest.approx(np.sqrt(5 / 25))


def test_rms_of_a_command_that_never_moved_is_zero() -> None:
    assert metrics.rms_tracking_error(np.zeros(5), np.ones(5)) == 0.0


@pytest.mark.parametrize("phase", [-0.3, 0.05, 0.5])
def test_tracking_indicator_of_two_sines_grows_by_pi_a_squared_sine_phase_a_cycle(phase: float) -> None:
    amplitude, cycles, samples = 0.02, 5, 4000
    angle = np.linspace(0, 2 * np.pi * cycles, cycles * samples + 1)
    x_cmd, x_meas = amplitude * np.sin(angle), amplitude * np.sin(angle - phase)
    # from rest to the first measured sample adds at most amplitude^2 / 2, the same for every cycle counted
    indicator = metrics.tracking_indicator(x_cmd, x_meas)
    per_cycle = np.diff(indicator[::samples])
    assert per_cycle == pytest.approx(np.pi * amplitude**2 * np.sin(phase), rel=1e-5)  # trapezoidal rule, (2 pi / 4000)^2 / 6


def test_energy_error_of_a_lagging_actuator_is_negative_and_by_hand() -> None:
    # the command moves 2 at once and stays, the piston follows one sample later against a force of 10
    x_cmd, x_meas, force = np.array([2.0, 2.0]), np.array([0.0, 2.0]), np.array([10.0, 10.0])
    energy = metrics.energy_error(x_cmd, x_meas, force)
    assert energy == pytest.approx([0.5 * 10 * 2, 0.5 * 10 * 2 - 10 * 2])


def test_signed_peak_keeps_the_sign() -> None:
    assert metrics.signed_peak(np.array([1.0, -3.0, 2.0])) == -3.0
    assert metrics.signed_peak(np.array([])) == 0.0
