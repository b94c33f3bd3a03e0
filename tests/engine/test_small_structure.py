"""The motion of a small structure by dense matrices against the loop's own steps."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import PlanError
from rths_engine.parts import physics
from rths_engine.parts.integrators.cr import CrIntegrator
from rths_engine.parts.integrators.kr_alpha import KrAlphaIntegrator
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.structure.storey import OfStorey
from rths_engine.parts.structures.shear_building import ShearBuilding
from rths_engine.planning import templates
from rths_engine.planning.excitation import Start
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.running import replay, small_structure

RANDOM = np.random.default_rng(3)
STEPS = 400
INPUTS = RANDOM.standard_normal((STEPS + 1, 1))
SEEN = Seen(0.01, 0.1, 2e5, 4.0, 2e3, 0.01, storey=2)


def plan(*physics_of: OfStorey, **changed: object) -> Plan:
    storeys = tuple({"mass": 3e4, "stiffness": stiffness} for stiffness in (2e7, 1.6e7, 1.2e7))
    first = templates.template("linear-damper")
    update = {"structure": ShearBuilding(storeys=storeys), "structure_physics": physics_of, "integrator": CrIntegrator(dt=0.01)}
    return first.model_copy(update={**update, **changed})


def by_the_loop(monkeypatch: pytest.MonkeyPatch, planned: Plan, reactions: Array) -> Array:
    with monkeypatch.context() as patched:
        patched.setattr(small_structure, "fits", lambda model: False)
        return replay.structure(planned, INPUTS, reactions).floors


def pushed(planned: Plan) -> Array:
    found: Array = 1e3 * RANDOM.standard_normal((STEPS + 1, len(planned.stations)))
    return found


@pytest.mark.parametrize("kind", physics.STRUCTURE, ids=lambda kind: kind.__name__)
def test_every_effect_of_a_structure_moves_it_as_in_the_loop(kind: type[OfStorey], monkeypatch: pytest.MonkeyPatch) -> None:
    """Within rounding: the loop solves with a factor, here the inverse is multiplied."""
    for effect in physics.SEARCHES[kind].guesses(SEEN):
        planned = plan(effect)
        reactions = pushed(planned)
        expected = by_the_loop(monkeypatch, planned, reactions)
        assert small_structure.fits(Model(planned))
        found = replay.structure(planned, INPUTS, reactions).floors
        assert found == pytest.approx(expected, abs=1e-9 * float(np.max(np.abs(expected))))


def test_a_released_structure_moves_as_in_the_loop(monkeypatch: pytest.MonkeyPatch) -> None:
    planned = plan(start=Start(displacement=(0.01, 0.02, 0.02), velocity=(0.0, 0.1, 0.0)))
    reactions = pushed(planned)
    expected = by_the_loop(monkeypatch, planned, reactions)
    found = replay.structure(planned, INPUTS, reactions).floors
    assert found == pytest.approx(expected, abs=1e-9 * float(np.max(np.abs(expected))))


def test_other_structures_and_schemes_keep_to_the_loop() -> None:
    assert not small_structure.fits(Model(plan(integrator=KrAlphaIntegrator(dt=0.01))))
    many = ShearBuilding(storeys=tuple({"mass": 3e4, "stiffness": 2e7} for _ in range(small_structure.MOST + 1)))
    assert not small_structure.fits(Model(plan(structure=many)))


def test_an_indefinite_structure_is_refused_as_in_the_loop() -> None:
    falling = physics.SEARCHES[next(kind for kind in physics.STRUCTURE if kind.__name__ == "StiffnessError")].effect
    planned = plan(*(falling.model_construct(storey=storey, share=-1e6) for storey in (1, 2, 3)))
    with pytest.raises(PlanError):
        replay.structure(planned, INPUTS, pushed(planned))
