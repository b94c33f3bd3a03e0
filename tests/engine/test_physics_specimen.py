"""Physics of the left-out effects of a specimen: closed forms and independent statements."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.specimen import (
    AddedInertia,
    Asymmetry,
    Backlash,
    BoucWenHysteresis,
    CoulombFriction,
    CubicStiffness,
    CurrentLag,
    ParallelStiffness,
    Pinching,
    ResidualField,
    SeriesCompliance,
    StrengthAgainstCurrent,
    StrengthAgainstTemperature,
    StrengthDrop,
    StribeckFriction,
    VelocityExponent,
    ViscousHeating,
)
from rths_engine.parts.specimens.bouc_wen import BoucWen
from rths_engine.parts.specimens.friction_slider import FrictionSlider
from rths_engine.parts.specimens.hyperbolic_tangent import HyperbolicTangent
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.running import replay
from tests.engine.effects import enclosed, stepped

DT = 1 / 1024
SPRING = LinearSpecimen(stiffness=4e6, damping=0.0)
DASHPOT = LinearSpecimen(stiffness=0.0, damping=3e5)
NOTHING = LinearSpecimen(stiffness=0.0, damping=0.0)


def force(part: Part, effect: Effect, x: Array) -> Array:
    return replay.specimen(part, [effect], x, np.ones_like(x), DT)


def sine(amplitude: float, cycles: int = 3) -> Array:
    return np.asarray(amplitude * np.sin(2 * np.pi * np.arange(cycles * 1024 + 1) * DT))


def last_cycle(part: Part, effect: Effect, amplitude: float) -> float:
    x = sine(amplitude)
    return enclosed(force(part, effect, x)[-1025:], x[-1025:])


@pytest.mark.parametrize("gap", [0.0, 1e-3, 6e-3])
def test_a_friction_slider_behind_a_gap_dissipates_over_what_the_gap_leaves(gap: float) -> None:
    slip, stiffness, amplitude = 1e5, 5e7, 0.02
    energy = last_cycle(FrictionSlider(slip_force=slip, stiffness=stiffness), Backlash(gap=gap), amplitude)
    # contact opens and closes at substeps: half a substep's way at each of the four corners
    assert energy == pytest.approx(4 * slip * (amplitude - gap / 2 - slip / stiffness), rel=0.01)


def test_a_spring_behind_a_gap_is_free_within_it_and_shifted_by_half_of_it_beyond() -> None:
    x, gap = sine(0.01), 4e-3
    exact = 4e6 * np.sign(x) * np.maximum(np.abs(x) - gap / 2, 0.0)
    one_substep = 4e6 * 0.01 * 2 * np.pi * DT  # of the spring at full velocity: contact opens by the last substep's force
    assert np.abs(force(SPRING, Backlash(gap=gap), x) - exact).max() < 1.01 * one_substep


@pytest.mark.parametrize(("pressed", "free"), [(-1.0, 4e-3), (0.0, 2e-3), (1.0, 0.0)])
def test_the_play_begins_on_the_side_that_a_force_presses_on(pressed: float, free: float) -> None:
    x = np.linspace(0.0, 0.01, 1024)
    effects = [Backlash(gap=4e-3), CoulombFriction(friction=1e5, presliding=1e-4)]
    felt = replay.specimen(NOTHING, effects, x, np.ones_like(x), DT, pressed=pressed)
    assert x[np.argmax(felt > 0)] == pytest.approx(free, abs=2.1 * 0.01 / 1023)


def test_springs_in_series_add_their_flexibilities() -> None:
    x = sine(0.01)
    stiffness = 1 / (1 / 4e6 + 2e-7)
    assert np.abs(force(SPRING, SeriesCompliance(flexibility=2e-7), x) - stiffness * x).max() < 1e-6 * stiffness * 0.01


@settings(max_examples=20, deadline=None)
@given(friction=st.floats(1e3, 1e6), share=st.floats(1e-3, 0.3))
def test_coulomb_friction_dissipates_four_times_force_and_amplitude_beyond_presliding(friction: float, share: float) -> None:
    amplitude = 0.02
    effect = CoulombFriction(friction=friction, presliding=share * amplitude)
    closed = 4 * friction * amplitude * (1 - share * np.tanh(1 / share))
    assert last_cycle(NOTHING, effect, amplitude) == pytest.approx(closed, rel=1e-3)  # corners fall between substeps


@pytest.mark.parametrize("velocity", [1e-3, 0.01, 0.1])
def test_stribeck_friction_in_steady_sliding_follows_its_curve(velocity: float) -> None:
    effect = StribeckFriction(friction=2e4, breakaway=1e4, stribeck_velocity=0.01, presliding=1e-5)
    x = velocity * np.arange(400) * DT
    for way in (1, -1):
        steady = force(NOTHING, effect, way * x)[-1]
        assert steady == pytest.approx(way * (2e4 + 1e4 * np.exp(-((velocity / 0.01) ** 2))), rel=1e-9)


def test_a_heated_dashpot_at_constant_velocity_fades_exponentially_in_time() -> None:
    velocity, fade = 0.1, 2e-5
    time = np.arange(8 * 1024) * DT
    plain = 3e5 * velocity
    heated = force(DASHPOT, ViscousHeating(fade=fade), velocity * time)
    exact = plain * np.exp(-fade * plain * velocity * time)  # E' = f v with f = f_0 (1 - phi E)
    # the fade of a substep counts from its beginning
    assert heated[1:] == pytest.approx(exact[1:], rel=2 * fade * plain * velocity * DT)


def test_a_heated_dashpot_has_lost_the_fade_times_the_energy_it_dissipated() -> None:
    x, fade = sine(0.05, 10), 3e-6
    plain, heated = force(DASHPOT, ViscousHeating(fade=0.0), x), force(DASHPOT, ViscousHeating(fade=fade), x)
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (heated[1:] + heated[:-1]) * np.diff(x))])
    moving = np.abs(plain) > 1e3
    assert energy[-1] * fade > 0.1
    lost = 1 - heated[moving] / plain[moving]
    assert np.abs(lost - fade * energy[moving]).max() < 1e-4  # the energy of one substep


def test_no_heat_comes_of_a_spring() -> None:
    x = sine(0.05, 10)
    at_rest = force(SPRING, ViscousHeating(fade=1e-5), x)[::1024]
    assert at_rest == pytest.approx(0.0, abs=1e-6)
    assert force(SPRING, ViscousHeating(fade=1e-5), x)[256 + 9 * 1024] < 4e6 * 0.05  # but what it stores counts meanwhile


def test_a_parallel_spring_adds_its_force() -> None:
    x = sine(0.02)
    assert force(SPRING, ParallelStiffness(stiffness=-1e6), x) == pytest.approx(3e6 * x, abs=1e-9)


def test_a_cubic_spring_stiffens_by_three_quarters_and_makes_a_quarter_of_third_harmonic() -> None:
    amplitude, cubic = 0.02, 5e9
    spectrum = np.fft.rfft(force(NOTHING, CubicStiffness(stiffness=cubic), sine(amplitude, 1)[:-1])) / 512
    assert -spectrum[1].imag == pytest.approx(0.75 * cubic * amplitude**3, rel=1e-9)
    assert spectrum[3].imag == pytest.approx(0.25 * cubic * amplitude**3, rel=1e-9)


def test_added_inertia_is_mass_times_the_acceleration_of_a_sine() -> None:
    x, omega = sine(0.02), 2 * np.pi
    found = force(NOTHING, AddedInertia(mass=500.0), x)
    exact = -500 * omega**2 * np.concatenate([[0.0], x[:-1]])  # half a substep before v, one before x
    assert found[:2] == pytest.approx(0.0)
    assert np.abs(found - exact)[2:].max() < 500 * omega**2 * 0.02 * (omega * DT) ** 2  # second difference, order 2


def test_asymmetry_leaves_the_mean_strength_and_splits_it_by_direction() -> None:
    found = stepped(Asymmetry(share=0.2), np.array([5.0, -5.0]))
    assert found.tolist() == pytest.approx([6.0, -4.0])


@pytest.mark.parametrize("exponent", [-0.5, 0.3, 1.0])
def test_a_dashpot_with_another_exponent_follows_the_power_law(exponent: float) -> None:
    effect = VelocityExponent(exponent=exponent, reference_velocity=0.1)

    def steady(velocity: float) -> Any:
        return force(DASHPOT, effect, velocity * np.arange(5) * DT)[-1]

    assert steady(0.1) == pytest.approx(3e5 * 0.1, rel=1e-9)
    # levelling out at s = 0.05 of the reference changes the power by about e s^2 / 2
    assert steady(0.4) / steady(0.1) == pytest.approx(4 ** (1 + exponent), rel=2e-3)
    assert np.isfinite(steady(0.0))


@pytest.mark.parametrize("exponent", [1.0, 2.0])
def test_the_hysteresis_beside_a_specimen_is_that_of_the_bouc_wen_specimen(exponent: float) -> None:
    alone = BoucWen(stiffness=5e7, yield_force=1e5, post_yield_ratio=0.0, exponent=exponent, fullness=0.7)
    beside = BoucWenHysteresis(strength=1e5, yield_displacement=2e-3, exponent=exponent, fullness=0.7)
    x = sine(0.02)
    assert np.abs(force(NOTHING, beside, x) - force(alone, ParallelStiffness(), x)).max() < 1e-6


def test_monotonic_hysteresis_of_exponent_one_is_an_exponential() -> None:
    x = np.linspace(0, 0.01, 200)
    found = force(NOTHING, BoucWenHysteresis(strength=1e5, yield_displacement=2e-3, exponent=1.0), x)
    assert found == pytest.approx(1e5 * -np.expm1(-x / 2e-3), rel=2e-4)  # Runge-Kutta in parts of 0.5, order 4


def test_pinching_takes_its_depth_at_the_middle_and_its_share_of_e_at_its_width() -> None:
    x = np.array([0.0, 5e-3, -5e-3, 0.1])
    found = stepped(Pinching(depth=0.4, width=5e-3), np.full(4, 1e5), x)
    assert found == pytest.approx(1e5 * np.array([0.6, 1 - 0.4 / np.e, 1 - 0.4 / np.e, 1.0]))


def test_a_strength_drop_takes_its_share_from_its_moment_on_and_moves_with_it_continuously() -> None:
    kept = stepped(StrengthDrop(share=0.25, time=10.25 * DT), np.ones(20), dt=DT)
    assert kept[:11] == pytest.approx(1.0)
    assert kept[11] == pytest.approx(1 - 0.25 * 0.75)  # three quarters of this substep come after the moment
    assert kept[12:] == pytest.approx(0.75)


def test_the_force_follows_a_step_of_the_current_exponentially() -> None:
    off, on, lag, still = 0.5, 2.0, 0.05, 0.25
    time = np.arange(200) * DT
    current = np.where(time > 0, on, 0.0)
    found = stepped(CurrentLag(lag=lag, off_current=still), np.full(200, 1e5), w=np.where(time > 0, on, off), dt=DT)
    magnetised = on + (off - on) * np.exp(-time / lag)
    assert found[1:] == pytest.approx(1e5 * (still + magnetised[1:]) / (still + current[1:]), rel=1e-9)


def test_an_effect_acts_on_a_specimen_that_knows_nothing_of_it() -> None:
    x = sine(0.02)
    part = HyperbolicTangent()
    with_friction = force(part, CoulombFriction(friction=1e4), x) - force(part, CoulombFriction(), x)
    assert np.abs(with_friction).max() == pytest.approx(1e4)


def test_strength_against_current_is_a_saturating_law() -> None:
    """Closed form at 0, i_s and i_r: 1 - kappa (1 - tanh(i / i_s) / tanh(i_r / i_s))."""
    effect = StrengthAgainstCurrent(share=0.8, saturation_current=1.0, reference_current=2.0)
    force = stepped(effect, np.full(4, 1e5), w=np.array([0.0, 1.0, 2.0, -2.0]))
    middle = 1 - 0.8 * (1 - np.tanh(1.0) / np.tanh(2.0))
    assert force == pytest.approx([2e4, middle * 1e5, 1e5, 1e5], rel=1e-12)


def test_a_residual_field_stays_behind_the_current_by_its_residual_current() -> None:
    """Rising, the field is that of 0.2 A less; falling, of 0.2 A more; at a reversal it stays."""
    current = np.array([1.0, 1.1, 2.0, 1.9, 1.0, 0.0, 0.3])
    field = np.array([1.0, 1.0, 1.8, 1.8, 1.2, 0.2, 0.2])
    force = stepped(ResidualField(residual=0.2, off_current=0.5), np.full(7, 1e5), w=current)
    assert force == pytest.approx(1e5 * (0.5 + field) / (0.5 + current), rel=1e-12)


def test_strength_against_temperature_is_exponential() -> None:
    effect = StrengthAgainstTemperature(coefficient=0.02, reference=293.15)
    force = stepped(effect, np.full(3, 1e5), w=np.array([283.15, 293.15, 343.15]))
    assert force == pytest.approx([1e5 * np.exp(0.2), 1e5, 1e5 * np.exp(-1.0)], rel=1e-12)
