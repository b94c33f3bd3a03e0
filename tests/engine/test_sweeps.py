"""Sweeps: which points a definition makes, what it refuses, and that a point is the run of its plan."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy import stats

from rths_engine.foundation.errors import PlanError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import templates
from rths_engine.planning.reading import read_model
from rths_engine.running.run import simulate
from rths_engine.sweeps.columns import columns
from rths_engine.sweeps.design import Design, read_design
from rths_engine.sweeps.places import numbers
from rths_engine.sweeps.running import Points
from rths_engine.sweeps.sampling import shares

LIBRARY = MotionLibrary(None)
ALPHA = "stations.*.compensator.alpha_es"
DAMPING = "structure.damping_ratio"
NORTHRIDGE, EL_CENTRO = "northridge-1994-beverly-hills-009", "imperial-valley-1940-el-centro-ns"
SHORT = {**templates.template("two-storeys").as_dict(), "duration": 0.5}


def design(**given: Any) -> Design:
    return read_design({"name": "Sweep", "plan": SHORT, **given})


def sampled(
    law: dict[str, Any], path: str = DAMPING, samples: int = 2000, method: str = "latin_hypercube"
) -> np.ndarray[Any, Any]:
    one = design(method=method, samples=samples, seed=3, fields=[{"path": path, "distribution": law}])
    return np.array([one.inputs(point)[0] for point in range(one.count)])


def refusal(**given: Any) -> str:
    with pytest.raises(PlanError) as error:
        design(**given)
    return str(error.value)


def test_a_grid_has_every_combination_and_its_last_field_varies_fastest() -> None:
    one = design(fields=[{"path": ALPHA, "values": [10, 20]}, {"path": DAMPING, "values": ["1 %", 0.02, "30e-3"]}])
    assert one.count == 6
    assert [one.inputs(point) for point in range(6)] == [[a, d] for a in (10.0, 20.0) for d in (0.01, 0.02, 0.03)]
    plan = one.data(4)
    assert [station["compensator"]["alpha_es"] for station in plan["stations"]] == [20.0, 20.0]
    assert plan["structure"]["damping_ratio"] == 0.02
    assert one.base["structure"]["damping_ratio"] == SHORT["structure"]["damping_ratio"]  # the plan itself stays as it is


def test_records_times_scales_times_fields_are_counted_without_being_made() -> None:
    one = design(
        records=[NORTHRIDGE, EL_CENTRO],
        scales={"kind": "pga", "range": {"from": "0.1 g", "to": "0.4 g", "count": 4}},
        fields=[
            {"path": DAMPING, "range": {"from": 1, "to": 4, "count": 100}, "unit": "%"},
            {"path": ALPHA, "values": [1, 30]},
        ],
    )
    assert one.count == 2 * 4 * 100 * 2
    motion = one.data(one.count - 1)["motion"]
    assert (motion["record"], motion["scale"]["kind"]) == (EL_CENTRO, "pga")
    assert motion["scale"]["pga"] == pytest.approx(0.4 * 9.80665)


def test_a_range_has_equal_differences_or_equal_ratios() -> None:
    linear, log = (
        design(fields=[{"path": ALPHA, "range": {"from": 1, "to": 100, "count": 3, "spacing": spacing}}])
        for spacing in ("linear", "log")
    )
    assert linear.axes[0].levels == pytest.approx([1, 50.5, 100])
    assert log.axes[0].levels == pytest.approx([1, 10, 100])


def test_a_list_takes_the_values_of_all_fields_together() -> None:
    one = design(method="list", fields=[{"path": ALPHA, "values": [10, 20]}, {"path": DAMPING, "values": [0.01, 0.05]}])
    assert [one.inputs(point) for point in range(one.count)] == [[10.0, 0.01], [20.0, 0.05]]
    assert "as many values" in refusal(
        method="list", fields=[{"path": ALPHA, "values": [10]}, {"path": DAMPING, "values": [0.01, 0.05]}]
    )


def test_one_at_a_time_begins_with_the_plan_itself() -> None:
    one = design(method="one_at_a_time", fields=[{"path": ALPHA, "values": [10, 20]}, {"path": DAMPING, "values": [0.05]}])
    assert [one.inputs(point) for point in range(one.count)] == [[30, 0.02], [10, 0.02], [20, 0.02], [30, 0.05]]
    assert one.data(0)["stations"] == SHORT["stations"]


def test_a_factor_multiplies_what_each_field_has_in_the_plan() -> None:
    paths = ["structure.storeys.0.stiffness", "structure.storeys.1.stiffness"]
    one = design(fields=[{"path": paths, "change": "multiply", "values": ["90 %", 1.1]}])
    stiffnesses = [storey["stiffness"] for storey in one.data(0)["structure"]["storeys"]]
    assert stiffnesses == pytest.approx([0.9 * 36007e3, 0.9 * 23894e3])
    assert one.axes[0].label == "Factor of Structure: Storey 1, 2: Storey stiffness"


def test_a_part_can_be_chosen_as_a_whole() -> None:
    parts = [{"kind": "none"}, {"kind": "inverse", "alpha_es": 30.0}]
    one = design(fields=[{"path": "stations.*.compensator", "values": parts}])
    assert one.axes[0].names == ["none", "inverse (alpha_es 30)"]
    assert [station["compensator"] for station in one.data(1)["stations"]] == [parts[1]] * 2
    said = refusal(fields=[{"path": "stations.0.compensator", "values": [{"kind": "inverse", "alpha_es": 0.5}]}])
    assert "fields.0.values.0" in said and "needs a value >= 1" in said


def test_a_latin_hypercube_has_one_sample_in_each_interval_and_follows_its_seed() -> None:
    found = shares("latin_hypercube", 50, 3, 7)
    assert all(sorted((column * 50).astype(int)) == list(range(50)) for column in found.T)
    assert np.array_equal(found, shares.__wrapped__("latin_hypercube", 50, 3, 7))
    assert not np.array_equal(found, shares("latin_hypercube", 50, 3, 8))


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        ({"kind": "uniform", "lower": "1 %", "upper": "5 %"}, stats.uniform(0.01, 0.04)),
        ({"kind": "normal", "mean": 0.03, "sd": 0.02, "lower": 0.01}, stats.truncnorm(-1, 48.5, 0.03, 0.02)),
        ({"kind": "lognormal", "median": 0.02, "sigma_ln": 0.4}, stats.lognorm(0.4, scale=0.02)),
    ],
)
def test_samples_have_the_stated_distribution(law: dict[str, Any], expected: Any) -> None:
    """2000 samples of a Latin hypercube are within 1 / 2000 of the distribution function; of Monte Carlo, 1.63 / sqrt(2000)."""
    assert stats.kstest(sampled(law), expected.cdf).statistic < 1 / 2000
    assert stats.kstest(sampled(law, method="monte_carlo"), expected.cdf).statistic < 1.63 / math.sqrt(2000)


def test_a_distribution_is_truncated_at_the_bounds_of_the_field_and_it_is_said() -> None:
    law = {"kind": "normal", "mean": "2 %", "sd": "2 %"}
    assert sampled(law).min() >= 0
    one = design(method="monte_carlo", samples=10, fields=[{"path": DAMPING, "distribution": law}])
    assert one.notes == [
        "Structure: Damping ratio of modes 1 and 2: truncated to 0 % to 100 % by the bounds of the field: 16 % of its "
        "probability is cut off."
    ]
    wrong = {"kind": "normal", "mean": -5, "sd": 0.1}
    assert "has only 0 % of its probability" in refusal(
        method="monte_carlo", samples=10, fields=[{"path": DAMPING, "distribution": wrong}]
    )


def test_samples_of_a_whole_number_are_whole() -> None:
    found = sampled({"kind": "uniform", "lower": 1, "upper": 6}, "stations.*.dampers", samples=50)
    assert set(found) == {1, 2, 3, 4, 5, 6}


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"fields": []}, "fields: nothing varies (add a field, records or scales)"),
        ({"fields": [{"path": "structure.damping", "values": [1]}]}, "has no field 'damping' (did you mean damping_ratio?)"),
        (
            {"fields": [{"path": "stations.5.dampers", "values": [1]}]},
            "needs an index from 0 to 1, or * for every item, not '5'",
        ),
        ({"fields": [{"path": "name", "values": ["a"]}]}, "does not change the result of a test"),
        (
            {"fields": [{"path": DAMPING, "values": [2]}]},
            "fields.0.values.0 = 200 %: Structure: Damping ratio of modes 1 and 2 needs",
        ),
        ({"fields": [{"path": DAMPING, "values": ["2 mm"]}]}, "fields.0.values.0 = 2 mm: needs a unit of number"),
        ({"fields": [{"path": DAMPING, "values": [1], "unit": "kN"}]}, "fields.0.unit = kN: is not a unit of number"),
        ({"fields": [{"path": "stations.0.dampers", "values": [1.5]}]}, "needs a whole number"),
        ({"fields": [{"path": DAMPING}]}, "needs exactly one of values, range and distribution, not 0"),
        ({"fields": [{"path": DAMPING, "values": [0.1]}, {"path": DAMPING, "values": [0.2]}]}, "is varied by fields.0 too"),
        ({"fields": [{"path": [DAMPING, "duration"], "values": [0.1]}]}, "gives one value to fields of different units"),
        (
            {"fields": [{"path": DAMPING, "range": {"from": 0, "to": 1, "count": 3, "spacing": "log"}}]},
            "needs a value > 0 where",
        ),
        ({"fields": [{"path": "stations.0.equivalent_damping", "change": "multiply", "values": [2]}]}, "zero in the plan"),
        ({"method": "monte_carlo", "fields": [{"path": DAMPING, "values": [0.1]}]}, "samples: is required by the method"),
        ({"samples": 5, "fields": [{"path": DAMPING, "values": [0.1]}]}, "samples = 5: is not used by the method grid"),
        ({"records": [NORTHRIDGE] * 2}, "records.1 = northridge-1994-beverly-hills-009: is listed twice"),
        ({"scales": {"values": [1]}, "fields": [{"path": "motion.scale.factor", "values": [1]}]}, "which a field varies too"),
        (
            {"plan": "table3-99", "fields": [{"path": DAMPING, "values": [0.1]}]},
            "plan: the template 'table3-99' does not exist",
        ),
        ({"colour": 1}, "colour"),
    ],
)
def test_a_definition_that_cannot_be_executed_is_refused_with_its_place(given: dict[str, Any], said: str) -> None:
    assert said in refusal(**given)


def test_a_sweep_of_too_many_points_is_refused_before_any_is_made() -> None:
    fields = [{"path": f"stations.{n}.noise.force", "range": {"from": 0, "to": 1, "count": 1000}} for n in (0, 1)]
    assert refusal(fields=fields).startswith("makes 1,000,000 points; a sweep has at most 100,000")


def test_every_number_of_a_plan_can_be_varied_by_the_path_that_is_offered() -> None:
    plan = templates.template("two-storeys")
    offered = numbers(plan)
    assert {ALPHA.replace("*", "0"), DAMPING, "motion.scale.factor", "seed"} <= {one.path for one in offered}
    assert not any(one.path.startswith("drive") for one in offered)  # a hybrid test does not use it
    for one in offered:
        level = 1.0 if one.value is None else one.value
        assert design(fields=[{"path": one.path, "values": [level]}]).count == 1


def test_a_point_has_the_measures_of_the_run_of_its_plan_to_the_bit() -> None:
    one = design(
        fields=[{"path": ALPHA, "values": [20, 30]}], records=[NORTHRIDGE], scales={"kind": "pga", "values": ["0.2 g"]}
    )
    own = columns(one)
    points = Points(one, own, LIBRARY)
    for point in (0, 1):
        row = points.row(point)
        assert row is not None and row.reason is None
        found = dict(zip((column.key for column in own), row.values, strict=True))
        summary = simulate(read_model(one.data(point)), LIBRARY).summary()
        for number, station in enumerate(summary["stations"], start=1):
            for key, value in station.items():
                if key != "name":
                    assert found[f"{key}.{number}"] == value or (math.isnan(found[f"{key}.{number}"]) and value is None)
        assert [found["floors_peak_mm.1"], found["floors_peak_mm.2"]] == summary["floors_peak_mm"]
        assert found["input_energy_kNm"] == summary["input_energy_kNm"]
        assert found["pga_g"] == pytest.approx(0.2) and found["t1_s"] == pytest.approx(1.48)


def test_a_point_that_trips_or_is_not_valid_has_its_reason() -> None:
    one = design(
        fields=[
            {"path": "stations.0.limits.displacement", "values": [1e-9, 0.2]},
            {"path": "integrator.dt", "values": [0.009765625, 0.01]},
        ]
    )
    own = columns(one)
    points = Points(one, own, LIBRARY)
    status = [column.key for column in own].index("status")
    rows = [points.row(point) for point in range(4)]
    assert [own[status].categories[int(row.values[status])] for row in rows if row] == [
        "tripped",
        "invalid",
        "completed",
        "invalid",
    ]
    assert rows[0] and rows[0].reason and rows[0].reason.startswith("Tripped at ")
    assert rows[1] and rows[1].reason and "integrator.dt" in rows[1].reason


def test_a_cancelled_point_has_no_row() -> None:
    one = design(fields=[{"path": ALPHA, "values": [20]}])
    assert Points(one, columns(one), LIBRARY).row(0, lambda: True) is None
