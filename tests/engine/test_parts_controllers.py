"""Controllers of a current against their laws."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.part import validated
from rths_engine.parts.controllers.clipped_optimal import ClippedOptimal
from rths_engine.parts.controllers.constant_current import ConstantCurrent
from rths_engine.parts.controllers.controller import Commanding
from rths_engine.parts.controllers.no_control import NoControl
from rths_engine.parts.controllers.on_off import OnOff

DT = 1 / 1024


def commanded(controller: Any, d: float, v: float, f: float) -> float:
    current: float = type(controller).step(*controller.build(DT), d, v, f, DT)
    return current


@pytest.mark.parametrize(
    ("controller", "current"), [(ConstantCurrent(current=1.5), 1.5), (NoControl(), 1.0)], ids=["constant", "none"]
)
def test_a_constant_current_depends_on_nothing(controller: Commanding, current: float) -> None:
    assert {commanded(controller, d, v, 1e5) for d in (-0.1, 0.1) for v in (-1.0, 1.0)} == {current}
    assert controller.range == (current, current) and controller.mean == current


def test_on_off_control_is_on_while_the_damper_returns_to_its_centre() -> None:
    controller = OnOff(off_current=0.2, on_current=2.0)
    on = [commanded(controller, d, v, 0.0) for d in (0.01, -0.01) for v in (0.1, -0.1)]
    assert on == [0.2, 2.0, 2.0, 0.2]
    assert commanded(controller, 0.0, 0.1, 0.0) == 0.2 and controller.mean == pytest.approx(1.1)


@pytest.mark.parametrize(
    ("force", "on"),
    [(5e4, True), (1.5e5, False), (-5e4, False), (0.0, False)],
    ids=["too small", "too large", "opposed", "no force"],
)
def test_clipped_optimal_control_is_on_while_the_force_is_smaller_than_the_desired_force(force: float, on: bool) -> None:
    controller = ClippedOptimal(displacement_gain=1e6, velocity_gain=5e5, largest_current=2.5)  # f_d = 10 + 90 kN
    assert commanded(controller, 0.01, 0.18, force) == (2.5 if on else 0.0)
    assert commanded(controller, -0.01, -0.18, -force) == (2.5 if on else 0.0)


def test_a_controller_keeps_its_range() -> None:
    rng = np.random.default_rng(5)
    for controller in (OnOff(), ClippedOptimal(), ConstantCurrent()):
        found = [commanded(controller, *rng.normal(size=3)) for _ in range(100)]
        assert controller.range[0] <= min(found) and max(found) <= controller.range[1]


def test_the_current_when_on_is_not_below_the_current_when_off() -> None:
    with pytest.raises(PlanError, match="on_current"):
        validated(OnOff, {"off_current": 2.0, "on_current": 1.0})
