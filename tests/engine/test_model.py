"""A plan is assembled once, whatever is asked of it."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
import pytest

from rths_engine import stability
from rths_engine.foundation.errors import PlanError
from rths_engine.parts.physics.structure.mass_error import MassError
from rths_engine.parts.structures.moment_frame import MomentFrame
from rths_engine.parts.structures.shear_building import ShearBuilding
from rths_engine.planning import templates
from rths_engine.planning.excitation import FloorForce
from rths_engine.planning.model import DEPENDS, Model
from rths_engine.planning.reading import read_model, read_plan
from rths_engine.results.channels import channels
from rths_engine.results.running import RunningMeasures
from rths_engine.running.run import Run, simulate
from tests.engine.plans import LIBRARY
from tests.engine.test_frame import paper_frame

PLAN = templates.template("two-storeys").model_copy(update={"duration": 0.1, "structure_physics": (MassError(share=0.1),)})
FRAME = PLAN.model_copy(update={"structure": MomentFrame.model_validate(paper_frame())})


@pytest.fixture
def assemblies(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The structures assembled, effects' changes of matrices too."""
    found: list[str] = []

    def counted(kind: Any, name: str) -> None:
        real = getattr(kind, name)

        def call(*given: Any) -> Any:
            found.append(kind.__name__)
            return real(*given)

        monkeypatch.setattr(kind, name, call)

    counted(ShearBuilding, "assemble")
    counted(MomentFrame, "assemble")
    counted(MassError, "assembled")
    return found


@pytest.mark.parametrize("plan", [PLAN, FRAME], ids=["building", "frame"])
def test_a_run_assembles_its_structure_once(plan: Any, assemblies: list[str]) -> None:
    simulate(plan).summary()
    assert assemblies == [type(plan.structure).__name__, "MassError"]


def test_reading_a_plan_assembles_its_structure_once(assemblies: list[str]) -> None:
    read_plan(FRAME.as_dict())
    assert assemblies == ["MomentFrame", "MassError"]


def test_what_is_read_is_run_measured_and_judged_without_assembling_it_again(assemblies: list[str]) -> None:
    model = read_model(FRAME.as_dict())
    run = Run(model, LIBRARY)
    RunningMeasures(run.model, channels(run.model), run.history[0, 0])
    run.advance(run.total)
    run.result("completed", 0.0).summary()
    stability.summary(model)
    stability.warning(model.changed(motion=model.plan.motion, name="another name"))
    assert assemblies == ["MomentFrame", "MassError"]


OTHER: dict[str, Any] = {
    "structure": PLAN.structure.model_copy(update={"damping_ratio": 0.05}),
    "structure_physics": (MassError(share=0.2),),
    "stations": tuple(one.model_copy(update={"storey": 1, "equivalent_damping": 1e6}) for one in PLAN.stations),
    "integrator": PLAN.integrator.model_copy(update={"dt": 0.02, "substeps": 5}),
    "forces": (FloorForce(floor=2),),
    "test": "specimen",
    "motion": templates.template("structure-free-vibration").motion,
    "start": templates.template("structure-free-vibration").start,
    "drive": templates.template("actuator-sweep").drive,
    "motion_physics": (),
    "controller_rate": 512.0,
    "seed": 7,
    "duration": 2.0,
    "name": "Other",
}


@pytest.mark.parametrize("field", OTHER)
def test_a_changed_plan_keeps_what_does_not_depend_on_the_field_and_nothing_else(field: str) -> None:
    model = Model(PLAN)
    for name in DEPENDS:
        getattr(model, name)
    changed, fresh = model.changed(**{field: OTHER[field]}), Model(PLAN.model_copy(update={field: OTHER[field]}))
    for name, depends in DEPENDS.items():
        assert (name in vars(changed)) == (field not in depends), name
        np.testing.assert_equal(getattr(changed, name), getattr(fresh, name), name)


def test_every_value_of_a_model_says_what_it_depends_on() -> None:
    values = {name for name, value in vars(Model).items() if isinstance(value, cached_property)}
    assert values == set(DEPENDS)
    assert set().union(*DEPENDS.values()) <= set(type(PLAN).model_fields)


def test_a_model_is_its_own_and_frozen() -> None:
    model = Model(PLAN)
    assert Model.of(model) is model and Model.of(PLAN).plan is PLAN
    with pytest.raises(AttributeError):
        model.plan = PLAN  # type: ignore[misc]


def test_a_scheme_that_is_singular_has_no_factor() -> None:
    soft = PLAN.structure.model_copy(update={"damping_ratio": 0.0})
    broken = Model(PLAN.model_copy(update={"structure": soft}))
    vars(broken)["scheme"] = broken.scheme._replace(effective=0.0 * broken.scheme.effective)
    with pytest.raises(PlanError, match="singular"):
        _ = broken.factor
