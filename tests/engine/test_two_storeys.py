"""The two-storey building with the compensation of Table III: what adaptation and missing compensation do."""

from __future__ import annotations

import pytest

from rths_engine.planning import templates
from rths_engine.planning.paper import PAPER
from rths_engine.results.result import Result
from rths_engine.running.run import simulate
from tests.engine.plans import two_storeys


@pytest.fixture(scope="module")
def results() -> dict[int, Result]:
    return {row.simulation: simulate(two_storeys(row.alpha_es, row.kp)) for row in PAPER.values()}


def test_without_compensation_the_loop_goes_beyond_its_limits(results: dict[int, Result]) -> None:
    assert results[1].trip is not None and results[1].trip.time_s < 5
    assert results[10].trip is not None  # the second storey left uncompensated


@pytest.mark.parametrize("simulation", [2, 4, 6, 9, 12])
def test_every_adaptive_simulation_runs_to_its_end(results: dict[int, Result], simulation: int) -> None:
    assert results[simulation].status == "completed"


@pytest.mark.parametrize(("fixed", "adaptive"), [(3, 4), (5, 6), (8, 9), (11, 12)])
def test_adaptation_at_least_halves_the_error_of_a_wrong_estimate(
    results: dict[int, Result], fixed: int, adaptive: int
) -> None:
    before, after = (results[simulation].summary()["stations"] for simulation in (fixed, adaptive))
    wrong = [(one, other) for one, other in zip(before, after, strict=True) if one["rms_percent"] > 1]
    assert wrong  # a station whose delay was estimated rightly has only its sensor's noise to show
    assert all(other["rms_percent"] < one["rms_percent"] / 2 for one, other in wrong)


def test_the_sign_of_the_indicator_tells_lag_from_overcompensation(results: dict[int, Result]) -> None:
    over = [station["mti_mm2"] for station in results[5].summary()["stations"]]
    lag = [station["mti_mm2"] for station in results[2].summary()["stations"]]
    assert all(value < 0 for value in over) and all(value > 0 for value in lag)


def test_simulation_2_is_of_the_papers_size(results: dict[int, Result]) -> None:
    ours, paper = results[2].summary(), PAPER["table3-02"]
    assert paper.mte_mm is not None
    # another record, a shear building and first-order delays: the size must be right, the digits can't be
    for station, mte in zip(ours["stations"], paper.mte_mm, strict=True):
        assert station["mte_mm"] == pytest.approx(mte, rel=0.25)
    assert ours["floors_peak_mm"] == pytest.approx([49.6, 94.6], rel=0.25)


def test_the_linear_example_runs_to_its_end() -> None:
    assert simulate(templates.template("linear-damper")).status == "completed"
