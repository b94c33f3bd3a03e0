"""What a plan states about how well its numbers are known, and the tolerances that a diagnosis takes from it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, get_args

import numpy as np
import pytest

from rths_engine.diagnosis.components import Actuator, Chain, ClockSkew, Specimen, StepError, Structure, StructureData, based
from rths_engine.diagnosis.components.component import Component
from rths_engine.diagnosis.components.structure import ModeDamping
from rths_engine.diagnosis.detect import p_planned
from rths_engine.diagnosis.fitting import Recordings, fit
from rths_engine.diagnosis.free import numbers
from rths_engine.diagnosis.noise import Noise
from rths_engine.foundation.errors import PlanError
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.physics.actuator.gain_error import GainError
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.physics.structure.damping_error import DampingError
from rths_engine.parts.physics.structure.mass_error import MassError
from rths_engine.parts.physics.structure.stiffness_error import StiffnessError
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.planning.known import TOLERANCES, How
from rths_engine.planning.reading import plan_from_yaml, plan_to_yaml, read_plan
from tests.engine.plans import building

SPRING, DELAY = LinearSpecimen(stiffness=2e6, damping=3e5), FirstOrderDelay()
SINE = {"amplitude": 0.01, "shape": {"kind": "sine"}}
TESTED: dict[str, Any] = {"test": "specimen", "drive": SINE, "stations": [{"specimen": SPRING.model_dump()}]}
HYBRID: dict[str, Any] = {"structure": building([1e5], [1e7]), "stations": [{}], "duration": 1.0}
FRAME: dict[str, Any] = {"test": "structure", "structure": building([1e4, 8e3], [4e6, 3e6], 0.02), "duration": 1.0}


def spreads(component: Component) -> dict[str, float]:
    """The tolerance of each free parameter of a component's base, by the part and the field."""
    free = numbers(component, component.base)
    return {f"{type(component.base[one.owner]).__name__}.{one.field}": one.spread for one in free}


def test_a_plan_without_statements_keeps_the_default_tolerances() -> None:
    plan = read_plan(FRAME)
    kinds = [type(part) for part in based(plan, False, ())]
    assert MassError not in kinds
    found = spreads(Structure("structure", based(plan, False, ()), plan))
    assert found == {"StiffnessError.share": 0.03, "DampingError.share": 0.2, "ModeDamping.share": 0.03}
    assert set(spreads(Specimen("specimen:1", (SPRING,))).values()) == {float("inf")}


@pytest.mark.parametrize("how", get_args(How))
def test_statements_about_a_structure_set_the_tolerances_of_its_corrections(how: How) -> None:
    plan = read_plan({**FRAME, "known": {"structure.mass": how, "structure.stiffness": how, "structure.damping": how}})
    base = based(plan, False, ())
    assert [type(part) for part in base][-2:] == [MassError, MassError]
    one = Structure("structure", base, plan)
    parts = {"mass": MassError(), "stiffness": StiffnessError(), "damping": DampingError(), "mode": ModeDamping()}
    assert {name: one.spread(part) for name, part in parts.items()} == {name: TOLERANCES[name][how] for name in parts}


def test_a_statement_about_a_number_comes_before_the_statement_about_its_section() -> None:
    known = {"stations.0.specimen": "guess", "stations.0.specimen.stiffness": "measured", "stations.0.clock": "nominal"}
    found = spreads(Specimen("specimen:1", (SPRING, Backlash(), ClockSkew(), StepError()), known=read_known(known)))
    assert found["LinearSpecimen.stiffness"] == 0.05 and found["LinearSpecimen.damping"] == 0.7
    assert found["Backlash.gap"] == 0.7  # an effect of the plan is a part of its section
    assert found["ClockSkew.delay"] == 1.0 and found["StepError.share"] == 0.25


def test_actuator_and_specimen_of_a_chain_have_statements_of_their_own() -> None:
    known = read_known({"stations.0.specimen": "nominal", "stations.0.actuator": "nominal"})
    base = (DELAY, SPRING, GainError(), Backlash())
    assert set(spreads(Chain("specimen:1", base, known=known)).values()) == {0.15}
    assert spreads(Chain("specimen:1", base))["GainError.share"] == float("inf")
    assert set(spreads(Actuator("actuator:1", (DELAY,), known=known)).values()) == {0.15}
    assert set(spreads(Actuator("actuator:2", (DELAY,), known=known)).values()) == {0.05}  # nothing is stated about station 2


@pytest.mark.parametrize(("known", "surprising"), [({}, True), ({"structure.damping": "nominal"}, False)])
def test_a_change_within_what_was_known_is_no_mismatch(known: dict[str, str], surprising: bool) -> None:
    """A decay with 70 % more damping than its plan: 3.5 tolerances of 20 %, but 1.4 of 50 %."""
    plan = read_plan({**FRAME, "structure": building([1e4], [4e6], 0.02), "known": known})
    one = Structure("structure", based(plan, False, ()), plan)
    still = np.zeros(600)
    data = StructureData(0.01, 0.0, False, still, {}, (("x", 1, still),), ((0.02,), (0.0,)), 1)
    measured = one.predicted((DampingError(share=0.7),), data)[0]
    data = replace(data, floors=(("x", 1, measured + np.random.default_rng(1).normal(0.0, 1e-4, 600)),))
    weights = (np.ones((1, 600)),)
    recordings = Recordings(one, (data,), (np.ones(600, bool),), (Noise.white(1e-4),), weights, weights)
    assert (p_planned(fit(recordings, one.base)) < 0.01) == surprising


def test_statements_come_back_from_yaml_and_leave_the_digest() -> None:
    plan = read_plan({**TESTED, "known": {"stations.0.specimen.stiffness": "measured"}})
    assert plan_from_yaml(plan_to_yaml(plan)) == plan
    assert "known:\n  stations.0.specimen.stiffness: measured" in plan_to_yaml(plan)
    assert plan.digest == read_plan(TESTED).digest


@pytest.mark.parametrize(
    ("plan", "path"),
    [
        (TESTED, "structure.mass"),
        (TESTED, "stations.1.specimen"),
        (FRAME, "stations.0.clock"),
        (FRAME, "mass"),
        (HYBRID, "structure.mass"),
    ],
)
def test_a_statement_about_a_number_that_no_diagnosis_refits_is_refused(plan: dict[str, Any], path: str) -> None:
    with pytest.raises(PlanError) as refused:
        read_plan({**plan, "known": {path: "measured"}})
    assert (refused.value.issues[0].where, refused.value.issues[0].value) == ("known", path)


def test_only_the_three_words_are_statements() -> None:
    with pytest.raises(PlanError, match="measured"):
        read_plan({**FRAME, "known": {"structure.mass": "exact"}})


def read_known(known: dict[str, str]) -> Any:
    return read_plan({**TESTED, "known": known}).known
