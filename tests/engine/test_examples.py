"""Templates beside Table III: each kind of test has one, and it shows what it says."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.planning import templates
from rths_engine.planning.examples import EXAMPLES
from rths_engine.planning.kinds_of_test import TESTS
from rths_engine.planning.paper import PAPER
from rths_engine.planning.reading import read_plan
from rths_engine.results.result import Result
from rths_engine.running.run import simulate

ALONE = [name for name in EXAMPLES if templates.template(name).test != "client"]  # those that run without another program


@pytest.fixture(scope="module")
def results() -> dict[str, Result]:
    return {name: simulate(read_plan(templates.template(name).as_dict())) for name in ALONE}


def test_every_example_runs_to_its_end(results: dict[str, Result]) -> None:
    assert {name: result.status for name, result in results.items()} == dict.fromkeys(ALONE, "completed")


def test_every_kind_of_test_has_a_template_under_a_heading_of_its_own() -> None:
    kinds = {templates.template(name).test: templates.group(name) for name in EXAMPLES}
    assert kinds.keys() == TESTS.keys()
    assert len(set(kinds.values())) == len(TESTS)
    assert {templates.group(name) for name in PAPER} == {templates.TABLE3}


def test_semi_active_control_lies_between_constant_currents_in_drift_and_below_both_in_acceleration(
    results: dict[str, Result],
) -> None:
    plan = templates.template("semi-active").as_dict()
    drift, acceleration = _drift_and_acceleration(results["semi-active"])
    constant = []
    for current in (0.0, 2.5):
        plan["stations"][0]["controller"] = {"kind": "constant", "current": current}
        constant.append(_drift_and_acceleration(simulate(read_plan(plan))))
    off, on = constant
    assert on[0] < drift < 0.6 * off[0] and acceleration < 0.9 * min(off[1], on[1])


def _drift_and_acceleration(result: Result) -> tuple[float, float]:
    """Peak drift (m) and peak absolute acceleration (m/s^2) of the one storey; its 2 % of damping counts for little in it."""
    (storey,) = result.plan.as_dict()["structure"]["storeys"]
    x, force = result.signal("x_floor.1"), result.signal("f_meas.1")
    return float(np.abs(x).max()), float(np.abs(storey["stiffness"] * x + force).max() / storey["mass"])


def test_the_mr_damper_dissipates_more_in_larger_cycles(results: dict[str, Result]) -> None:
    result = results["specimen-mr-damper"]
    x, force = result.signal("x_meas.1"), result.signal("f_meas.1")
    work = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(x))])
    twelve = np.diff([work[min(round(end * 1024), len(work) - 1)] for end in np.arange(0, 61, 12)])
    assert len(twelve) == 5 and np.all(np.diff(twelve) > 0)


def test_the_swept_actuator_lags_ever_more(results: dict[str, Result]) -> None:
    result = results["actuator-sweep"]
    error = np.abs(result.signal("error.1"))
    assert np.all(np.diff([part.max() for part in np.array_split(error, 5)[:4]]) > 0)  # the last fades out


def test_the_released_building_swings_in_its_first_period_and_decays_by_its_damping(results: dict[str, Result]) -> None:
    result = results["structure-free-vibration"]
    roof, period = result.signal("x_floor.3"), float(result.model.periods[0])
    rising = np.flatnonzero((roof[:-1] < 0) & (roof[1:] >= 0)) * result.dt
    # crossings are read to a substep; the higher modes, 2 % too, have gone after the first five cycles
    assert np.diff(rising)[5:20].mean() == pytest.approx(period / np.sqrt(1 - 0.02**2), rel=2e-3)
    peaks = [np.abs(roof[round(k * period / result.dt) : round((k + 1) * period / result.dt)]).max() for k in (6, 16)]
    assert np.log(peaks[0] / peaks[1]) == pytest.approx(10 * 2 * np.pi * 0.02, rel=0.02)


def test_the_shaken_model_resonates(results: dict[str, Result]) -> None:
    result = results["structure-matrices"]
    static = 2.0e4 * np.linalg.inv(np.array(result.plan.structure.stiffness))[2, 2]  # type: ignore[union-attr]
    assert result.summary()["floors_peak_mm"][2] > 5 * 1e3 * static
