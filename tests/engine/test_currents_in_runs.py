"""Currents in runs: a controller in the loop, its current in the recording, and its replay."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.parts.specimens.mr_damper_current import MrDamperCurrent
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_from_yaml, plan_to_yaml, read_plan
from rths_engine.planning.templates import template
from rths_engine.running import replay
from rths_engine.running.run import simulate
from rths_engine.stability.report import summary

CLIPPED = {"kind": "clipped_optimal", "velocity_gain": 4e5, "largest_current": 2.5}
ON_OFF = {"kind": "on_off", "off_current": 0.1, "on_current": 2.0}
CONSTANT = {"kind": "constant", "current": 1.2}


def semi_active(controller: dict[str, Any], **fields: Any) -> Plan:
    """The linear damper's test with MR dampers under a controller, for 8 s."""
    plan = template("linear-damper").as_dict()
    for station in plan["stations"]:
        station |= {"specimen": {"kind": "mr_damper_current"}, "controller": controller, **fields}
    return read_plan({**plan, "duration": 8.0})


@pytest.mark.parametrize("controller", [CLIPPED, ON_OFF, CONSTANT], ids=lambda one: one["kind"])
def test_a_recording_holds_the_current_and_replays_to_its_force(controller: dict[str, Any]) -> None:
    result = simulate(semi_active(controller, noise={"displacement": 0.0, "force": 0.0}))
    current, force = result.signal("current.1"), result.signal("f_meas.1")
    assert result.channels[-1].key.startswith("current.") and result.channels[-1].unit == "A"
    assert set(np.unique(current)) <= {0.0, 0.1, 1.2, 2.0, 2.5} and (controller is CONSTANT or np.ptp(current) > 0)
    again = replay.specimen(MrDamperCurrent(), [], result.signal("x_meas.1"), current, result.dt)
    np.testing.assert_array_equal(again, force)


def test_the_commanded_current_follows_the_law_on_the_recorded_signals() -> None:
    result = simulate(semi_active(CLIPPED))
    x, force, current = (result.signal(key) for key in ("x_cmd.1", "f_meas.1", "current.1"))
    v, last = np.diff(x, prepend=0.0) / result.dt, np.concatenate([[0.0], force[:-1]])
    np.testing.assert_array_equal(current, np.where((4e5 * v - last) * last > 0, 2.5, 0.0))


def test_a_damper_without_current_lets_the_structure_move_more_than_one_under_control() -> None:
    controllers = (CLIPPED, {"kind": "constant", "current": 0.0})
    largest = [float(np.abs(simulate(semi_active(one)).signal("x_floor.1")).max()) for one in controllers]
    assert largest[0] < largest[1]


def test_a_plan_without_controller_keeps_its_digest_and_its_channels() -> None:
    plan = template("linear-damper")
    assert plan.digest == "dcdcd1f1bebf584d44b79c296d66d1de287ac4cb07a7b29faea40f94fa84437b"
    assert not [
        channel for channel in simulate(plan.model_copy(update={"duration": 0.1})).channels if channel.role == "current"
    ]
    assert semi_active(CLIPPED).digest != semi_active(ON_OFF).digest


def test_controller_and_temperature_survive_yaml_and_enter_the_digest() -> None:
    plan = semi_active(CLIPPED, temperature=278.15, coil_resistance=4.8)
    assert plan_from_yaml(plan_to_yaml(plan)).digest == plan.digest != semi_active(CLIPPED).digest


def test_a_specimen_that_follows_a_current_needs_a_controller() -> None:
    with pytest.raises(PlanError, match=r"stations\.0\.controller.*'MR damper with current' follows a current"):
        semi_active({"kind": "none"})


def test_the_stability_of_a_semi_active_test_is_that_at_its_mean_current() -> None:
    passive = semi_active(CLIPPED)
    stations = tuple(one.model_copy(update={"specimen": MrDamperCurrent().at(1.25)}) for one in passive.stations)
    assert summary(passive) == summary(passive.model_copy(update={"stations": stations}))


@pytest.mark.parametrize(("temperature", "ratio"), [(293.15, 1.0), (303.15, np.exp(-0.1))])
def test_the_temperature_of_a_plan_acts_through_its_effect(temperature: float, ratio: float) -> None:
    effect = {"kind": "strength_against_temperature", "coefficient": 0.01, "reference": 293.15}
    plan = template("specimen-mr-damper").as_dict()
    plan["stations"][0] |= {"noise": {"displacement": 0.0, "force": 0.0}}
    plain = simulate(read_plan(plan)).signal("f_meas.1")
    plan["stations"][0] |= {"temperature": temperature, "specimen_physics": [effect]}
    assert simulate(read_plan(plan)).signal("f_meas.1") == pytest.approx(ratio * plain, rel=1e-12)
