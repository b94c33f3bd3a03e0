"""The whole coupled run: against an independent solver, energy, trips, reproducibility."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.results import metrics
from rths_engine.running import oscillation
from rths_engine.running.run import Run, simulate
from tests.engine.plans import LIBRARY, NO_LIMITS, building, completed, make, shaking

TAU, STIFFNESS, DAMPING, DAMPERS = 0.01, 2.0e6, 4.0e4, 2
STRUCTURE = building([2.0e5, 2.0e5], [3.0e7, 2.0e7], 0.02)
DURATION = 3.0


def ground(time: np.ndarray | float) -> Any:
    return 1.5 * np.sin(2 * np.pi * 1.1 * time) * np.sin(np.pi * time / DURATION) ** 2


def station(storey: int, **more: Any) -> dict[str, Any]:
    specimen = {"kind": "linear", "stiffness": STIFFNESS, "damping": DAMPING}
    given = {"name": f"S{storey}", "storey": storey, "dampers": DAMPERS, "specimen": specimen, "limits": NO_LIMITS}
    return {**given, "actuator": {"kind": "first_order_delay", "velocity_limit": 10.0}, **more}


def delayed_plan(dt: float) -> Plan:
    alpha = 1 + TAU / (dt / 2)
    parts = {"actuator": {"kind": "first_order_delay", "alpha": alpha}, "compensator": {"kind": "none"}}
    time = np.arange(int(DURATION / 0.001) + 2) * 0.001
    stations = [station(1, **parts), station(2, **parts)]
    return make(STRUCTURE, shaking(ground(time), 0.001), dt, substeps=2, stations=stations, duration=DURATION)


def reference(plan: Plan, times: np.ndarray) -> np.ndarray:
    """The continuous system: M a + C v + K x + L^T n (k y + c y') = -M ag with tau y' = L x - y."""
    built = plan.structure.assemble()
    mass, damping, stiffness = built.mass, built.damping, built.stiffness
    drifts = Model(plan).drifts

    def slope(t: float, state: np.ndarray) -> np.ndarray:
        x, v, y = state[:2], state[2:4], state[4:]
        y_rate = (drifts @ x - y) / TAU
        force = drifts.T @ (DAMPERS * (STIFFNESS * y + DAMPING * y_rate))
        a = np.linalg.solve(mass, -damping @ v - stiffness @ x - force) - ground(t)
        return np.concatenate([v, a, y_rate])

    solved = solve_ivp(slope, (0, DURATION), np.zeros(6), method="DOP853", t_eval=times, rtol=1e-10, atol=1e-13, max_step=0.005)
    displacements: np.ndarray = solved.y
    return displacements


def coupled_error(dt: float) -> float:
    run = completed(delayed_plan(dt))
    times = np.minimum(np.arange(len(run.history)) * dt, DURATION)
    exact = reference(run.plan, times)[:2].T
    return float(np.max(np.abs(run.history[:, 0] - exact)) / np.max(np.abs(exact)))


def test_the_coupled_run_converges_to_an_independent_solver() -> None:
    errors = np.array([coupled_error(dt) for dt in (1 / 2048, 1 / 4096, 1 / 8192)])
    assert errors[-1] < 5e-5
    # backward difference of the actuator (5a) over the substep makes the loop first order
    assert np.log2(errors[:-1] / errors[1:]) == pytest.approx(1.0, abs=0.2)


def energy_residual(dt: float) -> float:
    """Largest |input - kinetic - strain - damped - work of the dampers| over the largest input energy."""
    run = completed(delayed_plan(dt))
    built = run.plan.structure.assemble()
    mass, damping, stiffness = built.mass, built.damping, built.stiffness
    x = run.history[:, 0]
    v = np.gradient(x, dt, axis=0)  # CR's own velocity is the backward difference, half a step behind
    ag = ground(np.minimum(np.arange(len(x)) * dt, DURATION))
    stride = slice(1, None, 2)
    result = run.result("completed", 0.0)
    forces = np.stack([result.signal(f"f_meas.{j}")[stride] for j in (1, 2)], axis=1)
    forces = DAMPERS * np.concatenate([np.zeros((1, 2)), forces]) @ run.model.drifts

    def work(power: np.ndarray) -> np.ndarray:
        return np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * dt)])

    fed = work(-(v @ mass @ np.ones(2)) * ag)
    kinetic = 0.5 * np.einsum("ia,ab,ib->i", v, mass, v)
    strain = 0.5 * np.einsum("ia,ab,ib->i", x, stiffness, x)
    damped = work(np.einsum("ia,ab,ib->i", v, damping, v))
    absorbed = work(np.einsum("ia,ia->i", forces, v))
    return float(np.max(np.abs(fed - kinetic - strain - damped - absorbed)) / np.max(np.abs(fed)))


def test_the_energy_of_a_run_balances() -> None:
    residuals = [energy_residual(dt) for dt in (1 / 256, 1 / 512, 1 / 1024)]
    assert residuals[-1] < 2e-3
    assert residuals[1] < 0.6 * residuals[0] and residuals[2] < 0.6 * residuals[1]  # at least first order in dt


def mr_plan(**limits: float) -> Plan:
    time = np.arange(601) * 0.01
    stations = [
        {
            "name": f"S{storey}",
            "storey": storey,
            "dampers": 2,
            "specimen": {"kind": "mr_damper"},
            "actuator": {"kind": "first_order_delay", "alpha": 12},
            "noise": {"displacement": 2e-5, "force": 300.0},
            "limits": {**NO_LIMITS, **(limits if storey == 2 else {})},
        }
        for storey in (1, 2)
    ]
    structure = building([3.0e5, 3.0e5], [2.0e7, 1.5e7], 0.02)
    return make(structure, shaking(ground(time), 0.01), 10 / 1024, substeps=10, stations=stations, seed=7)


@pytest.mark.parametrize(("limit", "unit"), [("displacement", 1.0), ("velocity", 1024.0), ("force", 1.0)])
def test_a_trip_ends_the_run_in_the_first_substep_over_the_limit(limit: str, unit: float) -> None:
    free = simulate(mr_plan(), LIBRARY)
    signal = {"displacement": "x_cmd.2", "velocity": "x_cmd.2", "force": "f_meas.2"}[limit]
    values = free.signal(signal)
    if limit == "velocity":
        values = np.diff(values, prepend=0.0) * unit
    bound = 0.7 * float(np.max(np.abs(values)))
    first = int(np.argmax(np.abs(values) > bound))
    tripped = simulate(mr_plan(**{limit: bound}), LIBRARY)
    assert tripped.status == "tripped" and tripped.trip is not None
    assert (tripped.trip.station, tripped.trip.limit, tripped.trip.bound) == (2, limit, bound)
    assert tripped.trip.substep == first + 1
    assert tripped.trip.time_s == pytest.approx((first + 1) / 1024)
    assert tripped.trip.value == pytest.approx(values[first], rel=1e-12)
    assert len(tripped.signals) == first
    assert np.array_equal(tripped.signals, free.signals[:first])
    assert "station 2 (S2)" in tripped.trip.sentence


def swinging(half_wave: float, ratio: float) -> list[float]:
    """Length of the row after every half wave of a command whose peaks, 100 mm/s at first, fall by `ratio`."""
    state, dt = np.zeros(oscillation.SIZE), 1 / 1024
    each = round(half_wave / dt)
    peaks = 0.1 * ratio ** np.repeat(np.arange(40), each)
    velocity = peaks * np.sin(np.pi * (np.arange(40 * each) + 0.5) / each)
    rows = [oscillation.half_waves(state, v, dt) for v in velocity]
    return rows[each::each]


@pytest.mark.parametrize(
    ("half_wave", "ratio", "longest"),
    [(0.1, 1.0, 39), (0.1, 1.2, 39), (0.19, 1.0, 39), (0.21, 1.0, 0), (0.1, 0.75, 1), (0.1, 0.9, 3), (0.1, 0.99, 23)],
)
def test_half_waves_are_counted_while_an_oscillation_is_fast_and_does_not_die_out(
    half_wave: float, ratio: float, longest: int
) -> None:
    assert max(swinging(half_wave, ratio)) == longest


def test_an_unstable_loop_trips_rather_than_overflows() -> None:
    plan = mr_plan(velocity=0.3)
    data = plan.as_dict()
    for one in data["stations"]:
        one["specimen"] = {"kind": "linear", "stiffness": 5e9}
        one["compensator"] = {"kind": "none"}
        one["limits"] = {"displacement": 0.2, "velocity": 0.3}
    result = simulate(read_plan(data), LIBRARY)
    assert result.status == "tripped"
    assert np.isfinite(result.signals).all()


def test_a_run_is_the_same_to_the_bit_every_time_and_in_any_chunks() -> None:
    whole = simulate(mr_plan(), LIBRARY)
    run = Run(mr_plan(), LIBRARY)
    sizes = iter([1, 2, 3, 50, 7] * 1000)
    while not run.finished:
        run.advance(next(sizes))
    assert np.array_equal(run.signals, whole.signals)
    assert np.array_equal(run.history, whole.history)


def test_the_seed_decides_the_noise() -> None:
    other = mr_plan().model_copy(update={"seed": 8})
    assert not np.array_equal(simulate(other, LIBRARY).signals, simulate(mr_plan(), LIBRARY).signals)


def test_the_loop_records_the_indicator_and_energy_error_of_its_own_signals() -> None:
    result = simulate(mr_plan(), LIBRARY)
    x_cmd, x_meas, f_meas = (result.signal(f"{key}.1") for key in ("x_cmd", "x_meas", "f_meas"))
    indicator = metrics.tracking_indicator(x_cmd, x_meas)
    energy = metrics.energy_error(x_cmd, x_meas, f_meas)
    assert result.signal("ti.1") == pytest.approx(indicator, rel=1e-9, abs=1e-15)  # order of summation
    assert result.signal("energy_error.1") == pytest.approx(energy, rel=1e-9, abs=1e-9)
    assert result.signal("error.1") == pytest.approx(x_cmd - x_meas)


def test_the_command_ramps_in_equal_substeps() -> None:
    result = simulate(mr_plan(), LIBRARY)
    moves = np.diff(result.signal("x_cmd.1"), prepend=0.0).reshape(-1, 10)
    assert np.max(np.abs(moves - moves[:, :1])) < 1e-15


def test_the_second_storey_force_acts_on_both_floors() -> None:
    data = mr_plan().as_dict()
    data["stations"] = data["stations"][1:]
    data["structure"]["damping_ratio"] = 0.0
    run = Run(read_plan(data), LIBRARY)
    run.advance(200)
    force = 2 * run.result("cancelled", 0).signal("f_meas.1")[-1]
    assert run.model.drifts.T @ [force] == pytest.approx([-force, force])


def test_a_structure_alone_runs_without_stations() -> None:
    run = completed(make(STRUCTURE, shaking(ground(np.arange(300) * 0.01), 0.01), 0.005))
    assert [channel.key for channel in run.channels] == ["ag", "x_floor.1", "x_floor.2"]
    assert np.max(np.abs(run.signals[:, 2])) > 0.01
