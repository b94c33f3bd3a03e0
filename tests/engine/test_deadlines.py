"""Deadlines of tests in real time: what is counted as missed, late and worst, and the loop that is measured."""

from __future__ import annotations

import json
import os
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from rths_engine.foundation.kernel import compiled
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import templates
from rths_engine.planning.plan import Plan, RealTime
from rths_engine.recordings.run_file import load, save
from rths_engine.results import timing_text
from rths_engine.results.running_timing import RunningTiming
from rths_engine.results.timing import Granted, Timing
from rths_engine.running import clock
from rths_engine.running.paced import PacedRun
from rths_engine.running.run import Run, simulate

PERIOD = 1e9 / 1024  # ns


def timing(delays_us: list[float], lengths_us: list[float]) -> Timing:
    """The timing of steps at 1024 Hz, 1 ms of the test each."""
    delays, lengths = (np.array(one, dtype=np.float32) * np.float32(1e3) for one in (delays_us, lengths_us))
    return Timing(1024.0, 1e-3, delays, lengths, Granted())


def plan(**pace: float) -> Plan:
    return templates.template("linear-damper").model_copy(update={"duration": 0.25, "pace": RealTime(**pace)})


def paced(of: Plan) -> Run:
    run = Run(of, MotionLibrary(None))
    running = PacedRun(run, of.pace)  # type: ignore[arg-type]
    running.start()
    while not running.take(0.01):
        pass
    return run


@pytest.fixture(scope="module")
def ran() -> Run:
    return paced(plan(factor=10.0))


def test_a_step_misses_its_deadline_where_its_work_ends_after_the_next_step_is_due() -> None:
    found = timing([0.0, 0.0, 24.0, 976.0], [10.0, 1000.0, 10.0, 1.0]).summary()
    assert (found["steps"], found["missed"]) == (4, 2)
    assert found["worst"] == {
        "step": 2,
        "time_s": 0.002,
        "delay_us": 0.0,
        "length_us": 1000.0,
        "share": pytest.approx(1.024),
    }


def test_a_step_begins_late_after_more_than_a_tenth_of_its_period() -> None:
    assert timing([97.0, 98.0, 500.0], [1.0, 1.0, 1.0]).summary()["late"] == 2


def test_a_verdict_leaves_out_the_delay_that_an_earlier_step_caused() -> None:
    found = timing([0.0, 523.4375, 0.0], [1500.0, 100.0, 100.0]).summary()["verdicts"]
    assert [(one["rate_hz"], one["missed"], one["met"]) for one in found] == [
        (1024.0, 1, False),
        (2048.0, 1, False),
        (4096.0, 1, False),
    ]
    met = timing([3.0, 240.0], [4.0, 10.0]).summary()["verdicts"]
    assert [one["met"] for one in met] == [True, True, False]


def test_every_step_is_in_one_bucket_of_each_histogram() -> None:
    found = timing([0.5, 1.0, 30.0, 9e5], [0.0, 1.5, 2.0, 600.0]).summary()["histogram"]
    assert sum(found["delay"]) == sum(found["length"]) == 4
    assert (found["delay"][0], found["delay"][1], found["delay"][-1]) == (1, 1, 1)
    assert [row for row in timing_text.buckets(timing([30.0], [30.0]).summary())] == [("20 to 50", 1, 1)]


def test_percentiles_are_those_of_all_steps() -> None:
    found = timing(list(range(1001)), [1.0] * 1001).summary()["delay_us"]
    assert found == {key: pytest.approx(value) for key, value in {"p50": 500, "p99": 990, "p999": 999, "max": 1000}.items()}


def test_the_timing_so_far_counts_as_the_timing_at_the_end() -> None:
    delays, lengths = np.random.default_rng(0).exponential(2e5, (2, 300)).astype(np.float32)
    so_far = RunningTiming(1024.0, 1e-3)
    for part in (slice(0, 100), slice(100, 100), slice(100, 300)):
        so_far.take(delays[part], lengths[part])
    found, last = so_far.shown(), Timing(1024.0, 1e-3, delays, lengths, Granted()).summary()
    assert found == {key: last[key] for key in found}


def test_a_test_without_a_step_says_so() -> None:
    found = timing([], []).summary()
    assert found["worst"] is None and not any(one["met"] for one in found["verdicts"])
    assert "No controller step was measured." in list(timing_text.lines(found))


def test_a_paced_run_records_the_same_numbers_as_a_run_as_fast_as_possible(ran: Run) -> None:
    fastest = simulate(ran.plan)
    assert ran.finished and np.array_equal(ran.signals, fastest.signals) and np.array_equal(ran.history, fastest.history)


def test_a_paced_run_measures_every_step_and_keeps_its_pace(ran: Run) -> None:
    assert ran.timing is not None
    found = ran.timing.summary()
    assert (found["steps"], found["rate_hz"]) == (ran.total, 10240.0)
    assert (ran.timing.delays >= 0.0).all() and (ran.timing.lengths > 0.0).all()  # no step begins before its due time


def test_a_recording_stores_the_timing(ran: Run, tmp_path: Path) -> None:
    result = ran.result("completed", 1.0)
    save(tmp_path / "rec.h5", result)
    assert load(tmp_path / "rec.h5").summary["timing"] == json.loads(json.dumps(result.summary()["timing"]))
    with h5py.File(tmp_path / "rec.h5") as file:
        assert file["timing"].shape == (ran.total, 2) and list(file["timing"].attrs["keys"]) == ["delay", "length"]


def test_a_paced_run_stops_when_asked_and_keeps_what_it_recorded() -> None:
    of = plan(factor=0.1)
    run = Run(of, MotionLibrary(None))
    running = PacedRun(run, of.pace)  # type: ignore[arg-type]
    running.start()
    while run.done < 3:
        running.take(0.01)
    running.stop()
    assert running.take() and 3 <= run.done < run.total and not run.finished
    assert np.array_equal(run.signals[: run.done], simulate(of).signals[: run.done])
    assert run.timing is not None and run.timing.summary()["steps"] == run.done


def test_a_paced_run_ends_at_an_exceeded_limit() -> None:
    of = plan(factor=100.0)
    station = of.stations[0].model_copy(update={"limits": of.stations[0].limits.model_copy(update={"force": 20.0})})
    run = paced(of.model_copy(update={"stations": (station,)}))
    assert run.trip is not None and run.trip.limit == "force" and run.finished
    assert run.timing is not None and run.timing.summary()["steps"] == run.done < run.total


def test_a_refused_priority_or_core_is_a_sentence_in_the_result(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(os, "sched_setscheduler", refuse, raising=False)
    run = paced(plan(factor=1000.0, priority=80, core=4095))
    assert run.finished and run.timing is not None
    found = run.timing.summary()["granted"]
    assert (found["priority"], found["core"], found["priority_asked"], found["core_asked"]) == (None, None, 80, 4095)
    core, priority = found["refused"]
    assert "core 4095" in core and "priority 80 was not granted" in priority and "rtprio" in priority


@pytest.mark.filterwarnings("ignore:Code running in object mode")
def test_the_clock_of_the_interpreter_takes_the_place_of_a_missing_one_of_the_system() -> None:
    spec, now, sleep = np.zeros(2, dtype=np.int64), compiled(clock.portable_now), compiled(clock.portable_sleep)
    before = time.monotonic_ns()
    until = now(spec) + 2_000_000
    sleep(until, spec)
    assert before < until <= now(spec) <= time.monotonic_ns()
