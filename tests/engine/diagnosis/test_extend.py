"""The plan with what was found in it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.components import (
    Actuator,
    ActuatorData,
    Component,
    Specimen,
    SpecimenData,
    StepError,
    Structure,
    based,
)
from rths_engine.diagnosis.components.structure import StructureData
from rths_engine.diagnosis.extend import LEAST, MOST, extended
from rths_engine.diagnosis.fitting import Fitted
from rths_engine.diagnosis.judge import Judged
from rths_engine.foundation.part import Part
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.physics.input.scale_error import GroundScaleError
from rths_engine.parts.physics.sensor.offset import ForceOffset
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.physics.structure.coulomb_friction import CoulombFriction
from rths_engine.parts.physics.structure.damping_error import DampingError
from rths_engine.parts.physics.structure.stiffness_error import StiffnessError
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from tests.engine import recorded_specimens as made
from tests.engine.diagnosis.made import as_judged, recordings, selected
from tests.engine.plans import building

X = np.sin(np.arange(300) / 20)
SPRING = LinearSpecimen(stiffness=2.2e6, damping=7e5)


def chosen(component: Component, data: Any, *parts: Part, unknown: bool = False) -> Judged:
    """As if the parts had been selected."""
    model = Fitted(parts, (), np.zeros(0), np.zeros(1), np.zeros((1, 0)), 1)
    return as_judged(selected(recordings(component, data), model, model), unknown=unknown)


def specimen(*parts: Part, unknown: bool = False) -> Judged:
    base = (made.BASELINE, StepError())
    data = SpecimenData(0.01, 0.0, True, X, X, np.ones(300))
    return chosen(Specimen("specimen:1", base), data, *parts, unknown=unknown)


def test_a_plan_is_not_extended_by_nothing_or_by_what_has_no_name() -> None:
    assert extended(made.plan(), [specimen(SPRING, StepError())]) is None
    assert extended(made.plan(), [specimen(SPRING, StepError(), Backlash(gap=0.002), unknown=True)]) is None


def test_an_effect_and_the_refitted_specimen_become_part_of_their_station() -> None:
    found = extended(made.plan(), [specimen(SPRING, StepError(), Backlash(gap=0.002))])
    assert found is not None
    (station,) = found.stations
    assert station.specimen == SPRING and station.specimen_physics == (Backlash(gap=0.002),)
    assert station.actuator == made.plan().stations[0].actuator and station.sensor_physics == ()
    assert read_plan(found.as_dict()) == found  # it can be run


def test_effects_of_sensors_are_kept_beside_those_that_the_plan_has() -> None:
    offset = ForceOffset(error=100.0)
    plan = made.plan(sensor_physics=[offset.model_dump()])
    found = extended(plan, [specimen(SPRING, StepError(), ForceOffset(error=7.0))])
    assert found is not None and found.stations[0].sensor_physics == (offset, ForceOffset(error=7.0))


def test_an_actuator_keeps_its_specimen() -> None:
    delay = FirstOrderDelay(alpha=4.0)
    data = ActuatorData(0.01, 0.0, True, X, X, None)
    plan = made.plan(actuator=FirstOrderDelay(alpha=3.0).model_dump())
    offset = ForceOffset(error=1.0)
    found = extended(plan, [chosen(Actuator("actuator:1", (FirstOrderDelay(alpha=3.0),)), data, delay, offset)])
    assert found is not None
    assert found.stations[0].actuator == delay and found.stations[0].specimen == made.BASELINE


def structure_plan() -> Plan:
    return read_plan(
        {
            "test": "structure",
            "structure": building([1e4, 1e4], [4e6, 4e6], 0.02),
            "integrator": {"kind": "cr", "dt": 0.01, "substeps": 1},
            "controller_rate": 100.0,
            "duration": 3.0,
            "motion": {"kind": "inline", "dt": 1.0, "acceleration": [0.0] * 4},
        }
    )


def structure(*parts: Part) -> Judged:
    plan = structure_plan()
    data = StructureData(0.01, 0.0, True, X, {}, (("x", 1, X),), None, 1)
    return chosen(Structure("structure", based(plan, False, []), plan), data, *parts)


def test_what_moved_of_a_structure_and_what_was_found_are_kept() -> None:
    base = based(structure_plan(), False, [])
    moved = [StiffnessError(storey=1, share=0.02), StiffnessError(storey=2, share=0.1 * LEAST), DampingError(share=-0.1)]
    friction = CoulombFriction(storey=2, friction=1e3)
    found = extended(structure_plan(), [structure(*moved, *base[3:], friction, GroundScaleError(share=0.05))])
    assert found is not None
    assert found.structure_physics == (friction, moved[0], moved[2])  # a share of a ten-millionth is none
    assert found.motion_physics == (GroundScaleError(share=0.05),)
    assert read_plan(found.as_dict()) == found


@pytest.mark.parametrize("count", [1, 2])
def test_a_station_takes_as_many_effects_as_a_plan_may_hold(count: int) -> None:
    many = [Backlash(gap=0.001 * (place + 1)) for place in range(MOST * count)]
    found = extended(made.plan(), [specimen(SPRING, StepError(), *many)])
    assert found is not None and len(found.stations[0].specimen_physics) == MOST
