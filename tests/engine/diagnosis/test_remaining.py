"""What remains of a component: of which model, its size, and its share on held-out data."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.detect import Detection
from rths_engine.diagnosis.fitting import fit
from rths_engine.diagnosis.judge import Judged, fitted_blocks
from rths_engine.diagnosis.remaining import remaining
from tests.engine import recorded_specimens as made
from tests.engine.diagnosis.made import as_judged, selected
from tests.engine.diagnosis.test_surface import COUNT, DT, SPRING, TOP_X, V, X, used

PLAN = made.plan()
NOISE = Detection(np.zeros(0), 0.0, 1.0, 1.0, 1.0, 0.0, 0.0)


def judged(verdict: str, unknown: bool) -> Judged:
    """A spring with an unknown force: the damping beyond it grows with the square of the displacement."""
    recordings = replace(used(6e3 * (X / TOP_X) ** 2 * V / np.max(np.abs(V))), masks=(fitted_blocks(COUNT, DT),))
    planned = fit(recordings, [SPRING])
    return as_judged(selected(recordings, planned, planned, detections=(NOISE,)), verdict, unknown)


def test_what_remains_has_its_size_its_formula_and_its_share_on_held_out_data() -> None:
    found = remaining(PLAN, judged("mismatch", True), 0.01)
    assert found is not None and (found.unit, found.at) == ("N", "")
    real = 6e3 * (X / TOP_X) ** 2 * V / np.max(np.abs(V))
    assert found.size == pytest.approx(float(np.std(real)), rel=0.2)
    assert found.law is not None and [term.formula for term in found.law.terms] == ["x^2 v"]
    assert found.law.terms[0].coefficient == pytest.approx(6e3, rel=0.1) and found.law.held_out_share > 0.9
    assert found.state_share is not None and 0.3 < found.state_share <= 1.0
    assert found.test is not None and found.test.motion is not None


@pytest.mark.parametrize(("verdict", "unknown"), [("consistent", False), ("recalibrate", False), ("mismatch", False)])
def test_nothing_remains_where_the_verdict_leaves_nothing_unexplained(verdict: str, unknown: bool) -> None:
    assert remaining(PLAN, judged(verdict, unknown), 0.01) is None
