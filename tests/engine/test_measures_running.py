"""The measures of a test under way come out as those of its whole record."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from rths_engine.planning import templates
from rths_engine.planning.plan import Plan
from rths_engine.results.measure import StationMeasure
from rths_engine.results.measures import of
from rths_engine.results.metrics.frequency import RunningFrequency
from rths_engine.results.running import RunningMeasures
from rths_engine.running.run import Run
from tests.engine.plans import LIBRARY, two_storeys

# |running - whole|: rounding of sums in another order; the index's segments as results.sums promises
ROUNDING, INDEX = 1e-7, {"fei_amplitude": 0.01, "fei_delay_ms": 0.3}

AT_THE_END_ONLY = {one.key for one in of(StationMeasure) if one.so_far is None}


def told(plan: Plan, chunk: int) -> tuple[Run, list[dict[str, Any]]]:
    """The run, and what was told of it after each chunk."""
    run = Run(plan, LIBRARY)
    running = RunningMeasures(plan, run.channels, run.history[0, 0])
    messages = []
    while not run.finished:
        running.take(run.signals[run.advance(chunk)])
        messages.append(running.shown())
    return run, messages


def close(ours: float | None, theirs: float | None, within: float) -> bool:
    return ours is theirs if ours is None or theirs is None else ours == pytest.approx(theirs, rel=ROUNDING, abs=within)


def agree(run: Run, last: dict[str, Any]) -> None:
    whole = run.result("completed", 0.0).summary()
    assert close(last["input_energy_kNm"], whole["input_energy_kNm"], ROUNDING)
    for ours, theirs in zip(last["stations"], whole["stations"], strict=True):
        assert ours.keys() == theirs.keys()
        for name in ours.keys() - {"name"}:
            if name in AT_THE_END_ONLY:
                assert ours[name] is None
                continue
            assert close(ours[name], theirs[name], INDEX.get(name, ROUNDING)), name


@pytest.mark.parametrize(
    ("template", "chunk"),
    [
        ("two-storeys", 97),
        ("table3-01", 5),
        ("linear-damper", 10**6),
        ("specimen-mr-damper", 640),
        ("structure-free-vibration", 64),
    ],
)
def test_running_measures_end_as_those_of_the_whole_record(template: str, chunk: int) -> None:
    run, messages = told(templates.template(template), chunk)
    agree(run, messages[-1])


def test_running_measures_at_any_moment_are_those_of_the_record_until_then() -> None:
    plan = two_storeys((60, 1), 0.4)
    run = Run(plan, LIBRARY)
    running = RunningMeasures(plan, run.channels, run.history[0, 0])
    for _ in range(3):
        running.take(run.signals[run.advance(700)])
        agree(run, running.shown())


def test_what_is_told_before_anything_moved_is_plain_json() -> None:
    plan = templates.template("two-storeys")
    run = Run(plan, LIBRARY)
    running = RunningMeasures(plan, run.channels, run.history[0, 0])
    shown = json.loads(json.dumps(running.shown(), allow_nan=False))
    assert shown["stations"][0]["fei_delay_ms"] is None and shown["stations"][0]["mte_mm"] == 0.0


def test_samples_far_finer_than_the_motion_are_averaged_and_give_the_same_index() -> None:
    dt = 1e-4
    time = np.arange(0, 40, dt)
    x_cmd, x_meas = (np.sin(9.0 * t) * np.exp(-(((t - 17.0) / 7.0) ** 2)) for t in (time, time - 0.02))
    running = RunningFrequency(dt)
    assert running.group == 10
    for part in np.array_split(np.arange(len(time)), 333):
        running.take(x_cmd[part], 0.9 * x_meas[part])
    # the burst's own width, 1 / 7 rad/s about 9 rad/s, takes (0.02 / 7)^2 off; the averages take as much off either signal
    assert running.value() == pytest.approx((0.9, 0.02), rel=1e-4)
