"""CR integration against closed forms and its stability; what all integrators share is in test_integrators."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.factor import factorised
from rths_engine.parts.integrators.cr import CrIntegrator
from tests.engine.plans import building, completed, make, quiet

PERIOD, RATIO = 0.5, 0.05
OMEGA = 2 * np.pi / PERIOD
STRUCTURE = building([1.0e5], [1.0e5 * OMEGA**2], RATIO)


def free_vibration(time: np.ndarray, x0: float, v0: float) -> np.ndarray:
    damped = OMEGA * np.sqrt(1 - RATIO**2)
    decay = np.exp(-RATIO * OMEGA * time)
    return np.asarray(decay * (x0 * np.cos(damped * time) + (v0 + RATIO * OMEGA * x0) / damped * np.sin(damped * time)))


def largest_error(dt: float) -> float:
    """From x = 10 mm, v = 50 mm/s. CR's velocity is the backward difference of its displacements, and so is its start."""
    before = free_vibration(np.array([-dt]), 0.01, 0.05)[0]
    run = completed(make(STRUCTURE, quiet(4 * PERIOD), dt), initial=([0.01], [(0.01 - before) / dt]))
    time = np.arange(len(run.history)) * dt
    return float(np.max(np.abs(run.history[:, 0, 0] - free_vibration(time, 0.01, 0.05))))


def test_free_vibration_follows_the_closed_form() -> None:
    # CR's period elongation is (omega dt)^2 / 12 per cycle: 4 cycles at 512 steps a cycle give 3e-4 of the amplitude
    assert largest_error(PERIOD / 512) < 5e-4 * 0.01


def test_cr_is_second_order_accurate() -> None:
    errors = [largest_error(PERIOD / steps) for steps in (64, 128, 256, 512)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(2.0, abs=0.1)


def test_a_mode_far_above_the_step_rate_overshoots_but_does_not_grow() -> None:
    dt = 0.01
    stiff = 1.0e5 * (100 / dt) ** 2  # omega dt = 100 and more, far beyond any conditionally stable scheme's limit of 2
    run = completed(make(building([1.0e5, 1.0e5], [stiff, stiff]), quiet(20.0), dt), initial=([1e-3, -1e-3], [0.0, 0.0]))
    peaks = np.max(np.abs(run.history[1:, 0]).reshape(4, -1), axis=1)
    assert peaks[1:] == pytest.approx(peaks[0], rel=0.02)  # two modes beat: a quarter need not hold the highest peak
    assert peaks[0] < 1e-3 * 200  # CR's overshoot is about omega dt


def test_modes_of_a_two_storey_building_vibrate_apart() -> None:
    structure = building([2.0e5, 2.0e5], [3.0e7, 2.0e7], 0.02)
    plan = make(structure, quiet(3.0), 1 / 1024)
    built = plan.structure.assemble()
    mass, stiffness = built.mass, built.stiffness
    squares, shapes = np.linalg.eigh(stiffness / mass[0, 0])
    omega = np.sqrt(squares[1])
    exact = second_mode(np.arange(-1, 3 * 1024 + 1) / 1024, omega)
    start = (exact[1] - exact[0]) * 1024
    run = completed(plan, initial=(exact[1] * shapes[:, 1], start * shapes[:, 1]))
    first = run.history[:, 0] @ shapes[:, 0]
    second = run.history[:, 0] @ shapes[:, 1]
    assert np.max(np.abs(first)) < 1e-14  # orthogonal to rounding
    assert np.max(np.abs(second - exact[1:])) < 3e-3 * 0.01  # (omega dt)^2 / 12 over 7 cycles


def second_mode(time: np.ndarray, omega: float) -> np.ndarray:
    root = np.sqrt(1 - 0.02**2)
    swing = np.cos(root * omega * time) + 0.02 / root * np.sin(root * omega * time)
    return np.asarray(0.01 * np.exp(-0.02 * omega * time) * swing)


def test_a_massless_degree_of_freedom_needs_stiffness_or_damping() -> None:
    mass, none = np.diag([1.0, 0.0]), np.zeros((2, 2))
    assert (factorised(CrIntegrator().build(mass, none, np.diag([0.0, 1.0e3])).effective).pivot_inverse > 0).all()
    with pytest.raises(PlanError, match="singular"):
        factorised(CrIntegrator().build(mass, none, none).effective)
