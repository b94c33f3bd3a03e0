"""Preflight: what a dry run predicts is what the test then does, and its peaks are those of the recording."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.planning import templates
from rths_engine.planning.plan import Plan, RealTime
from rths_engine.planning.safety import Limits
from rths_engine.preflight import Capacity, dry_run, preflight
from rths_engine.running.run import simulate


def short(name: str = "two-storeys", seconds: float = 8.0, **limits: float) -> Plan:
    """The first seconds of a template, with some limits of its second station changed."""
    plan = templates.template(name)
    stations = [*plan.stations]
    stations[-1] = stations[-1].model_copy(update={"limits": stations[-1].limits.model_copy(update=limits)})
    return plan.model_copy(update={"duration": seconds, "stations": tuple(stations)})


def use(found: dict[str, Any], quantity: str, against: str = "limit", station: int = 1) -> dict[str, Any]:
    (one,) = [one for one in found["uses"] if (one["quantity"], one["against"], one["station"]) == (quantity, against, station)]
    return dict(one)


def test_a_plan_that_completes_has_the_peaks_of_its_recording() -> None:
    plan = short()
    found, result = preflight(plan), simulate(plan)
    assert (found["verdict"], found["trip"], found["without_limits"]) == ("completes", None, False)
    x_cmd, f_meas = result.signal("x_cmd.1"), result.signal("f_meas.1")
    assert use(found, "displacement")["peak"] == np.max(np.abs(x_cmd))
    assert use(found, "velocity")["peak"] == np.max(np.abs(np.diff(x_cmd, prepend=0.0) / result.dt))
    assert use(found, "force")["peak"] == np.max(np.abs(f_meas))
    assert use(found, "force")["share"] == pytest.approx(np.max(np.abs(f_meas)) / 1.0e6)
    assert found["floors"][0]["values"] == result.summary()[found["floors"][0]["key"]]
    assert found["stability"]["stable"] is True
    assert found["stability"]["stations"][1]["steps"] > 0


@pytest.mark.parametrize(
    ("limit", "bound"),
    [("velocity", 0.05), ("displacement", 0.01), ("force", 1.0e5)],
    ids=["velocity", "displacement", "force"],
)
def test_a_predicted_trip_is_the_trip_of_the_test_and_names_its_field(limit: str, bound: float) -> None:
    plan = short("two-storeys", 8.0, **{limit: bound})
    found, trip = preflight(plan), simulate(plan).trip
    assert trip is not None
    assert found["trip"]["path"] == f"stations.1.limits.{limit}"
    assert (found["trip"]["time_s"], found["trip"]["value"], found["trip"]["bound"]) == (trip.time_s, trip.value, bound)
    sentence = rf"Would trip at {trip.time_s:.2f} s: station 2 \(Storey 2 damper\), [a-z ]+ [\d.]+ > [\d.]+ [a-zA-Z/]+\."
    assert re.fullmatch(sentence, found["sentence"])


def test_beyond_a_trip_the_peaks_are_those_without_limits() -> None:
    limited, free = preflight(short(velocity=0.05)), preflight(short())
    assert limited["without_limits"]
    mine, full = use(limited, "velocity", station=2), use(free, "velocity", station=2)
    assert mine["peak"] == full["peak"]
    assert mine["share"] == pytest.approx(full["peak"] / 0.05)
    assert mine["beyond_s"] == limited["trip"]["time_s"]
    assert limited["floors"] == free["floors"]


def test_an_unstable_loop_is_said_to_grow_without_bound() -> None:
    plan = short("linear-damper", 12.0)
    parts = {"specimen": LinearSpecimen(stiffness=5.0e7, damping=0.0), "compensator": NoCompensation()}
    free = {"actuator": FirstOrderDelay(alpha=20.0, velocity_limit=10.0, force_limit=1.0e8)}
    stiff = plan.stations[0].model_copy(update=parts | free)
    found = preflight(plan.model_copy(update={"stations": (stiff,)}))
    assert found["verdict"] == "trips"
    assert "Without its limits the response grows without bound." in found["notes"]
    assert found["stability"]["stable"] is False


def test_the_piston_is_compared_with_actuator_and_rig() -> None:
    plan = short()
    found = preflight(plan, capacities=[Capacity(stroke=0.01, velocity=0.5), None])
    result = simulate(plan)
    noise = np.random.Generator(np.random.PCG64(plan.seed)).standard_normal((len(result.signals), 2, 2))
    piston = result.signal("x_meas.1") - noise[:, 0, 0] * plan.stations[0].noise.displacement
    stroke = use(found, "displacement", "rig")
    assert stroke["peak"] == pytest.approx(np.max(np.abs(piston)), rel=1e-12)
    assert stroke["path"] == "stations.0.actuator"
    assert any("exceeds the capacity of the rig" in note for note in found["notes"])
    velocity = np.max(np.abs(np.diff(piston, prepend=0.0))) / result.dt
    assert use(found, "velocity", "actuator")["peak"] == pytest.approx(velocity, rel=1e-9)
    assert {one["station"] for one in found["uses"] if one["against"] == "rig"} == {1}


def test_half_waves_are_counted_as_the_loop_counts_them() -> None:
    plan = short("table3-01", 20.0)
    stations = tuple(one.model_copy(update={"limits": Limits(oscillation=8, velocity=10.0)}) for one in plan.stations)
    found = preflight(plan.model_copy(update={"stations": stations}))
    rows = use(found, "oscillation", station=found["trip"]["station"])
    assert (found["trip"]["limit"], found["trip"]["value"]) == ("oscillation", 9.0)
    assert rows["beyond_s"] == found["trip"]["time_s"]


def test_the_pace_gives_the_expected_time_and_is_not_waited_for() -> None:
    found = preflight(short().model_copy(update={"pace": RealTime(factor=0.5)}))
    assert (found["duration_s"], found["expected_elapsed_s"]) == (8.0, 16.0)


def test_a_dry_run_is_bounded_in_time_and_says_what_it_covers() -> None:
    found = preflight(short(seconds=3600.0), budget_s=0.0)
    assert (found["verdict"], found["expected_elapsed_s"]) == ("incomplete", None)
    assert 0 < found["covered_s"] < 0.1  # the first step
    assert "of 3600 s; the rest was not simulated" in found["sentence"]
    assert "There was no time for the stability" in found["stability"]["notes"][-1]


def test_a_dry_run_is_bounded_in_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dry_run, "MOST_NUMBERS", 100_000)
    found = preflight(short())
    assert 3.0 < found["covered_s"] < 8.0
    assert found["verdict"] == "incomplete"


def test_a_test_of_a_structure_has_floors_and_no_loop() -> None:
    found = preflight(short_structure())
    assert (found["uses"], found["stability"], found["verdict"]) == ([], None, "completes")
    assert len(found["floors"][0]["values"]) == 3


def short_structure() -> Plan:
    return templates.template("structure-free-vibration").model_copy(update={"duration": 2.0})
