"""Physics of the compensators that begin with a model of the actuator, against closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.second_order import SecondOrderActuator
from rths_engine.parts.compensators.actuator_model import ActuatorModel, fields_for
from rths_engine.parts.compensators.amb import AdaptiveModelBased
from rths_engine.parts.compensators.compensator import TransferSystem
from rths_engine.parts.compensators.kalman import KalmanPredictor
from rths_engine.parts.compensators.loop_shaping import Linear, robust_controller
from rths_engine.parts.compensators.robust import RobustIntegratedControl
from rths_engine.parts.compensators.two_stage import TwoStageAdaptive
from tests.engine.test_parts_compensators import DT, UNLIMITED, compensated, sine, tracked

MODEL = {"delay": 0.02, "frequency": 18.0, "damping_ratio": 0.8}


def tones(seconds: float, seed: int = 5) -> np.ndarray:
    """Eight tones between 0.3 and 3 Hz that rise within a second, about 10 mm."""
    t = np.arange(1, round(seconds / DT) + 1) * DT
    phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, 8)
    motion = np.sin(2 * np.pi * np.outer(t, np.linspace(0.3, 3.0, 8)) + phases).sum(axis=1)
    return np.asarray(0.006 * motion * np.minimum(t, 1) ** 2)


def response(model: ActuatorModel, s: complex) -> complex:
    second = 1 + 2 * model.damping_ratio * s / model.omega + s**2 / model.omega**2
    return complex(model.gain * np.exp(-s * model.dead_time) / second)


def error(measured: np.ndarray, x: np.ndarray, after: int) -> float:
    return float(np.sqrt(np.sum((measured - x)[after:] ** 2) / np.sum(x[after:] ** 2)))


def test_the_series_of_the_inverse_times_the_model_is_one_up_to_the_fourth_order() -> None:
    model = ActuatorModel.of(AdaptiveModelBased(gain=0.9, **MODEL))
    wrong = []
    for s in (2j, 4j, 8j):
        wrong.append(abs(np.polyval(model.inverse()[::-1], s) * response(model, s) - 1))
    assert np.log2(np.divide(wrong[1:], wrong[:-1])) == pytest.approx(4.0, abs=0.1)


@pytest.mark.parametrize("delay", [0.0, 0.005, 0.02])
def test_a_model_always_has_the_delay_of_its_field(delay: float) -> None:
    model = ActuatorModel.of(AdaptiveModelBased(delay=delay, frequency=15.0, damping_ratio=0.9))
    assert model.dead_time + 2 * model.damping_ratio / model.omega == pytest.approx(delay)
    assert model.dead_time >= 0


def test_the_model_of_a_transfer_system_has_its_inverse_up_to_the_acceleration() -> None:
    system = TransferSystem((2.1e4,), (1.0, 140.0, 2e4), rate=1024.0, step=DT, displacement=0.01, velocity=0.1)
    found = ActuatorModel.of(AdaptiveModelBased(**fields_for(system))).inverse()
    assert found == pytest.approx(system.inverse(3), rel=1e-9, abs=1e-7)  # a system of second order has no dead time


def test_the_model_of_a_transfer_system_stays_within_the_bounds_of_the_fields() -> None:
    nearly_undamped = TransferSystem((1.0,), (1e-4, 1e-7, 1.0), rate=1024.0, step=DT, displacement=0.01, velocity=0.1)
    assert KalmanPredictor.tuned_for(nearly_undamped).damping_ratio >= 0.01


def test_amb_without_adaptation_inverts_its_model_to_the_order_of_its_differences() -> None:
    actuator = SecondOrderActuator(frequency=18.0, damping_ratio=0.8, dead_time=0.0, **UNLIMITED)
    errors = []
    for dt in (1 / 512, 1 / 1024, 1 / 2048):
        x = sine(0.02, 1.0, dt=dt) ** 2 / 0.02  # starts smoothly
        part = AdaptiveModelBased(delay=1.6 / (36 * np.pi), frequency=18.0, damping_ratio=0.8, rate=0.0, derivative_step=dt)
        errors.append(np.max(np.abs(tracked(part, actuator, x, dt)[0] - x)))
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(1.0, abs=0.15)  # backward differences


def test_the_gradient_of_amb_moves_its_amplitude_at_its_closed_rate() -> None:
    """On a constant command c and displacement y only b0 moves: b0' = g y^3 (c - y) b0 / (e^2 + y^2)^2."""
    part = AdaptiveModelBased(delay=0.0, rate=5.0, threshold=1e-3, gain_range=0.9, cutoff=1000.0)
    p, s = part.build(DT)
    sent = [part.step(p, s, 0.0105, 0.0105, 0.01, 0.0, DT) for _ in range(1024)]
    rate = 5.0 * 0.01**3 * 0.0005 / (1e-6 + 1e-4) ** 2
    assert math.log(sent[-1] / sent[511]) / (512 * DT) == pytest.approx(rate, rel=5e-3)  # the filters lag by 0.3 ms


@pytest.mark.parametrize("part", [AdaptiveModelBased(), TwoStageAdaptive()], ids=["amb", "two_stage"])
@pytest.mark.parametrize("alpha", [15, 45])
def test_adaptive_compensators_track_an_actuator_from_a_wrong_delay(part: Any, alpha: int) -> None:
    x = tones(4.0)
    actuator = FirstOrderDelay(alpha=alpha, **UNLIMITED)
    measured, _ = tracked(part, actuator, x)
    held = {"rate": 0.0} if isinstance(part, AdaptiveModelBased) else {"memory": 1000.0, "noise": 1.0}
    fixed, _ = tracked(part.model_copy(update=held), actuator, x)
    assert error(measured, x, 2048) < min(0.015, 0.15 * error(fixed, x, 2048))


@pytest.mark.parametrize("part", [AdaptiveModelBased(), TwoStageAdaptive(noise=1e-3)], ids=["amb", "two_stage"])
def test_adaptive_compensators_hold_their_start_values_at_rest(part: Any) -> None:
    _, adapted = tracked(part, FirstOrderDelay(alpha=50), sine(1e-7, 1.0))
    assert np.max(np.abs(adapted)) < 1e-3


def test_the_fine_stage_is_the_least_squares_with_its_start_as_a_prior() -> None:
    """The Kalman filter of constant coefficients minimises |u - Phi b|^2 / r^2 + (b - b0)' G0^-1 (b - b0)."""
    part = TwoStageAdaptive(delay=0.02, share=0.0, noise=2e-3, memory=1000.0, cutoff=1000.0, gain_range=0.9)
    x = tones(1.0)
    measured = 0.97 * np.interp(np.arange(len(x)) - 25.0, np.arange(len(x)), x, left=0.0)
    p, s = part.build(DT)
    smooth, low = np.zeros((len(x), 2)), np.zeros((2, 2))
    share = 1 - math.exp(-2 * math.pi * 1000.0 * DT)
    for q in range(1, len(x)):
        low[0] += share * (np.array([measured[q - 1], x[q - 1]]) - low[0])
        low[1] += share * (low[0] - low[1])
        smooth[q] = low[1]
        s[2] = x[q - 1]  # the command that it sent, here prescribed
        part.step(p, s, x[q], 0.0, measured[q - 1], 0.0, DT)
    y, u = smooth.T
    pace, h = 2 * np.pi, 10
    late = [np.concatenate([np.zeros(k * h), y[: len(y) - k * h]]) for k in (1, 2)]
    scale = 1 / (pace * h * DT)
    phi = np.column_stack([y, (1.5 * y - 2 * late[0] + 0.5 * late[1]) * scale, (y - 2 * late[0] + late[1]) * scale**2])
    reach = 0.06 * pace
    prior = np.diag(1 / np.array([0.81, reach**2, reach**4 / 4])) * part.noise**2
    start = np.array([1.0, 0.02 * pace, 0.0])
    expected = np.linalg.solve(phi.T @ phi + prior, phi.T @ u + prior @ start)
    assert s[7:10] == pytest.approx(expected, rel=0.01, abs=0.003)  # forgets 0.1 % in this second


def test_the_coarse_stage_removes_a_pure_delay_and_leaves_nothing_to_the_fine_stage() -> None:
    part = TwoStageAdaptive(delay=20 * DT, share=1.0)
    ramp = 0.1 * np.arange(1, 1025) * DT
    late = np.concatenate([np.zeros(20), compensated(part, ramp)[:-20]])
    assert late[100:] == pytest.approx(ramp[100:], rel=1e-12)


@pytest.mark.parametrize("frequency", [0.7, 3.0])
def test_the_kalman_predictor_inverts_its_model_exactly_at_the_frequency_of_the_response(frequency: float) -> None:
    part = KalmanPredictor(gain=0.95, response_frequency=frequency, **MODEL)
    model = ActuatorModel.of(part)
    t = np.arange(1, 3 * 1024 + 1) * DT
    s = 2j * np.pi * frequency
    sent = compensated(part, 0.01 * np.sin(2 * np.pi * frequency * t) + 0.002)
    expected = (0.01 * np.exp(s * t) / response(model, s)).imag + 0.002 / model.gain
    assert sent[2048:] == pytest.approx(expected[2048:], abs=1e-9)


def test_a_constant_acceleration_is_predicted_exactly() -> None:
    part = KalmanPredictor(delay=0.02, frequency=1000.0, damping_ratio=0.5, response_frequency=0.0)
    model = ActuatorModel.of(part)
    t = np.arange(1, 2049) * DT
    path = np.polynomial.Polynomial([0.01, 0.2, -0.3])
    inverse = (
        path(t + model.dead_time) + 1.0 / model.omega * path.deriv()(t + model.dead_time) + path.deriv(2)(t) / model.omega**2
    )
    assert compensated(part, path(t))[1024:] == pytest.approx(inverse[1024:], rel=1e-9)


def test_the_kalman_filter_of_constant_acceleration_has_the_poles_of_butterworth() -> None:
    dt, bandwidth = 1e-4, 10.0
    p, _ = KalmanPredictor(response_frequency=0.0, bandwidth=bandwidth).build(dt)
    move, gain = p[:9].reshape(3, 3), p[9:12]
    poles = np.log(np.linalg.eigvals((np.eye(3) - np.outer(gain, [1.0, 0.0, 0.0])) @ move)) / dt / (2 * np.pi * bandwidth)
    assert np.sort_complex(poles) == pytest.approx(np.sort_complex(np.exp(1j * np.pi * np.array([2, 3, 4]) / 3)), abs=0.01)


@pytest.mark.parametrize("pole", [0.0, 0.5, 3.0])
def test_the_least_gamma_of_a_lag_has_its_closed_form(pole: float) -> None:
    """For 1 / (s + a): X = Z = sqrt(a^2 + 1) - a and gamma_min^2 = 1 + X^2."""
    _, gamma = robust_controller(Linear(np.array([[-pole]]), np.eye(1), np.eye(1)))
    assert gamma / 1.1 == pytest.approx(math.sqrt(1 + (math.sqrt(pole**2 + 1) - pole) ** 2))


def test_the_loop_of_the_controller_has_a_norm_below_gamma() -> None:
    """The norm of [K; 1] (1 + G K)^-1 [1, G] is sqrt((1 + |K|^2) (1 + |G|^2)) / |1 + G K| for one input and one output."""
    plant = Linear(np.array([[0.0, 1.0], [-400.0, -8.0]]), np.array([[0.0], [900.0]]), np.array([[1.0, 0.0]]))
    controller, gamma = robust_controller(plant)
    size = []
    for omega in np.geomspace(1e-2, 1e4, 400):
        g, k = plant.at(1j * omega), controller.at(1j * omega)
        size.append(math.sqrt((1 + abs(k) ** 2) * (1 + abs(g) ** 2)) / abs(1 + g * k))
    assert gamma / 1.1 <= 1.02 * max(size)
    assert max(size) <= gamma * (1 + 1e-9)


def test_the_bilinear_transformation_keeps_the_response_at_the_warped_frequency() -> None:
    system = Linear(np.array([[-30.0, 5.0], [-5.0, -2.0]]), np.array([[1.0], [2.0]]), np.array([[1.0, 0.5]]), 0.3)
    sampled = system.sampled(0.01)
    z = np.exp(0.4j)
    assert sampled.at(z) == pytest.approx(system.at(2j / 0.01 * math.tan(0.2)))


def test_robust_control_removes_the_lag_that_its_feed_forward_leaves_on_a_ramp() -> None:
    ramp = 0.1 * np.arange(1, 3 * 1024) * DT
    actuator = FirstOrderDelay(alpha=30, **UNLIMITED)  # it lags 29 steps
    left = {}
    for bandwidth, trust in ((2.0, 10.0), (4.0, 10.0), (4.0, 100.0)):
        measured, _ = tracked(RobustIntegratedControl(delay=24 * DT, bandwidth=bandwidth, trust=trust), actuator, ramp)
        left[bandwidth, trust] = (ramp - measured)[-1] / (5 * 0.1 * DT)
    # the integral removes the lag of the estimate; the estimate keeps a share of the model's error, whatever the bandwidth
    assert left[2.0, 10.0] == pytest.approx(left[4.0, 10.0], rel=1e-3)
    assert abs(left[4.0, 100.0]) < 0.01 < abs(left[4.0, 10.0]) < 0.1


@pytest.mark.parametrize("wrong", [0.7, 1.0, 1.4])
def test_robust_control_is_stable_around_an_actuator_that_is_off_its_model(wrong: float) -> None:
    actuator = SecondOrderActuator(frequency=15.0 * wrong, damping_ratio=0.9, dead_time=0.009 / wrong, **UNLIMITED)
    x = np.where(np.arange(2048) < 8, 1e-3, 0.0)
    measured, _ = tracked(RobustIntegratedControl(bandwidth=5.0), actuator, x)
    assert np.max(np.abs(measured[-256:])) < 1e-6


def test_settings_for_a_transfer_system_keep_gamma_at_two() -> None:
    system = TransferSystem((1.0,), (1e-6, 3e-4, 3e-2, 1.0), rate=1024.0, step=DT, displacement=0.01, velocity=0.1)
    part = RobustIntegratedControl.tuned_for(system)
    assert part.controller(DT)[1] == pytest.approx(2.0, abs=0.01)
