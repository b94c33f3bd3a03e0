"""Physics of the specimens: closed forms, independent solvers, energy of a cycle."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.part import validated
from rths_engine.parts.specimens.bouc_wen import BoucWen
from rths_engine.parts.specimens.elastomeric import Elastomeric
from rths_engine.parts.specimens.friction_slider import FrictionSlider
from rths_engine.parts.specimens.hyperbolic_tangent import HyperbolicTangent
from rths_engine.parts.specimens.linear import LinearSpecimen

DT = 1 / 1024


def forces(part: Any, path: np.ndarray, dt: float = DT) -> np.ndarray:
    """Force after each displacement of a path that starts at rest at 0."""
    parameters, state = part.build(dt)
    return np.array([part.step(parameters, state, x, dt) for x in path])


def sine(amplitude: float, cycles: int, frequency: float = 1.0) -> np.ndarray:
    return np.asarray(amplitude * np.sin(2 * np.pi * frequency * np.arange(1, int(cycles * 1024 / frequency) + 1) * DT))


def cycle_energy(part: Any, amplitude: float, frequency: float = 1.0) -> float:
    """Work of the last of two cycles of a sine, by the trapezoidal rule."""
    x = np.concatenate([[0.0], sine(amplitude, 2, frequency)])
    force = np.concatenate([[0.0], forces(part, x[1:])])
    half = len(x) // 2
    return float(np.trapezoid(force[half:], x[half:]))


@pytest.mark.parametrize(("exponent", "shape"), [(1.0, lambda r: 1 - np.exp(-r)), (2.0, np.tanh)])
@pytest.mark.parametrize("steps", [20, 400])
def test_bouc_wen_in_monotonic_loading_follows_its_closed_form(exponent: float, shape: Any, steps: int) -> None:
    part = BoucWen(stiffness=5e7, yield_force=1e5, post_yield_ratio=0.0, exponent=exponent)
    ratio = np.linspace(0, 6, steps + 1)[1:]
    for sign in (1, -1):
        force = forces(part, sign * ratio * 2e-3)
        assert force == pytest.approx(sign * 1e5 * shape(ratio), rel=2e-4)  # Runge-Kutta in parts of 0.5 / n, order 4


def test_bouc_wen_agrees_with_an_independent_solver_of_its_law() -> None:
    part = BoucWen(stiffness=5e7, yield_force=1e5, post_yield_ratio=0.1, exponent=1.5, fullness=0.8)
    amplitude, omega = 8e-3, 2 * np.pi

    def slope(t: float, zeta: np.ndarray) -> np.ndarray:
        v = amplitude * omega * np.cos(omega * t)
        return np.asarray(v / 2e-3 * (1 - np.abs(zeta) ** 1.5 * (0.8 * np.sign(v * zeta) + 0.2)))

    times = np.arange(1, 2049) * DT
    solved = solve_ivp(slope, (0, 2), [0.0], t_eval=times, rtol=1e-9, atol=1e-11, max_step=DT)
    exact = 0.1 * 5e7 * amplitude * np.sin(omega * times) + 0.9 * 1e5 * solved.y[0]
    assert np.max(np.abs(forces(part, sine(amplitude, 2)) - exact)) < 1e-4 * 1e5  # turning points fall between substeps


def test_bouc_wen_well_below_yield_is_its_spring() -> None:
    x = sine(2e-6, 1)
    assert forces(BoucWen(stiffness=5e7, yield_force=1e5), x) == pytest.approx(5e7 * x, rel=1e-6, abs=1e-4)


def test_a_sharp_bouc_wen_dissipates_what_an_elastoplastic_spring_does() -> None:
    part = BoucWen(stiffness=5e7, yield_force=1e5, post_yield_ratio=0.05, exponent=20.0)
    closed = 4 * 0.95 * 1e5 * (20e-3 - 2e-3)
    assert cycle_energy(part, 20e-3) == pytest.approx(closed, rel=0.01)  # the corner is rounded by about 1 / n


@pytest.mark.parametrize("fullness", [0.5, 0.75, 1.0])
def test_bouc_wen_dissipates_in_every_cycle_and_its_hysteretic_force_is_bounded(fullness: float) -> None:
    part = BoucWen(post_yield_ratio=0.0, fullness=fullness)
    energies = [cycle_energy(part, amplitude) for amplitude in (1e-4, 1e-3, 1e-2, 0.1)]
    assert all(0 < small < large for small, large in pairwise(energies))
    assert np.max(np.abs(forces(part, np.random.default_rng(1).normal(scale=0.1, size=300)))) <= part.yield_force


def test_hyperbolic_tangent_is_its_law_of_displacement_and_velocity() -> None:
    part = HyperbolicTangent(stiffness=1e6, damping=2e5, yield_force=1e5, velocity_scale=0.03, displacement_scale=0.02)
    x = 0.05 * np.arange(1, 500) * DT
    exact = 1e6 * x + 2e5 * 0.05 + 1e5 * np.tanh(0.05 / 0.03 + x / 0.02)
    assert forces(part, x) == pytest.approx(exact, rel=1e-12)


def test_a_slow_hyperbolic_tangent_is_a_dashpot() -> None:
    part = HyperbolicTangent(damping=1e5, yield_force=1e5, velocity_scale=0.1, displacement_scale=1e6)
    x = sine(1e-5, 1)  # v / v_0 below 1e-3, where tanh is its argument within 1e-6 / 3
    assert forces(part, x) == pytest.approx(forces(LinearSpecimen(damping=1e5 + 1e5 / 0.1), x), rel=1e-6, abs=1e-4)


def test_a_steep_hyperbolic_tangent_dissipates_like_friction_and_a_dashpot() -> None:
    part = HyperbolicTangent(damping=1e5, yield_force=1e5, velocity_scale=1e-4, displacement_scale=1e6)
    closed = 4 * 1e5 * 0.03 + np.pi * 1e5 * 2 * np.pi * 0.03**2
    assert cycle_energy(part, 0.03) == pytest.approx(closed, rel=1e-3)  # the sense turns within a substep


@pytest.mark.parametrize("slack", [0.0, 3e-3])
def test_a_friction_slider_dissipates_slip_force_times_slip(slack: float) -> None:
    part = FrictionSlider(slip_force=1e5, stiffness=1e8, slack=slack)
    closed = 4 * 1e5 * (0.02 - slack - 1e-3)
    assert cycle_energy(part, 0.02) == pytest.approx(closed, rel=2e-3)  # corners fall between substeps
    assert cycle_energy(part, 0.999 * (slack + 1e-3)) == pytest.approx(0.0, abs=1e-9)


def test_a_rigid_friction_slider_is_coulomb_friction() -> None:
    part = FrictionSlider(slip_force=1e5, stiffness=1e12)
    x = sine(0.01, 1)
    moves = np.diff(x, prepend=0.0)
    slips = np.abs(moves) > 2 * 1e5 / 1e12  # from one slip to the other
    assert slips.sum() > 1000
    assert forces(part, x)[slips] == pytest.approx(1e5 * np.sign(moves[slips]))


def test_the_slider_takes_up_its_slack_before_it_resists() -> None:
    part = FrictionSlider(slip_force=1e5, stiffness=1e8, slack=2e-3)
    path = [1e-3, 2e-3, 2.5e-3, 3e-3, 5e-3, 4.5e-3, 4e-3, 1e-3, 0.0, -0.5e-3, -1e-3, -4e-3]
    # slips to 2 mm at 5 mm, is free between 0 and 4 mm, and pulls from there to -1 mm
    exact = [0.0, 0.0, 5e4, 1e5, 1e5, 5e4, 0.0, 0.0, 0.0, -5e4, -1e5, -1e5]
    assert forces(part, np.array(path)) == pytest.approx(exact, abs=1e-6)


def test_the_slider_does_not_depend_on_the_size_of_the_steps() -> None:
    part = FrictionSlider(slip_force=1e5, stiffness=1e8, slack=2e-3)
    corners = np.array([0.0, 0.01, -0.004, 0.006, -0.02])
    fine = np.interp(np.arange(401) / 100, np.arange(5), corners)[1:]
    assert forces(part, fine)[99::100] == pytest.approx(forces(part, corners[1:]), rel=1e-9)


CHAIN = Elastomeric(stiffness=5e6, branch_stiffnesses=(8e6, 4e6, 2e6), relaxation_times=(0.02, 0.2, 2.0))


def test_the_maxwell_chain_is_exact_on_a_ramp() -> None:
    t = np.arange(1, 1025) * DT
    exact = 5e6 * 0.1 * t
    for k, tau in zip(CHAIN.branch_stiffnesses, CHAIN.relaxation_times, strict=True):
        exact += k * tau * 0.1 * (1 - np.exp(-t / tau))
    assert forces(CHAIN, 0.1 * t) == pytest.approx(exact, rel=1e-12)
    assert forces(CHAIN, 0.1 * t[31::32], 32 * DT) == pytest.approx(exact[31::32], rel=1e-12)


@pytest.mark.parametrize("frequency", [0.5, 2.0, 8.0])
def test_a_cycle_of_the_maxwell_chain_dissipates_by_its_loss_stiffness(frequency: float) -> None:
    omega = 2 * np.pi * frequency
    pairs = zip(CHAIN.branch_stiffnesses, CHAIN.relaxation_times, strict=True)
    loss = sum(k * omega * tau / (1 + (omega * tau) ** 2) for k, tau in pairs)
    x = sine(0.01, int(20 * frequency), frequency)  # 20 s, ten times the longest relaxation time
    cycle = int(1024 / frequency) + 1
    energy = np.trapezoid(forces(CHAIN, x)[-cycle:], x[-cycle:])
    assert energy == pytest.approx(np.pi * 0.01**2 * loss, rel=2e-3)  # sine as a polygon, omega dt = 0.05 at most


def test_the_maxwell_chain_is_all_its_springs_when_fast_and_the_first_when_slow() -> None:
    fast = forces(CHAIN, np.array([0.01]), 1e-6)[0]
    slow = forces(CHAIN, 1e-5 * np.arange(1, 1001), 1.0)[-1]
    assert fast == pytest.approx(19e6 * 0.01, rel=1e-4)
    assert slow == pytest.approx(5e6 * 0.01 + 1e-5 * (8e6 * 0.02 + 4e6 * 0.2 + 2e6 * 2.0), rel=1e-9)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"branch_stiffnesses": [1e6, 2e6], "relaxation_times": [0.1]}, "2 branch stiffnesses and 1 relaxation times"),
        ({"branch_stiffnesses": [], "relaxation_times": []}, "branch_stiffnesses.*at least 1"),
        ({"branch_stiffnesses": [1e6] * 5, "relaxation_times": [0.1] * 5}, "branch_stiffnesses.*at most 4"),
        ({"relaxation_times": [0.1, 0.0]}, r"relaxation_times\.1 = 0.*needs a value > 0"),
    ],
)
def test_a_maxwell_chain_with_wrong_branches_is_named(change: dict[str, Any], message: str) -> None:
    with pytest.raises(PlanError, match=message):
        validated(Elastomeric, change)
