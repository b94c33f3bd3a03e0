"""Physics of the left-out effects of an actuator."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.foundation.arrays import Array
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.second_order import SecondOrderActuator
from rths_engine.parts.actuators.servo_hydraulic import ServoHydraulicActuator
from rths_engine.parts.physics.actuator import (
    AmplitudeDependentDelay,
    Backlash,
    DeadBand,
    DelayError,
    ForceCompliance,
    GainError,
    SecondOrderLag,
    StickFriction,
    SupplySaturation,
    ValveFlow,
    VelocitySaturation,
)
from tests.engine.effects import enclosed, stepped

DT = 1 / 1024
TIME = DT * np.arange(4096)


def gain_at(response: Array, frequency: float) -> complex:
    """Complex gain to a unit sine over the last of four seconds."""
    tail = TIME[-1024:]
    return complex(2 * np.mean(response[-1024:] * np.exp(-2j * np.pi * frequency * tail)) / -1j)


@settings(max_examples=25, deadline=None)
@given(delay=st.floats(-0.02, 0.05))
def test_a_delayed_ramp_is_the_ramp_of_that_much_before(delay: float) -> None:
    found = stepped(DelayError(delay=delay), 0.3 * TIME[:200], dt=DT)
    assert found[60:] == pytest.approx(0.3 * (TIME[60:200] - delay), abs=1e-12)


@pytest.mark.parametrize("frequency", [1.0, 5.0])
@pytest.mark.parametrize("delay", [0.0043, 0.02])
def test_a_delay_turns_the_phase_of_a_sine_and_leaves_its_amplitude(frequency: float, delay: float) -> None:
    omega = 2 * np.pi * frequency
    gain = gain_at(stepped(DelayError(delay=delay), np.sin(omega * TIME), dt=DT), frequency)
    assert gain == pytest.approx(np.exp(-1j * omega * delay), abs=(omega * DT) ** 2 / 8)  # linear between substeps


def test_the_delay_grows_in_proportion_to_the_amplitude() -> None:
    omega = 2 * np.pi
    for amplitude in (0.01, 0.05):
        effect = AmplitudeDependentDelay(slope=0.4, memory=100.0)
        gain = gain_at(stepped(effect, amplitude * np.sin(omega * TIME), dt=DT), 1.0)
        # over half a cycle without a peak, exp(-0.5 s / memory) of the amplitude is left
        assert -np.angle(gain) / omega == pytest.approx(0.4 * amplitude, rel=0.01)


def test_the_amplitude_is_forgotten() -> None:
    effect = AmplitudeDependentDelay(slope=0.4, memory=0.1)
    parameters, state = effect.build(DT)
    for value in [0.05] + 50 * [0.001]:
        effect.step(parameters, state, value, 0.0, 0.0, 0.0, 0.0, DT)
    assert state[0] == pytest.approx(0.05 * np.exp(-50 * DT / 0.1), rel=1e-9)


@pytest.mark.parametrize("damping", [0.2, 1.0])
def test_the_second_order_lag_has_the_transfer_function_of_its_equation(damping: float) -> None:
    effect = SecondOrderLag(time_constant=1 / (2 * np.pi * 12.0), damping_ratio=damping)
    for frequency in (2.0, 8.0):
        ratio = frequency / 12.0
        exact = 1 / (1 - ratio**2 + 2j * damping * ratio)
        gain = gain_at(stepped(effect, np.sin(2 * np.pi * frequency * TIME), dt=DT), frequency)
        assert gain == pytest.approx(exact, abs=abs(exact) * (2 * np.pi * frequency * DT) ** 2 / 6)  # command taken as linear


def test_a_second_order_lag_shorter_than_a_substep_changes_little_and_stays_stable() -> None:
    for share in (0.005, 0.02, 0.5):
        effect = SecondOrderLag(time_constant=share * DT, damping_ratio=0.5)
        found = stepped(effect, np.sin(2 * np.pi * TIME), dt=DT)
        lag = np.sin(2 * np.pi * TIME) - found
        assert np.abs(lag[100:]).max() <= 1.001 * 2 * np.pi * share * DT  # 2 zeta T, and second order


@pytest.mark.parametrize("actuator", [FirstOrderDelay(), SecondOrderActuator(), ServoHydraulicActuator()])
def test_a_saturated_actuator_moves_no_faster_than_the_smaller_limit(actuator: FirstOrderDelay) -> None:
    slow = VelocitySaturation(velocity_limit=0.2).amended(actuator)
    parameters, state = slow.build(DT)
    moved = np.array([slow.step(parameters, state, 0.05 if t > 0.1 else 0.0, 0.0) for t in TIME[:300]])  # type: ignore[attr-defined]
    rings = 1.3 if isinstance(actuator, ServoHydraulicActuator) else 1 + 1e-9  # the mass on its oil column
    assert np.abs(np.diff(moved)).max() < 0.2 * DT * rings
    assert VelocitySaturation(velocity_limit=9.0).amended(actuator) == actuator


def test_the_piston_gives_way_to_a_steady_force_by_its_flexibility() -> None:
    effect = ForceCompliance(flexibility=2e-9, lag=0.01)
    found = stepped(effect, np.zeros(1024), w=np.full(1024, 1e6), dt=DT)
    assert found == pytest.approx(-2e-3 * -np.expm1(-np.arange(1, 1025) * DT / 0.01), rel=1e-9)


def test_the_piston_rests_against_a_spring_where_both_flexibilities_say() -> None:
    effect, stiffness, end = ForceCompliance(flexibility=2e-8), 1e8, 0.0
    parameters, state = effect.build(DT)
    for _ in range(2000):  # phi k = 2, one substep between force and displacement
        end = effect.step(parameters, state, 0.01, 0.0, 0.0, stiffness * end, 0.0, DT)
    assert end == pytest.approx(0.01 / (1 + 2e-8 * stiffness), rel=1e-9)


def test_a_dead_band_adds_its_half_width_to_the_lag_on_a_ramp() -> None:
    for half_width in (0.0, 1e-3):
        effect, actuator = DeadBand(half_width=half_width), FirstOrderDelay(alpha=30)
        (pe, se), (pa, sa), piston = effect.build(DT), actuator.build(DT), 0.0
        for q in range(2000):
            command = effect.step(pe, se, 0.1 * q * DT, piston, 0.0, 0.0, 0.0, DT)
            piston = actuator.step(pa, sa, command, 0.0)
        # the drive sees the piston one substep late, so its error is 30 increments and the lag 29
        assert 0.1 * 1999 * DT - piston == pytest.approx(29 * 0.1 * DT + half_width, rel=1e-9)


def test_within_the_dead_band_the_piston_rests() -> None:
    assert stepped(DeadBand(half_width=1e-3), np.full(3, 0.0109), np.full(3, 0.01)).tolist() == [0.01] * 3


def test_play_loses_half_the_gap_of_each_amplitude_and_encloses_the_area_of_its_parallelogram() -> None:
    gap, amplitude = 2e-3, 0.01
    drive = amplitude * np.sin(2 * np.pi * TIME)
    found = stepped(Backlash(gap=gap), drive, dt=DT)
    assert found.max() == pytest.approx(amplitude - gap / 2, rel=1e-9)
    area = abs(enclosed(found[-1025:], drive[-1025:]))
    assert area == pytest.approx(2 * gap * (amplitude - gap / 2), rel=1e-3)  # corners fall between substeps


def test_a_sticking_piston_rests_after_a_reversal_until_it_breaks_away_and_then_catches_up() -> None:
    away, back = np.linspace(0, 0.01, 100), np.linspace(0.01, -0.01, 400)[1:]
    effect = StickFriction(breakaway=1e-3, catching=0.02)
    found = stepped(effect, np.concatenate([away, back]), dt=DT)
    after, drive = found[100:], back
    stuck = drive > 0.01 - 1e-3 + 1e-12
    assert after[stuck] == pytest.approx(0.01)
    lost = after[~stuck] - drive[~stuck]
    assert lost == pytest.approx(1e-3 * np.exp(-np.arange(len(lost)) * DT / 0.02), rel=1e-9)


def test_a_gain_error_moves_by_its_share_more() -> None:
    assert stepped(GainError(share=0.03), np.array([0.01, -0.02])) == pytest.approx([0.0103, -0.0206])


def test_a_valve_moves_the_error_by_the_root_of_the_pressure_that_the_load_leaves() -> None:
    ahead, loads = np.ones(4), np.array([0.0, 3e4, 1e5, -3e4])
    moved = stepped(ValveFlow(inverse_stall_force=1e-5), ahead, np.zeros(4), loads)
    assert moved == pytest.approx(np.sqrt([1.0, 0.7, 0.0, 1.3]))  # against half of the stall force, at it, and helped
    back = stepped(ValveFlow(inverse_stall_force=1e-5), -ahead, np.zeros(4), loads)
    assert back == pytest.approx(-np.sqrt([1.0, 1.3, 2.0, 0.7]))


def test_a_supply_weakens_by_the_root_of_the_pressure_left_and_recovers_at_rest() -> None:
    """A piston at V draws (V - v_p) t; at rest the pump fills the accumulator with v_p t."""
    effect, dt = SupplySaturation(emptying=10.0, velocity=0.1), 1e-3
    parameters, state = effect.build(dt)
    moving = [effect.step(parameters, state, 1.0, 0.0, 0.3, 0.0, 0.0, dt) for _ in range(400)]
    assert moving[99] == pytest.approx(np.sqrt(1 - 10 * 0.02))  # after 0.1 s
    assert moving[199] == pytest.approx(np.sqrt(1 - 10 * 0.04))
    resting = [effect.step(parameters, state, 1.0, 0.0, 0.0, 0.0, 0.0, dt) for _ in range(900)]
    assert resting[399] == pytest.approx(np.sqrt(1 - 10 * (0.08 - 0.04)))
    assert resting[-1] == 1.0
