"""Left-out effects as part of a plan: in the compiled loop they do what their replay does, and at neutral values nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.parts import physics
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.physics.specimen.viscous_heating import ViscousHeating
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_from_yaml, plan_to_yaml, read_plan
from rths_engine.running import replay
from rths_engine.running.run import simulate
from tests.engine.plans import LIBRARY, building, make, shaking
from tests.engine.test_kinds_of_test import driven

TIME = np.arange(401) * 0.01
GROUND = shaking(2.0 * np.sin(2 * np.pi * 1.3 * TIME) * np.sin(np.pi * TIME / 4) ** 2, 0.01)
STRUCTURE = building([3.0e5, 3.0e5], [2.0e7, 1.5e7], 0.02)
STATION = {
    "compensator": {"kind": "none"},
    "specimen": {"kind": "linear", "damping": 1e5},
    "actuator": {"kind": "first_order_delay", "alpha": 2},
}
FIELDS = {"specimen": physics.SPECIMEN, "actuator": physics.ACTUATOR, "sensor": physics.SENSOR}


def hybrid(station: dict[str, Any], **more: Any) -> Plan:
    return make(STRUCTURE, GROUND, 10 / 1024, substeps=10, stations=[{**STATION, **station}], **more)


def neutral(kind: type[Any]) -> dict[str, Any]:
    return {**kind.model_validate({**kind.neutral}).model_dump()}


@pytest.mark.parametrize("component", FIELDS)
def test_effects_of_a_station_at_neutral_values_change_nothing(component: str) -> None:
    plain = simulate(hybrid({}), LIBRARY).signals
    for start in range(0, len(FIELDS[component]), 8):
        effects = [neutral(kind) for kind in FIELDS[component][start : start + 8]]
        found = simulate(hybrid({f"{component}_physics": effects}), LIBRARY).signals
        assert found == pytest.approx(plain, abs=1e-9 * np.abs(plain).max())  # rounding, through a closed loop of 400 steps


def test_effects_of_structure_and_motion_at_neutral_values_change_nothing() -> None:
    plain = simulate(hybrid({}), LIBRARY).signals
    for field, kinds in (("structure_physics", physics.STRUCTURE), ("motion_physics", physics.INPUT)):
        for start in range(0, len(kinds), 7):
            found = simulate(hybrid({}, **{field: [neutral(kind) for kind in kinds[start : start + 7]]}), LIBRARY).signals
            assert found == pytest.approx(plain, abs=1e-9 * np.abs(plain).max())


def test_a_specimen_in_the_loop_is_the_specimen_replayed() -> None:
    effects = (Backlash(gap=0.004), ViscousHeating(fade=1e-5))
    plan = read_plan(
        driven(
            "specimen", station={"specimen": {"kind": "mr_damper"}, "specimen_physics": [one.model_dump() for one in effects]}
        )
    )
    result = simulate(plan, LIBRARY)
    x = result.signal("x_meas.1")
    from_rest = np.concatenate([[0.0], x])
    replayed = replay.specimen(MrDamper(), effects, from_rest, np.ones(len(from_rest)), result.dt)[1:]
    # the loop centres the play at its first sample, the replay a substep before, at rest
    assert result.signal("f_meas.1") == pytest.approx(replayed, abs=1e-6 * np.abs(replayed).max())
    plain = simulate(read_plan(driven("specimen", station={"specimen": {"kind": "mr_damper"}})), LIBRARY)
    assert np.abs(plain.signal("f_meas.1") - replayed).max() > 0.1 * np.abs(replayed).max()


def test_a_storey_with_cubic_stiffness_settles_where_its_law_says() -> None:
    force = {"floor": 1, "amplitude": 4.0e5, "shape": {"kind": "step", "delay": 0.0, "rise": 2.0, "duration": 30.0}}
    cubic = {"kind": "cubic_stiffness", "storey": 1, "stiffness": 5.0e10}
    plan = make(
        building([1e5], [2e7], 0.1), {"kind": "none"}, 0.01, test="structure", forces=[force], structure_physics=[cubic]
    )
    x = simulate(plan, LIBRARY).signal("x_floor.1")[-1]
    assert 2e7 * x + 5e10 * x**3 == pytest.approx(4.0e5, rel=1e-6)  # 10 % damping over 30 s


def test_a_floor_heavier_than_its_model_has_a_longer_period() -> None:
    plan = make(building([1e5], [2e7]), GROUND, 0.01, structure_physics=[{"kind": "mass_error", "storey": 1, "share": 0.21}])
    plain = Model(make(building([1e5], [2e7]), GROUND, 0.01)).periods[0]
    assert Model(plan).periods[0] == pytest.approx(1.1 * plain, rel=1e-12)


def test_a_ground_motion_scaled_wrongly_shakes_a_linear_test_as_much_more() -> None:
    plain = simulate(hybrid({}), LIBRARY)
    more = simulate(hybrid({}, motion_physics=[{"kind": "scale_error", "share": 0.1}]), LIBRARY)
    assert more.signal("x_floor.2") == pytest.approx(1.1 * plain.signal("x_floor.2"), abs=1e-9)


def test_a_plan_with_effects_survives_yaml() -> None:
    plan = hybrid({"specimen_physics": [{"kind": "backlash", "gap": 0.002}]}, structure_physics=[{"kind": "p_delta"}])
    assert plan_from_yaml(plan_to_yaml(plan)).digest == plan.digest


@pytest.mark.parametrize("kind", ["cubic_stiffness", "mass_error"])
def test_an_effect_of_a_storey_that_is_not_there_is_told_where(kind: str) -> None:
    with pytest.raises(PlanError, match=r"structure_physics\.1\.storey = 3: the structure has 2 storeys"):
        hybrid({}, structure_physics=[{"kind": "p_delta"}, {"kind": kind, "storey": 3}])


@pytest.mark.parametrize("field", ["structure_physics", "motion_physics"])
def test_effects_of_what_a_test_does_not_have_are_refused(field: str) -> None:
    effect = {"structure_physics": {"kind": "p_delta"}, "motion_physics": {"kind": "scale_error", "share": 0.1}}[field]
    with pytest.raises(PlanError, match=f"{field} = 1: is not used in this kind of test"):
        read_plan(driven("specimen", **{field: [effect]}))
