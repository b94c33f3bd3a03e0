"""Frequency evaluation index, delay by cross-correlation, relative errors and energies on signals whose answer is known."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.arrays import Array
from rths_engine.planning.model import Model
from rths_engine.results import metrics
from rths_engine.results.channels import FLOORS, INPUTS, columns
from rths_engine.results.measured import of_station
from rths_engine.results.signals import StationSignals
from rths_engine.running.run import Run
from tests.engine.plans import building, completed, make, shaking

DT = 1 / 1024
TIME = np.arange(8192) * DT
ROUNDING = 1e-9  # of sums over 8192 samples
UNMOVED = np.zeros(500)


def tones(parts: list[tuple[float, float, float]], time: Array = TIME) -> Array:
    """Sum of sines: amplitude (m), frequency (Hz) and phase lag."""
    return np.asarray(np.sum([a * np.sin(2 * np.pi * f * time - phase) for a, f, phase in parts], axis=0))


@pytest.mark.parametrize(("amplitude", "delay"), [(0.9, 0.03), (1.1, -0.012), (1.0, 0.0)])
def test_fei_gives_amplitude_and_delay_of_a_scaled_late_sine_back(amplitude: float, delay: float) -> None:
    x_cmd, x_meas = tones([(0.02, 1.5, 0.0)]), tones([(0.02 * amplitude, 1.5, 2 * np.pi * 1.5 * delay)])
    found = metrics.frequency_evaluation(x_cmd, x_meas, DT)
    assert found == pytest.approx((amplitude, delay), abs=ROUNDING)


def test_fei_of_two_tones_weighs_each_by_its_power() -> None:
    x_cmd = tones([(0.02, 1.0, 0.0), (0.01, 4.0, 0.0)])
    x_meas = tones([(0.02 * 0.95, 1.0, 0.1), (0.01 * 0.7, 4.0, 0.8)])
    index = (4 * 0.95 * np.exp(-0.1j) + 0.7 * np.exp(-0.8j)) / 5
    expected = abs(index), -np.angle(index) / (2 * np.pi * (4 * 1.0 + 4.0) / 5)
    assert metrics.frequency_evaluation(x_cmd, x_meas, DT) == pytest.approx(expected, abs=ROUNDING)


def test_an_offset_of_the_measured_displacement_leaves_fei_alone() -> None:
    x_cmd = tones([(0.02, 2.0, 0.0)])
    assert metrics.frequency_evaluation(x_cmd, x_cmd + 0.01, DT) == pytest.approx((1.0, 0.0), abs=ROUNDING)


@pytest.mark.parametrize("shift", [0, 1, 37, -20])
def test_correlation_finds_the_known_shift_of_a_random_signal(shift: int) -> None:
    noise = np.random.default_rng(5).standard_normal(6000)
    x_cmd, x_meas = noise[100:5000], noise[100 - shift : 5000 - shift]
    # the parabola through white noise's single peak leans by its neighbours, 3 standard deviations of 1/sqrt(4900)
    assert metrics.correlation_delay(x_cmd, x_meas, DT) == pytest.approx(shift * DT, abs=3 / np.sqrt(4900) / 2 * DT)


def test_correlation_finds_a_delay_between_samples() -> None:
    delay = 12.34 * DT
    envelope = np.exp(-(((TIME - 4) / 1.0) ** 2))
    late = np.exp(-(((TIME - delay - 4) / 1.0) ** 2))
    x_cmd, x_meas = envelope * tones([(1.0, 3.0, 0.0)]), late * tones([(0.8, 3.0, 0.0)], TIME - delay)
    # the parabola's error over the step is at most (2 pi f dt)^2 / 24, here 1.4e-5
    assert metrics.correlation_delay(x_cmd, x_meas, DT) == pytest.approx(delay, abs=2e-5 * DT)


def test_a_delay_longer_than_the_lags_searched_has_no_value() -> None:
    noise = np.random.default_rng(5).standard_normal(6000)
    smooth = np.convolve(noise, np.ones(600) / 600, "same")
    assert metrics.correlation_delay(smooth[400:5000], smooth[0:4600], DT) is None


def test_relative_errors_by_hand() -> None:
    x_cmd, x_meas = np.array([3.0, -1.0, 0.0]), np.array([2.0, -1.0, 2.0])
    assert metrics.normalised_rms(x_cmd, x_meas) == pytest.approx(np.sqrt(5 / 3) / 4)
    assert metrics.peak_error(x_cmd, x_meas) == pytest.approx(2 / 3)


@pytest.mark.parametrize("x_cmd", [UNMOVED, UNMOVED[:0]])
def test_a_command_that_never_moved_has_no_relative_measure(x_cmd: Array) -> None:
    shown = of_station(StationSignals({"x_cmd": x_cmd, "x_meas": x_cmd + 1e-6, "f_meas": x_cmd}, DT))
    beyond = {"fei_delay_ms", "fei_amplitude", "nrms_percent", "peak_error_percent", "delay_ms", "energy_error_percent"}
    beyond |= {"reference_rms_percent", "reference_peak_percent"}  # these signals have no reference
    without = {name for name, value in shown.items() if value is None}
    assert without == beyond if len(x_cmd) else without >= beyond  # of no sample, other measures may have no value either


def test_signals_beyond_every_bound_have_no_measure_and_no_warning() -> None:
    wild = tones([(1e300, 2.0, 0.0)])
    shown = of_station(StationSignals({"x_cmd": wild, "x_meas": -wild, "f_meas": wild}, DT))
    assert shown["fei_amplitude"] is None and shown["nrms_percent"] is None


def test_input_energy_of_a_constant_acceleration_is_force_times_way() -> None:
    mass, ground, way = 2000.0, np.full((50, 1), -3.0), np.linspace(0.01, 0.5, 50)[:, None]
    energy = metrics.input_energy(np.array([[-mass]]), ground, way, np.zeros(1))
    assert energy == pytest.approx(mass * 3.0 * way[:, 0])


def swaying(**more: Any) -> Run:
    """A two-storey building without damping on a ground that shakes with its first frequency."""
    ground = 2.0 * np.sin(2 * np.pi * 0.9 * np.arange(0, 5, 0.01))
    return completed(make(building([5e5, 4e5], [3e7, 2e7]), shaking(ground, 0.01), 0.001, **more))


def test_input_energy_is_what_the_undamped_structure_holds_at_the_end() -> None:
    run = swaying()
    result, built = run.result("completed", 0.0), run.plan.structure.assemble()
    x, v = result.history[-2, 0], result.history[-2:, 1].mean(axis=0)  # CR's v is half a step behind its x
    held = 0.5 * v @ built.mass @ v + 0.5 * x @ built.stiffness @ x
    energy = metrics.input_energy(*energies(run))
    # (omega dt)^2 / 4 of the second mode, omega = 11.2 rad/s, by which CR's energy may differ from the structure's
    assert energy[-2] == pytest.approx(held, rel=4e-5)
    assert result.summary()["input_energy_kNm"] == pytest.approx(energy.max() / 1e3)


def energies(run: Run) -> tuple[Array, Array, Array, Array]:
    loads = run.model.floor_loads
    assert loads is not None
    inputs, floors = (run.signals[:, columns(run.channels, *roles)] for roles in (INPUTS, FLOORS))
    return loads, inputs, floors, run.history[0, 0]


def test_mass_that_the_ground_moves_off_the_floors_leaves_the_input_energy_unknown() -> None:
    matrices = {"kind": "matrices", "mass": [[1e5, 0], [0, 1e5]], "stiffness": [[4e7, -2e7], [-2e7, 2e7]], "floors": [2]}
    partly = make({**matrices, "influence": [1.0, 1.0]}, shaking(np.ones(20), 0.01), 0.01)
    wholly = make({**matrices, "influence": [0.0, 1.0]}, shaking(np.ones(20), 0.01), 0.01)
    assert Model(partly).floor_loads is None
    assert completed(partly).result("completed", 0.0).summary()["input_energy_kNm"] is None
    assert Model(wholly).floor_loads is not None


def test_the_energy_error_counts_every_damper_of_the_station_and_keeps_its_sign() -> None:
    assert metrics.energy_error_ratio(-2.0, 3, 12.0) == -0.5
    assert metrics.energy_error_ratio(-2.0, 3, 0.0) is None
    assert metrics.energy_error_ratio(-2.0, 3, None) is None
