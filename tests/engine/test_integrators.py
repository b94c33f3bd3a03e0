"""What every integrator promises: order of accuracy, stability limit, dissipation; and what they are to each other."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.parts.integrators import KINDS
from rths_engine.parts.integrators.kr_alpha import KrAlphaIntegrator
from rths_engine.planning.model import Model
from rths_engine.stability.closed_loop import ClosedLoop
from tests.engine.plans import NO_LIMITS, building, completed, make, shaking

PERIOD, RATIO = 0.5, 0.05
OMEGA = 2 * np.pi / PERIOD
STRUCTURE = building([1.0e5], [1.0e5 * OMEGA**2], RATIO)
STILL = {"kind": "none"}
ALL = [{"kind": kind.model_fields["kind"].default} for kind in KINDS if kind is not KrAlphaIntegrator]
ALL += [{"kind": "kr_alpha", "rho": rho} for rho in (0.0, 0.5, 0.75, 1.0)]


def exact(time: np.ndarray, x0: float, v0: float) -> np.ndarray:
    damped = OMEGA * np.sqrt(1 - RATIO**2)
    decay = np.exp(-RATIO * OMEGA * time)
    return np.asarray(decay * (x0 * np.cos(damped * time) + (v0 + RATIO * OMEGA * x0) / damped * np.sin(damped * time)))


def largest_error(dt: float, integrator: dict[str, Any]) -> float:
    start = {"displacement": [0.01], "velocity": [0.05]}
    run = completed(make(STRUCTURE, STILL, dt, test="structure", start=start, duration=4 * PERIOD, **integrator))
    time = np.arange(len(run.history)) * dt
    return float(np.max(np.abs(run.history[:, 0, 0] - exact(time, 0.01, 0.05))))


@pytest.mark.parametrize("integrator", ALL, ids=str)
def test_free_vibration_from_a_planned_start_is_second_order_accurate(integrator: dict[str, Any]) -> None:
    errors = [largest_error(PERIOD / steps, integrator) for steps in (64, 128, 256, 512)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(2.0, abs=0.12)  # rho = 0 has the largest third-order term
    # (omega dt)^2 / 12 a cycle over 4 cycles is 3e-4 of the 10 mm; rho = 0 has 5 times the period error of CR
    assert errors[-1] < 2e-3 * 0.01


@pytest.mark.parametrize("integrator", ALL, ids=str)
def test_a_harmonic_force_reaches_the_closed_form_of_resonance(integrator: dict[str, Any]) -> None:
    force = {"floor": 1, "amplitude": 1.0e4, "shape": {"kind": "sine", "frequency": 1 / PERIOD, "cycles": 40, "ramps": 0}}
    run = completed(make(STRUCTURE, STILL, PERIOD / 200, test="structure", forces=[force], **integrator))
    last = run.history[-200:, 0, 0]
    assert np.max(np.abs(last)) == pytest.approx(1.0e4 / (2 * RATIO * 1.0e5 * OMEGA**2), rel=2e-3)  # (omega dt)^2 and 40 cycles


def test_kr_alpha_that_dissipates_nothing_is_cr() -> None:
    ground = shaking(np.sin(np.arange(200) * 0.05) ** 3, 0.02)
    structure = building([1.0e5, 2.0e5], [3.0e7, 2.0e7], 0.02)
    cr = completed(make(structure, ground, 0.01))
    kr = completed(make(structure, ground, 0.01, kind="kr_alpha", rho=1.0))
    assert kr.history[:, 0] == pytest.approx(cr.history[:, 0], abs=1e-12 * np.abs(cr.history[:, 0]).max())


def test_central_difference_gives_the_displacements_of_explicit_newmark() -> None:
    ground = shaking(np.sin(np.arange(200) * 0.05) ** 3, 0.02)
    runs = [completed(make(STRUCTURE, ground, 0.01, kind=kind)) for kind in ("explicit_newmark", "central_difference")]
    assert np.array_equal(runs[0].history[:, 0], runs[1].history[:, 0])


@pytest.mark.parametrize("rho", [0.0, 0.5, 0.9, 1.0])
def test_a_very_high_mode_decays_by_the_spectral_radius_each_step(rho: float) -> None:
    dt = 0.01
    stiff = building([10.0], [10.0 * (1e4 / dt) ** 2])
    plan = make(stiff, STILL, dt, kind="kr_alpha", rho=rho, duration=1.0, stations=[station(0.0)])
    assert ClosedLoop(plan).radius() == pytest.approx(rho, abs=3e-3)  # a triple root: reached as (omega dt)^(-2/3)


@pytest.mark.parametrize("integrator", ALL, ids=str)
def test_the_predicted_growth_of_a_loop_is_the_simulated_one(integrator: dict[str, Any]) -> None:
    """One storey with a spring of as much stiffness behind a delay of 3 steps: unstable, as delay is negative damping."""
    start = np.array([1e-9])
    plan = make(STRUCTURE, STILL, 0.01, duration=12.0, stations=[station(1.0e5 * OMEGA**2)], **integrator)
    predicted = ClosedLoop(plan).radius()
    assert predicted > 1.005
    x = completed(plan, initial=(start, start)).history[700:, 0, 0]  # by then the growing pair of roots is all there is
    recurrence = np.linalg.lstsq(np.column_stack([x[1:-1], x[:-2]]), x[2:], rcond=None)[0]
    assert np.abs(np.roots([1, *-recurrence])) == pytest.approx(predicted, rel=1e-9)  # the others have decayed by 1e-11


def station(stiffness: float) -> dict[str, Any]:
    return {
        "compensator": {"kind": "none"},
        "actuator": {"kind": "first_order_delay", "alpha": 4.0, "velocity_limit": 10.0, "force_limit": 1e8},
        "specimen": {"kind": "linear", "stiffness": stiffness, "damping": 0.0},
        "limits": NO_LIMITS,
    }


@pytest.mark.parametrize("kind", ["explicit_newmark", "central_difference"])
def test_a_step_beyond_the_stability_limit_is_refused_with_the_step_to_take(kind: str) -> None:
    make(STRUCTURE, STILL, 1.24 / OMEGA, kind=kind, duration=1.0)
    slow = building([1.0e5], [1.0e5 * OMEGA**2 / 10], RATIO)
    assert 2 / OMEGA > 0.1  # the schema's bound comes first for this one
    stiff = building([1.0e5], [1.0e5 * OMEGA**2 * 100], RATIO)
    make(slow, STILL, 0.0099, kind=kind, duration=1.0)
    with pytest.raises(PlanError, match=r"integrator\.dt.*unstable above 2.*at most 0\.0159 s"):
        make(stiff, STILL, 2.01 / (10 * OMEGA), kind=kind, duration=1.0)


def test_an_integrator_that_needs_mass_everywhere_refuses_a_frame_with_massless_rotations() -> None:
    storey = {"height": 4.0, "mass": 2e5, "column": "W14x120", "beam": "W24x55"}
    frame = {"kind": "moment_frame", "bays": [8.0], "storeys": [storey]}
    with pytest.raises(PlanError, match=r"without mass, which explicit newmark cannot integrate.*choose CR or KR"):
        make(frame, STILL, 0.01, kind="explicit_newmark", duration=1.0)
    make(frame, STILL, 0.01, kind="kr_alpha", rho=0.5, duration=1.0)


def test_a_frame_is_released_from_the_shape_that_its_floors_impose() -> None:
    """The other degrees of freedom follow statically: the first step then moves nothing by more than inertia does."""
    storey = {"height": 4.0, "mass": 2e5, "column": "W14x120", "beam": "W24x55"}
    frame = {"kind": "moment_frame", "bays": [8.0], "storeys": [storey], "damping_ratio": 0.0, "p_delta": False}
    plan = make(frame, STILL, 0.002, test="structure", start={"displacement": [0.005]}, duration=4.0)
    omega = 2 * np.pi / Model(plan).periods[0]
    x = completed(plan).history[:, 0, 0]
    time = np.arange(len(x)) * 0.002
    assert x == pytest.approx(0.005 * np.cos(omega * time), abs=0.005 * 2e-3)  # (omega dt)^2 / 24 times the phase
