"""The next test of an unknown: the motion that adds most information to its surface."""

from __future__ import annotations

import numpy as np

from rths_engine.diagnosis.exploring import exploring
from rths_engine.diagnosis.surface import surfaces
from tests.engine.diagnosis.made import Gain, linear, noisy, recordings
from tests.engine.diagnosis.test_surface import SPRING, TOP_V, TOP_X, V, used


def test_the_next_test_fills_cells_that_the_recording_does_not_reach_within_the_rig() -> None:
    """Free to move, the test exceeds the recording. A rig with little speed gets a test within it."""
    recorded = used(3e3 * np.sign(V))
    found = surfaces(recorded, [SPRING])
    free = exploring(recorded, found, stroke=1.0, speed=10.0)
    slow = exploring(recorded, found, stroke=TOP_X, speed=0.5 * TOP_V)
    assert free is not None and slow is not None and free.motion is not None and slow.motion is not None
    assert free.motion.amplitude > TOP_X and free.cells[0] > 0 and free.information > slow.information > 0
    assert slow.reach[0] <= TOP_X * (1 + 1e-9) and slow.reach[1] <= 0.51 * TOP_V
    assert f"{free.cells[0]} cells" in free.tells and "mm/s" in free.tells
    assert exploring(recorded, found, stroke=1.0, speed=1e-9) is None


def test_a_component_without_a_drive_gets_no_test() -> None:
    plain = recordings(linear(), noisy([Gain()], 1))
    assert exploring(plain, surfaces(plain, [Gain()]), 1.0, 1.0) is None
