"""Physics of the actuators: delay, dynamics, limits of velocity and force, compliance."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.second_order import SecondOrderActuator
from rths_engine.parts.actuators.servo_hydraulic import ServoHydraulicActuator
from rths_engine.parts.actuators.velocity_drive import VelocityDrive

DT = 1 / 1024
UNLIMITED = {"velocity_limit": 10.0, "force_limit": 1e8}


def moved(part: Any, commands: np.ndarray, force: float | np.ndarray = 0.0, dt: float = DT) -> np.ndarray:
    """Displacement after each command, against given forces, from rest at 0."""
    parameters, state = part.build(dt)
    return np.array([part.step(parameters, state, *given) for given in np.broadcast(commands, force)])


def against_damper(part: Any, commands: np.ndarray, stiffness: float, damping: float, dt: float = DT) -> np.ndarray:
    """Displacement after each command, with a spring and dashpot whose force acts one substep later."""
    parameters, state = part.build(dt)
    x, force, path = 0.0, 0.0, []
    for command in commands:
        last, x = x, part.step(parameters, state, command, force)
        force = stiffness * x + damping * (x - last) / dt
        path.append(x)
    return np.array(path)


@pytest.mark.parametrize("dead_time", [0.0, 8 / 1024, 0.0123])
def test_a_second_order_actuator_agrees_with_an_independent_solver(dead_time: float) -> None:
    part = SecondOrderActuator(frequency=12.0, damping_ratio=0.6, dead_time=dead_time, **UNLIMITED)
    omega = 2 * np.pi * 12.0

    def command(t: np.ndarray | float) -> Any:
        return 0.02 * np.sin(2 * np.pi * 3.0 * np.maximum(t, 0.0)) ** 2

    def slope(t: float, y: np.ndarray) -> np.ndarray:
        return np.array([y[1], omega**2 * (command(t - dead_time) - y[0]) - 2 * 0.6 * omega * y[1]])

    t = np.arange(1, 1025) * DT
    solved = solve_ivp(slope, (0, 1), [0.0, 0.0], t_eval=t, rtol=1e-10, atol=1e-13, max_step=0.005)
    sagitta = (2 * np.pi * 6.0) ** 2 * 0.01 * DT**2 / 8  # of the command as a polygon, and again between its corners
    assert np.max(np.abs(moved(part, command(t)) - solved.y[0])) < 2 * sagitta


@pytest.mark.parametrize("dead_time", [0.0, 5 / 1024, 0.0077])
def test_a_second_order_actuator_lags_a_ramp_by_two_zeta_over_omega_and_its_dead_time(dead_time: float) -> None:
    part = SecondOrderActuator(frequency=10.0, damping_ratio=0.8, dead_time=dead_time, **UNLIMITED)
    ramp = 0.1 * np.arange(1, 2049) * DT
    lag = (ramp - moved(part, ramp))[-1] / 0.1
    assert lag == pytest.approx(2 * 0.8 / (2 * np.pi * 10.0) + dead_time, rel=1e-9)


def test_the_dead_time_of_an_actuator_passes_before_it_moves() -> None:
    part = SecondOrderActuator(dead_time=10 / 1024, **UNLIMITED)
    path = moved(part, np.full(30, 0.01))
    assert (path[:10] == 0.0).all() and path[10] > 0.0


def test_a_fast_second_order_actuator_follows_its_command() -> None:
    part = SecondOrderActuator(frequency=1000.0, damping_ratio=0.7, dead_time=0.0, **UNLIMITED)
    command = 0.01 * np.sin(2 * np.pi * np.arange(1, 1025) * DT)
    lag = 2 * 0.7 / (2 * np.pi * 1000.0)
    assert np.max(np.abs(moved(part, command) - command)) == pytest.approx(0.01 * 2 * np.pi * lag, rel=0.02)


def test_a_second_order_actuator_keeps_its_velocity_limit_and_stalls_at_its_capacity() -> None:
    part = SecondOrderActuator(velocity_limit=0.5, force_limit=1e5, dead_time=0.0)
    path = moved(part, np.full(200, 1.0))
    assert np.max(np.diff(path)) == pytest.approx(0.5 * DT)
    assert (moved(part, np.full(20, 0.01), 1e5) == 0.0).all()
    assert (np.diff(moved(part, np.full(20, -0.01), 1e5)) < 0.0).all()


@pytest.mark.parametrize("share", [0.0, 0.5, 0.9, -0.5])
def test_the_lag_of_a_servo_hydraulic_actuator_grows_with_the_load_pressure(share: float) -> None:
    part = ServoHydraulicActuator(time_constant=0.03, force_limit=2e6)
    ramp = 0.05 * np.arange(1, 4097) * DT
    lag = (ramp - moved(part, ramp, share * 2e6))[-1] / 0.05
    assert lag == pytest.approx(0.03 / np.sqrt(1 - share) - DT, rel=1e-6)


@pytest.mark.parametrize("share", [0.0, 0.75])
def test_the_valve_limits_the_velocity_by_the_load_pressure(share: float) -> None:
    part = ServoHydraulicActuator(velocity_limit=0.6, force_limit=2e6)
    path = moved(part, np.full(2048, 10.0), share * 2e6)
    assert np.diff(path[-100:]) / DT == pytest.approx(0.6 * np.sqrt(1 - share), rel=1e-6)


def test_a_servo_hydraulic_actuator_at_its_capacity_coasts_to_a_stop_and_gives_way_beyond() -> None:
    part = ServoHydraulicActuator(velocity_limit=0.6, force_limit=2e6, oil_stiffness=5e8, mass=2000.0)
    settled = slice(1024, None)
    velocity = np.diff(moved(part, np.full(2048, 10.0), 2e6)[settled]) / DT
    # m v' = A (p_L - p_s) = -A p_s (v / v_0)^2, so that 1/v grows by A p_s / (m v_0^2) a second
    growth = (1 / velocity[-1] - 1 / velocity[0]) / (DT * (len(velocity) - 1))
    assert growth == pytest.approx(2e6 / (2000.0 * 0.6**2), rel=0.025)  # (omega_h dt)^2 / 12 = 2 %: p_L is sampled
    backward = np.diff(moved(part, np.full(2048, 10.0), 2.5e6)[settled]) / DT
    assert backward == pytest.approx(-0.6 * np.sqrt(0.25), rel=1e-6)


def test_the_oil_column_gives_way_before_the_valve_brings_the_piston_back() -> None:
    part = ServoHydraulicActuator(time_constant=10.0, oil_stiffness=4e8, mass=1000.0, force_limit=1e8)
    path = moved(part, np.zeros(128), 1e6)  # over in 10 ms, far sooner than the position loop's 10 s
    assert path[-1] == pytest.approx(-1e6 / 4e8, rel=0.02)
    corrected = moved(ServoHydraulicActuator(oil_stiffness=4e8, force_limit=1e8), np.zeros(2048), 1e6)
    assert abs(corrected[-1]) < 1e-9


def test_a_stiff_light_servo_hydraulic_actuator_without_load_is_a_first_order_delay() -> None:
    rigid = ServoHydraulicActuator(
        time_constant=30 * DT, valve_time=0.0, oil_stiffness=1e12, mass=10.0, oil_damping=1.0, velocity_limit=10.0
    )
    command = 0.02 * np.sin(2 * np.pi * np.arange(1, 1025) * DT)
    delayed = moved(FirstOrderDelay(alpha=30, velocity_limit=10.0), command)
    assert moved(rigid, command) == pytest.approx(delayed, abs=1e-7)  # the oil column rings for 1e-5 s


def servo_error(dt: float) -> float:
    """Largest error against the continuous law, with a specimen of spring and dashpot, over the largest displacement."""
    part = ServoHydraulicActuator(oil_damping=0.3)
    stiffness, damping = 5e6, 1.5e6
    mass, oil, capacity, fastest = part.mass, part.oil_stiffness, part.force_limit, part.velocity_limit
    oil_damping = 2 * 0.3 * np.sqrt(oil * mass)

    def command(t: np.ndarray | float) -> Any:
        return 0.06 * np.sin(2 * np.pi * 1.0 * t) ** 3

    def slope(t: float, state: np.ndarray) -> np.ndarray:
        y, v, load, opening = state
        asked = np.clip((command(t) - y) / (part.time_constant * fastest), -1, 1)
        drop = 1 - np.sign(opening) * load / capacity
        flow = fastest * opening * np.sign(drop) * np.sqrt(np.abs(drop))
        a = (load + oil_damping * (flow - v) - stiffness * y - damping * v) / mass
        return np.array([v, a, oil * (flow - v), (asked - opening) / part.valve_time])

    times = np.arange(1, 257) / 256
    solved = solve_ivp(slope, (0, 1), np.zeros(4), t_eval=times, method="LSODA", rtol=1e-8, atol=1e-11, max_step=0.002)
    stride = round(1 / 256 / dt)
    path = against_damper(part, command(np.arange(1, round(1 / dt) + 1) * dt), stiffness, damping, dt)[stride - 1 :: stride]
    assert np.max(np.abs(solved.y[2])) > 0.3 * capacity  # far from linear
    return float(np.max(np.abs(path - solved.y[0])) / np.max(np.abs(solved.y[0])))


def test_a_servo_hydraulic_actuator_with_a_damper_converges_to_its_continuous_law() -> None:
    errors = np.array([servo_error(dt) for dt in (1 / 2048, 1 / 4096, 1 / 8192)])
    # command, position and force act a substep late or early: first order, (pi / 2) dt over the time constants
    assert errors[-1] < 2e-3
    assert np.log2(errors[:-1] / errors[1:]) == pytest.approx(1.0, abs=0.15)


def delay(part: Any, amplitude: float, damping: float) -> float:
    """Delay (s) of the fundamental in the third cycle of a 1 Hz sine against a dashpot."""
    t = np.arange(1, 3 * 1024 + 1) * DT
    path = against_damper(part, amplitude * np.sin(2 * np.pi * t), 0.0, damping)[-1024:]
    fundamental = np.sum(path * np.exp(-2j * np.pi * t[-1024:]))
    return float(-np.angle(fundamental * 1j) / (2 * np.pi))


def test_the_delay_of_a_servo_hydraulic_actuator_grows_with_demand_and_that_of_a_linear_one_does_not() -> None:
    amplitudes = (0.005, 0.02, 0.04, 0.06, 0.08)
    servo = [delay(ServoHydraulicActuator(), amplitude, 1.5e6) for amplitude in amplitudes]
    assert (np.diff(servo) > 2e-5).all()
    assert servo[-1] > 1.2 * servo[0]
    linear = [delay(SecondOrderActuator(**UNLIMITED), amplitude, 1.5e6) for amplitude in amplitudes]
    assert linear == pytest.approx([linear[0]] * 5, rel=1e-9)


def test_a_small_sine_is_delayed_by_the_phase_of_the_linear_servo_loop() -> None:
    part = ServoHydraulicActuator(time_constant=0.03, valve_time=0.004)
    s = 2j * np.pi
    # position loop and valve; the oil column at 80 Hz adds nothing at 1 Hz, and the command acts dt early
    loop = 1 / (1 + 0.03 * s * (1 + 0.004 * s))
    assert delay(part, 1e-4, 0.0) == pytest.approx(-np.angle(loop) / (2 * np.pi) - DT, rel=0.02)


def test_a_velocity_drive_reaches_its_gain_times_the_voltage_as_a_first_order_lag() -> None:
    part = VelocityDrive(gain=0.04, time_constant=0.06, rest_voltage=0.05)
    t = np.arange(1, 1025) * DT
    path = moved(part, np.full(1024, 0.45))
    assert path == pytest.approx(0.04 * 0.4 * (t + 0.06 * np.expm1(-t / 0.06)), rel=1e-9, abs=1e-12)


def test_a_velocity_drive_asked_for_more_than_its_limit_moves_as_at_its_limit_and_leaves_it_at_once() -> None:
    part = VelocityDrive(gain=0.04, velocity_limit=0.02)
    voltage = 3.0 * np.sin(2 * np.pi * 0.8 * np.arange(2048) * DT)
    assert moved(part, voltage) == pytest.approx(moved(part, np.clip(voltage, -0.5, 0.5)), abs=1e-12)


def test_a_velocity_drive_stalls_against_its_force_capacity() -> None:
    part = VelocityDrive(force_limit=1e5)
    assert np.all(moved(part, np.full(64, 1.0), 1.1e5) == 0.0)
    assert moved(part, np.full(64, -1.0), 1.1e5)[-1] < 0.0
