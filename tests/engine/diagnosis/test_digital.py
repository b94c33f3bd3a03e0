"""Computed parts replay to rounding, and only as the plan has them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.digital import ROUNDING, replayed
from rths_engine.foundation.arrays import Array
from rths_engine.planning.plan import Plan
from rths_engine.recordings import opening, run_file
from rths_engine.recordings.measured import Measured
from rths_engine.running.run import simulate
from tests.engine.plans import LIBRARY, NO_LIMITS, building, make, shaking

STATION = {
    "actuator": {"kind": "first_order_delay", "alpha": 5.0},
    "compensator": {"kind": "inverse", "alpha_es": 4.0},
    "specimen": {"kind": "linear", "stiffness": 1e6, "damping": 2e5},
    "limits": NO_LIMITS,
}


def plan(**station: Any) -> Plan:
    ground = 2 * np.sin(2 * np.pi * 1.3 * 0.02 * np.arange(150))
    tested = {**STATION, **station}
    return make(building([1e4, 8e3], [4e6, 3e6], 0.02), shaking(ground, 0.02), 1 / 256, 4, stations=[tested], duration=3.0)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Measured:
    path: Path = tmp_path_factory.mktemp("runs") / "run.h5"
    run_file.save(path, simulate(plan(), LIBRARY))
    return opening.load(path)


def changed(recording: Measured, role: str, values: Array) -> Measured:
    channels = tuple(replace(one, values=values) if one.role == role else one for one in recording.channels)
    return replace(recording, channels=channels)


def test_structure_and_compensator_of_a_run_replay_to_rounding(recording: Measured) -> None:
    found = replayed(plan(), recording)
    assert [one.component for one in found] == ["compensator:1", "structure"]
    for one in found:
        assert not one.differs and one.error < 1e-9 and one.nrmse < 1e-9  # the same steps, from signals in double precision


def test_another_compensator_than_the_plans_is_told(recording: Measured) -> None:
    found = {one.component: one for one in replayed(plan(compensator={"kind": "inverse", "alpha_es": 4.1}), recording)}
    assert found["compensator:1"].differs and not found["structure"].differs


def test_another_structure_than_the_plans_is_told(recording: Measured) -> None:
    other = plan().model_copy(update={"structure": plan().structure.model_copy(update={"damping_ratio": 0.021})})
    found = {one.component: one for one in replayed(other, recording)}
    assert found["structure"].differs and not found["compensator:1"].differs


def test_the_error_is_of_the_largest_value_and_of_the_spread(recording: Measured) -> None:
    sent = recording.get("x_comp", 1)
    off = np.zeros(len(sent))
    off[100:200] = 0.01 * np.max(np.abs(sent))
    (found, _) = replayed(plan(), changed(recording, "x_comp", sent + off))
    assert found.error == pytest.approx(0.01, rel=0.02)  # the largest itself may stand among those changed
    assert found.nrmse == pytest.approx(np.sqrt(np.mean(off**2)) / np.std(sent + off), rel=1e-6)


def test_what_a_text_file_rounds_is_no_difference(recording: Measured) -> None:
    sent = recording.get("x_comp", 1)
    digits = np.array([float(f"{one:.6g}") for one in sent])
    assert not replayed(plan(), changed(recording, "x_comp", digits))[0].differs
    assert ROUNDING > 5e-6  # half a unit of the fifth digit


def test_only_a_hybrid_test_at_the_controllers_rate_is_replayed(recording: Measured) -> None:
    slower = replace(recording, dt=2 * recording.dt)
    assert replayed(plan(), slower) == []
    few = tuple(one for one in recording.channels if one.role not in ("x_comp", "ag"))
    assert replayed(plan(), replace(recording, channels=few)) == []
