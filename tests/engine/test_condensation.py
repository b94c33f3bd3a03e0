"""An elastic frame, condensed, against the same frame with every degree of freedom and a yield moment out of reach."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.part import validated
from rths_engine.parts.structures.condensation import condensed
from rths_engine.parts.structures.moment_frame import MomentFrame
from rths_engine.running.run import Run
from tests.engine.plans import NO_LIMITS, completed, make, shaking
from tests.engine.test_frame import paper_frame

TIME = np.arange(600) * 0.01
SHAKING = shaking(2.0 * np.sin(2 * np.pi * TIME / 1.1) + np.cos(2 * np.pi * TIME / 0.3), 0.01)


def run(stations: bool, **frame: object) -> Run:
    specimen = {"kind": "linear", "stiffness": 2e6, "damping": 5e5}
    # no adaptation, which would amplify rounding
    calm = {"actuator": {"kind": "first_order_delay", "alpha": 2, "velocity_limit": 10.0}, "compensator": {"kind": "none"}}
    equivalents = {"equivalent_stiffness": 2e6, "equivalent_damping": 5e5}
    tested = [
        {"name": f"S{storey}", "storey": storey, "dampers": 2, "specimen": specimen, "limits": NO_LIMITS, **equivalents, **calm}
        for storey in (1, 2)
    ]
    return completed(make(paper_frame(**frame), SHAKING, 10 / 1024, substeps=10, stations=tested if stations else []))


@pytest.mark.parametrize("stations", [False, True])
def test_condensation_leaves_the_history_as_it_is(stations: bool) -> None:
    few, all_of_them = run(stations, inelastic=False), run(stations, yield_stress=1e11)
    assert (len(few.plan.structure.assemble().mass), len(all_of_them.plan.structure.assemble().mass)) == (4, 122)
    scale = np.abs(all_of_them.signals).max(axis=0)
    assert (np.abs(few.signals - all_of_them.signals).max(axis=0) <= 1e-7 * scale).all()  # rounding: K spans seven decades
    assert few.history == pytest.approx(all_of_them.history, rel=0, abs=1e-8 * np.abs(all_of_them.history).max())


def test_condensation_keeps_the_periods() -> None:
    few, all_of_them = (validated(MomentFrame, paper_frame(inelastic=inelastic)).assemble() for inelastic in (False, True))
    flexibility = np.linalg.inv(all_of_them.stiffness)[np.ix_(all_of_them.floors, all_of_them.floors)]
    assert np.linalg.inv(few.stiffness)[np.ix_(few.floors, few.floors)] == pytest.approx(flexibility, rel=1e-9)


def test_a_mechanism_is_not_condensed() -> None:
    with pytest.raises(PlanError, match="mechanism"):
        condensed(np.array([[1.0, -1.0], [-1.0, 1.0]]), np.array([0]))
