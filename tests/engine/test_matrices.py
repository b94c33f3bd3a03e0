"""A structure given by its matrices: the same as the building they came from; what is wrong with them is named."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.planning.model import Model
from rths_engine.planning.reading import plan_from_yaml, plan_to_yaml
from tests.engine.plans import building, completed, make, shaking

MASS = [[2.0e5, 0.0], [0.0, 1.5e5]]
STIFFNESS = [[5.0e7, -2.0e7], [-2.0e7, 2.0e7]]
GROUND = shaking(np.sin(np.arange(300) * 0.07) ** 3, 0.02)


def given(**more: Any) -> dict[str, Any]:
    return {"kind": "matrices", "mass": MASS, "stiffness": STIFFNESS, **more}


def test_the_matrices_of_a_shear_building_move_as_the_building() -> None:
    runs = [completed(make(one, GROUND, 0.01)) for one in (building([2.0e5, 1.5e5], [3.0e7, 2.0e7], 0.02), given())]
    assert np.array_equal(runs[0].history, runs[1].history)


def test_given_damping_replaces_the_ratio() -> None:
    built = make(building([2.0e5, 1.5e5], [3.0e7, 2.0e7], 0.05), GROUND, 0.01).structure.assemble()
    plan = make(given(damping=built.damping.tolist()), GROUND, 0.01)
    assert plan.structure.assemble().damping == pytest.approx(built.damping, rel=1e-15)


def test_floors_influence_and_strokes_can_be_given() -> None:
    """A beam with a rotation without mass: one floor, which the ground moves."""
    stiffness = [[4.0e7, 1.0e7], [1.0e7, 3.0e7]]
    plan = make(given(mass=[[1e5, 0.0], [0.0, 0.0]], stiffness=stiffness, floors=[1], drifts=[[1.0, -0.5]]), GROUND, 0.01)
    built = plan.structure.assemble()
    assert built.floors == (0,)
    assert built.influence.tolist() == [1.0, 0.0]
    assert built.drifts.tolist() == [[1.0, -0.5]]
    condensed = 4.0e7 - 1.0e7**2 / 3.0e7
    assert Model(plan).periods == pytest.approx([2 * np.pi / np.sqrt(condensed / 1e5)], rel=1e-12)
    completed(plan)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"stiffness": [[5.0e7, -2.0e7], [-1.0e7, 2.0e7]]}, r"K is not symmetric: K\[1, 2\] = -2e\+07, K\[2, 1\] = -1e\+07"),
        ({"mass": [[2e5, 1e3], [0.0, 1e5]]}, r"M is not symmetric"),
        ({"stiffness": [[2e7]]}, r"structure\.stiffness: matrix K needs 2 rows of 2 numbers"),
        ({"mass": [[0.0, 0.0], [0.0, 0.0]]}, "all zero.*give at least one degree of freedom mass"),
        ({"mass": [[2e5, 0.0], [0.0, -1e5]]}, r"negative eigenvalue -1e\+05 kg"),
        ({"stiffness": [[2.0e7, -2.0e7], [-2.0e7, 2.0e7]]}, "mechanism"),
        ({"mass": [[1e5, 1e5], [1e5, 1e5]]}, r"structure\.mass: the mass matrix is singular"),
        ({"floors": [1, 3]}, r"structure\.floors: give different degrees of freedom from 1 to 2"),
        ({"influence": [1.0]}, "influence of the ground needs 2 numbers and has 1"),
        ({"drifts": [[1.0]]}, "each row of L needs 2 numbers"),
        ({"damping": [[1.0, 2.0], [3.0, 4.0]]}, "C is not symmetric"),
    ],
)
def test_what_is_wrong_with_matrices_is_named(wrong: dict[str, Any], told: str) -> None:
    with pytest.raises(PlanError, match=told):
        make(given(**wrong), GROUND, 0.01)


def test_matrices_survive_yaml() -> None:
    plan = make(given(damping=[[1e4, 0.0], [0.0, 1e4]]), GROUND, 0.01)
    assert plan_from_yaml(plan_to_yaml(plan)).digest == plan.digest
