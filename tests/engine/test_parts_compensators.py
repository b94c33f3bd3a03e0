"""Physics of the compensators: what each makes up for exactly, and what it leaves."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.second_order import SecondOrderActuator
from rths_engine.parts.compensators.ats import AdaptiveTimeSeries
from rths_engine.parts.compensators.derivative import DerivativeFeedForward
from rths_engine.parts.compensators.dual import DualCompensation
from rths_engine.parts.compensators.inverse import InverseCompensation
from rths_engine.parts.compensators.phase_lead import PhaseLead
from rths_engine.parts.compensators.polynomial import PolynomialExtrapolation

DT = 1 / 1024
UNLIMITED = {"velocity_limit": 10.0, "force_limit": 1e8}


def compensated(part: Any, x: np.ndarray, measured: np.ndarray | None = None, dt: float = DT) -> np.ndarray:
    """Compensated commands of a path from rest at 0; `measured` is what the sensor read in each substep."""
    parameters, state = part.build(dt)
    x_meas = np.zeros_like(x) if measured is None else measured
    last, meas_last = np.concatenate([[0.0], x[:-1]]), np.concatenate([[0.0], x_meas[:-1]])
    return np.array([part.step(parameters, state, *given, 0.0, dt) for given in zip(x, last, meas_last, strict=True)])


def tracked(compensator: Any, actuator: Any, x: np.ndarray, dt: float = DT) -> tuple[np.ndarray, np.ndarray]:
    """Measured displacement in the loop of compensator and actuator, and the recorded d_alpha."""
    (p, s), (pa, sa) = compensator.build(dt), actuator.build(dt)
    measured, adapted, last, moved = [], [], 0.0, 0.0
    for command in x:
        moved = actuator.step(pa, sa, compensator.step(p, s, command, last, moved, 0.0, dt), 0.0)
        last = command
        measured.append(moved)
        adapted.append(s[0])
    return np.array(measured), np.array(adapted)


def sine(amplitude: float, seconds: float, frequency: float = 1.0, dt: float = DT) -> np.ndarray:
    return np.asarray(amplitude * np.sin(2 * np.pi * frequency * np.arange(1, round(seconds / dt) + 1) * dt))


def test_dual_compensation_without_gain_is_inverse_compensation() -> None:
    x, measured = sine(0.02, 0.5), sine(0.01, 0.5)
    inverse = compensated(InverseCompensation(alpha_es=20), x)
    assert compensated(DualCompensation(alpha_es=20, kp=0.0), x, measured) == pytest.approx(inverse, abs=1e-15)


@pytest.mark.parametrize("alpha_es", [10.0, 45.0])
def test_dual_compensation_divides_the_error_of_a_wrong_estimate_by_one_plus_its_gain(alpha_es: float) -> None:
    ramp = 0.1 * np.arange(1, 2049) * DT
    measured, _ = tracked(DualCompensation(alpha_es=alpha_es, kp=3.0), FirstOrderDelay(alpha=30), ramp)
    assert (ramp - measured)[-1] == pytest.approx((30 - alpha_es) / 4.0 * 0.1 * DT, rel=1e-6)


def test_dual_compensation_is_stable_up_to_twice_alpha_less_one() -> None:
    growth = {}
    for kp in (8.9, 9.1):  # the limit is 2 * 5 - 1 = 9
        actuator = FirstOrderDelay(alpha=5, velocity_limit=10.0)
        measured, _ = tracked(DualCompensation(alpha_es=4, kp=kp), actuator, np.full(200, 1e-6))
        moves = np.abs(np.diff(measured))
        growth[kp] = moves[-1] / moves[0]
    assert growth[8.9] < 0.1 and growth[9.1] > 10


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("delay", [29 / 1024, 0.0123, 0.0])
def test_polynomial_extrapolation_is_exact_on_polynomials_of_its_order(order: int, delay: float) -> None:
    polynomial = np.polynomial.Polynomial([0.01, 0.2, -0.5, 0.8][: order + 1])
    t = np.arange(1, 513) * DT
    ahead = compensated(PolynomialExtrapolation(order=order, delay=delay), polynomial(t))
    assert ahead[100:] == pytest.approx(polynomial(t + delay)[100:], rel=1e-9)


@pytest.mark.parametrize(("order", "weights"), [(1, [2, -1]), (2, [3, -3, 1]), (3, [4, -6, 4, -1])])
def test_polynomial_extrapolation_has_the_published_weights(order: int, weights: list[float]) -> None:
    impulse = np.zeros(100)
    impulse[0] = 1.0
    answer = compensated(PolynomialExtrapolation(order=order, delay=20 * DT), impulse)
    assert answer[: 20 * order + 1 : 20] == pytest.approx(weights)
    assert np.count_nonzero(answer) == len(weights)


@pytest.mark.parametrize("order", [1, 2, 3])
def test_polynomial_extrapolation_of_a_sine_errs_by_omega_tau_to_the_order_plus_one(order: int) -> None:
    x = sine(0.02, 2.0)
    late = compensated(PolynomialExtrapolation(order=order, delay=20 * DT), x)[:-20]  # a pure delay of 20 substeps
    error = np.max(np.abs(late - x[20:])[200:])
    # remainder of the interpolation: at most, and for small omega tau nearly, X (omega tau)^(order + 1)
    closed = 0.02 * (2 * np.pi * 20 * DT) ** (order + 1)
    assert 0.85 * closed < error < closed


def test_derivative_feed_forward_adds_velocity_and_acceleration() -> None:
    t = np.arange(1, 200) * DT
    part = DerivativeFeedForward(velocity_gain=0.03, acceleration_root=0.02)
    fed = compensated(part, 0.4 * t + 0.7 * t**2)
    exact = 0.4 * t + 0.7 * t**2 + 0.03 * (0.4 + 1.4 * t) + 0.02**2 * 1.4
    assert fed[2:] == pytest.approx(exact[2:], rel=1e-9)  # differences of three points are exact on a parabola


def test_derivative_feed_forward_inverts_a_second_order_actuator() -> None:
    omega, zeta = 2 * np.pi * 15.0, 0.8
    part = DerivativeFeedForward(velocity_gain=2 * zeta / omega, acceleration_root=1 / omega)
    actuator = SecondOrderActuator(frequency=15.0, damping_ratio=zeta, dead_time=0.0, **UNLIMITED)
    errors = []
    for dt in (1 / 1024, 1 / 2048, 1 / 4096):
        x = sine(0.02, 1.0, dt=dt) ** 2 / 0.02  # starts smoothly
        errors.append(np.max(np.abs(tracked(part, actuator, x, dt)[0] - x)))
    alone = np.max(np.abs(tracked(DerivativeFeedForward(velocity_gain=0.0), actuator, x, 1 / 4096)[0] - x))
    assert errors[-1] < 1e-3 * alone
    # the backward second difference is half a substep late per order: first order in dt
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(1.0, abs=0.1)


def test_a_phase_lead_without_lag_inverts_a_first_order_delay() -> None:
    x = sine(0.02, 1.0)
    measured, _ = tracked(PhaseLead(lead_time=29 * DT, lag_ratio=0.0), FirstOrderDelay(alpha=30, **UNLIMITED), x)
    assert measured == pytest.approx(x, abs=1e-15)


@pytest.mark.parametrize("frequency", [1.0, 4.0])
def test_a_phase_lead_has_its_frequency_response(frequency: float) -> None:
    s, dt = 2j * np.pi * frequency, 1 / 8192
    x = sine(0.01, 2.0, frequency, dt)
    led = compensated(PhaseLead(lead_time=0.03, lag_ratio=0.2), x, dt=dt)
    turn = np.exp(-s * np.arange(1, len(x) + 1) * dt)[8192:]
    response = np.sum(led[8192:] * turn) / np.sum(x[8192:] * turn)
    assert response == pytest.approx((1 + 0.03 * s) / (1 + 0.006 * s), rel=3e-3)  # backward difference, omega dt / 2


def test_a_phase_lead_amplifies_a_jump_at_most_by_one_over_its_ratio_and_settles_on_it() -> None:
    led = compensated(PhaseLead(lead_time=0.05, lag_ratio=0.1), np.full(200, 1.0))
    assert 8.0 < led[0] < 10.0
    assert led[-1] == pytest.approx(1.0)


def periodic(rng: np.random.Generator, lines: int) -> tuple[np.ndarray, np.ndarray]:
    """A command of period 1 s from `lines` lines, and a measured displacement that is late, low and a little distorted."""
    t = np.arange(1, 6 * 1024 + 1) * DT
    command, measured = np.zeros_like(t), np.zeros_like(t)
    for k in range(1, lines + 1):
        size, phase = 0.02 / k, rng.uniform(0, 2 * np.pi)
        command += size * np.sin(2 * np.pi * k * t + phase)
        measured += 0.95 * size * np.sin(2 * np.pi * k * (t - 0.025 - 0.001 * k) + phase)
    return command, measured


@pytest.mark.parametrize(("gain_range", "largest_delay"), [(0.5, 0.06), (0.02, 0.06), (0.5, 0.02)])
def test_ats_converges_to_the_bounded_least_squares_of_its_window(gain_range: float, largest_delay: float) -> None:
    command, measured = periodic(np.random.default_rng(4), 3)
    part = AdaptiveTimeSeries(delay=0.01, gain_range=gain_range, largest_delay=largest_delay)
    parameters, state = part.build(DT)
    sent, smooth = [0.0], np.zeros((len(command), 2))
    low_pass = np.zeros((2, 2))
    share = 1 - np.exp(-2 * np.pi * 20.0 * DT)
    for q, x in enumerate(command):
        meas = measured[q - 1] if q else 0.0
        low_pass[0] += share * (np.array([meas, sent[-1]]) - low_pass[0])
        low_pass[1] += share * (low_pass[0] - low_pass[1])
        smooth[q] = low_pass[1]
        sent.append(part.step(parameters, state, x, 0.0, meas, 0.0, DT))
    x, u = smooth.T
    h = 10 * DT
    now, before, first = x[-1024:], x[-1034:-10], x[-1044:-20]
    matrix = np.column_stack([now, (3 * now - 4 * before + first) / (2 * h), (now - 2 * before + first) / h**2])
    bounds = ([1 - gain_range, 0, 0], [1 + gain_range, largest_delay, largest_delay**2 / 2])
    fitted = lsq_linear(matrix, u[-1024:], bounds, tol=1e-14).x
    found = state[9:12]
    assert found == pytest.approx(fitted, rel=1e-4, abs=1e-8)  # the solver stays a little inside the bounds
    assert state[0] == pytest.approx((found[1] - 0.01) / DT)


@pytest.mark.parametrize("alpha", [15, 45])
def test_ats_finds_the_delay_of_an_actuator_from_a_wrong_estimate(alpha: int) -> None:
    t = np.arange(1, 5 * 1024 + 1) * DT
    phases = np.random.default_rng(5).uniform(0, 2 * np.pi, 8)
    lines = np.linspace(0.3, 3.0, 8)
    steps = np.arange(0, 5 * 1024 + 1, 10) * DT  # commanded every 10 substeps and ramped between, as in a test
    motion = 0.006 * np.sin(2 * np.pi * np.outer(steps, lines) + phases).sum(axis=1) * np.minimum(steps, 1) ** 2
    x = np.interp(t, steps, motion)
    actuator = FirstOrderDelay(alpha=alpha, **UNLIMITED)
    measured, adapted = tracked(AdaptiveTimeSeries(delay=29 * DT), actuator, x)
    fixed, _ = tracked(InverseCompensation(alpha_es=30), actuator, x)

    def error(path: np.ndarray) -> float:
        return float(np.sqrt(np.sum((path - x)[2048:] ** 2) / np.sum(x[2048:] ** 2)))

    assert adapted[-1] == pytest.approx(alpha - 30, abs=2.0)  # a0 and a2 carry some of the delay
    assert error(measured) < min(0.01, 0.1 * error(fixed))


def test_ats_holds_its_start_values_while_the_motion_is_small() -> None:
    x = sine(0.2e-3, 2.0)
    _, adapted = tracked(AdaptiveTimeSeries(delay=0.0, threshold=0.25e-3), FirstOrderDelay(alpha=30), x)
    assert (adapted == 0.0).all()
    _, adapted = tracked(AdaptiveTimeSeries(delay=0.0, threshold=0.05e-3), FirstOrderDelay(alpha=30), x)
    assert adapted[-1] > 20


def test_ats_keeps_its_window_small_at_a_high_controller_rate() -> None:
    _, state = AdaptiveTimeSeries(window=10.0).build(1e-5)
    assert len(state) < 14_100  # 4 x 2048 of the window and 3 x 1955 of the delay lines
