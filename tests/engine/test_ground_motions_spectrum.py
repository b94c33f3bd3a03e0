"""Response spectra against closed forms and an independent solver."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rths_engine.foundation.errors import MotionError, RthsError
from rths_engine.parts.ground_motions import Motion, MotionLibrary, response_spectrum, spectral_acceleration
from rths_engine.parts.ground_motions.scaling import Factor, ToPga, ToSpectralAcceleration

EL_CENTRO = MotionLibrary(None).get("imperial-valley-1940-el-centro-ns")
BETWEEN_POINTS = 1 - np.cos(np.pi / 20)  # a peak midway between points T/20 apart is missed by this fraction


def solved(motion: Motion, period: float, damping: float) -> float:
    """Sa by an adaptive Runge-Kutta solver that stops at no sample for longer than a step."""
    w, times = 2 * np.pi / period, np.arange(len(motion.acceleration)) * motion.dt
    answer = solve_ivp(
        lambda t, y: [y[1], -np.interp(t, times, motion.acceleration, right=0.0) - 2 * damping * w * y[1] - w**2 * y[0]],
        (0, motion.duration + period),
        [0.0, 0.0],
        method="RK45",
        rtol=1e-8,
        atol=1e-10,
        max_step=motion.dt,
        t_eval=np.arange(0, motion.duration + period, min(motion.dt, period / 200)),
    )
    return float(w**2 * np.max(np.abs(answer.y[0])))


@pytest.mark.parametrize(("period", "damping"), [(0.1, 0.05), (0.5, 0.02), (1.48, 0.05), (3.0, 0.1)])
def test_the_spectrum_agrees_with_an_independent_solver(period: float, damping: float) -> None:
    short = Motion("part", "part", EL_CENTRO.dt, EL_CENTRO.acceleration[:400])
    found = spectral_acceleration(short, period, damping)
    # the two differ by where they look for the peak: points T/20 apart here, T/200 in the solver
    assert found == pytest.approx(solved(short, period, damping), rel=BETWEEN_POINTS)


def test_a_step_of_acceleration_doubles_the_static_response_without_damping() -> None:
    step = np.full(401, 2.0)
    assert response_spectrum(step, 0.01, [1.0], 0.0)[0] == pytest.approx(2 * 2.0, rel=1e-9)  # T = 100 points: the peak is one


def test_a_step_of_acceleration_overshoots_by_the_decay_over_half_a_period() -> None:
    d = 0.05
    overshoot = np.exp(-np.pi * d / np.sqrt(1 - d**2))
    found = response_spectrum(np.full(4001, 1.0), 0.001, [1.0], d)[0]
    assert found == pytest.approx(1 + overshoot, rel=1e-5)  # 1000 points a period: (pi / 1000)^2 / 2 is missed at most


def test_resonance_with_a_harmonic_reaches_one_over_twice_the_damping() -> None:
    d, dt = 0.05, 0.005
    times = np.arange(0, 40, dt)
    found = response_spectrum(np.sin(2 * np.pi * times), dt, [1.0], d)[0]
    # 1 / (2 d) of steady state; a linear course between points loses (pi dt)^2 / 3 of a sine's amplitude, some 1e-4
    assert found == pytest.approx(1 / (2 * d), rel=1e-3)


def test_a_rigid_structure_moves_with_the_ground() -> None:
    found = response_spectrum(EL_CENTRO.acceleration, EL_CENTRO.dt, [0.0, 1e-4, 1e-3], 0.05)
    assert found[0] == EL_CENTRO.pga
    # a change of slope between steps adds about slope * T / 2 pi, below 0.3 % of the peak at T = dt / 20
    assert found == pytest.approx([EL_CENTRO.pga] * 3, rel=3e-3)


def test_a_very_soft_structure_stays_where_it_was() -> None:
    pulse = np.concatenate([[0.0], np.ones(100), -np.ones(100), [0.0]])  # the ground ends displaced by 1 m and at rest
    period = 1000.0
    found = response_spectrum(pulse, 0.01, [period], 0.0)[0] / (2 * np.pi / period) ** 2
    assert found == pytest.approx(1.0, rel=0.02)  # the ramps of one step in 100 at start, middle and end


def test_the_spectrum_keeps_the_shape_of_the_periods_and_scales_with_the_record() -> None:
    periods = np.array([[0.2, 0.5], [1.0, 2.0]])
    once = response_spectrum(EL_CENTRO.acceleration, EL_CENTRO.dt, periods)
    twice = response_spectrum(-2 * EL_CENTRO.acceleration, EL_CENTRO.dt, periods)
    assert once.shape == (2, 2)
    np.testing.assert_allclose(twice, 2 * once, rtol=1e-12)


@pytest.mark.parametrize(
    ("periods", "dt", "damping"), [([-1.0], 0.01, 0.05), ([np.nan], 0.01, 0.05), ([1.0], 0.0, 0.05), ([1.0], 0.01, 1.0)]
)
def test_impossible_periods_steps_and_damping_are_refused(periods: list[float], dt: float, damping: float) -> None:
    with pytest.raises(RthsError):
        response_spectrum(EL_CENTRO.acceleration, dt, periods, damping)


def test_el_centro_has_its_published_spectral_acceleration() -> None:
    # Chopra, Dynamics of Structures, example 6.2 ff.: at T = 2 s and 2 % damping D = 7.47 in, A = 0.191 g
    assert spectral_acceleration(EL_CENTRO, 2.0, 0.02) / 9.80665 == pytest.approx(0.191, abs=0.001)


def test_scaling_reaches_the_wanted_peak_or_spectral_acceleration() -> None:
    assert EL_CENTRO.scaled(Factor(factor=0.4).factor_for(EL_CENTRO, 1.0)).pga == pytest.approx(0.4 * EL_CENTRO.pga)
    assert EL_CENTRO.scaled(ToPga(pga="0.25 g").factor_for(EL_CENTRO, 1.0)).pga == pytest.approx(0.25 * 9.80665)
    wanted = ToSpectralAcceleration(sa=3.0, damping=0.02)
    scaled = EL_CENTRO.scaled(wanted.factor_for(EL_CENTRO, 1.48))
    assert spectral_acceleration(scaled, 1.48, 0.02) == pytest.approx(3.0, rel=1e-9)  # the spectrum is linear in the record


@pytest.mark.parametrize("scale", [ToPga(pga=1.0), ToSpectralAcceleration(sa=1.0)])
def test_a_record_of_zeros_cant_be_scaled_to_a_peak(scale: ToPga | ToSpectralAcceleration) -> None:
    with pytest.raises(MotionError, match="zero throughout"):
        scale.factor_for(Motion("still", "still", 0.01, np.zeros(100)), 1.0)
