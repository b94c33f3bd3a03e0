"""The engine's own process: ready, stopped, stuck, dead."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.config import Settings
from app.runs.job import RUNS
from app.runs.order import RunOrder
from app.worker import pool as module
from app.worker.child import Done, Failed, Progress
from app.worker.pool import JobProcess, Pool, ProcessDied
from tests.app.conftest import plan

SLOW = {"kind": "real_time", "factor": 1.0}


@pytest.fixture(scope="module")
def engines() -> Iterator[Pool]:
    pool = Pool(RUNS, 1)
    yield pool
    pool.take().stop()


@contextmanager
def taken(engines: Pool) -> Iterator[JobProcess]:
    one = engines.take()
    try:
        yield one
    finally:
        engines.give(one)


@pytest.fixture
def engine(engines: Pool) -> Iterator[JobProcess]:
    with taken(engines) as one:
        yield one


@pytest.fixture
def job(tmp_path: Path) -> RunOrder:
    return RunOrder("run", 1, plan(pace=SLOW, duration=20.0), tmp_path / ".run.1.h5", Settings(data=tmp_path))


def test_an_engine_that_is_taken_is_compiled_and_executes_at_once(engine: JobProcess, job: RunOrder) -> None:
    told: list[Any] = []
    done = engine.execute(replace(job, plan=plan(duration=1.0)), told.append)
    assert isinstance(done, Done) and done.result.recording_size == job.recording.stat().st_size
    assert told[0]["type"] == "schema" and told[-2]["simulated_s"] == pytest.approx(1.0, abs=0.01)  # one step of 0.0098 s
    assert told[-1] == Progress("at 1.0 s of 1.0 s", 1.0)


def test_an_engine_asked_to_stop_saves_what_it_recorded(engine: JobProcess, job: RunOrder) -> None:
    done = engine.execute(job, lambda told: engine.cancel(job))
    assert isinstance(done, Done) and done.result.summary["status"] == "cancelled"
    assert job.recording.exists()


def test_a_late_cancel_does_not_reach_the_next_test_of_the_process(engine: JobProcess, job: RunOrder) -> None:
    """The worker looks at a test that has just ended, while its process already executes another one."""
    earlier = replace(job, job_id="earlier")
    done = engine.execute(replace(job, plan=plan(duration=1.0)), lambda told: engine.cancel(earlier))
    assert isinstance(done, Done) and done.result.summary["status"] == "completed"


def test_an_engine_that_does_not_answer_is_ended(engine: JobProcess, job: RunOrder, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "CANCEL_PATIENCE_S", 0.2)

    def freeze(told: Any) -> None:
        os.kill(engine._process.pid or 0, signal.SIGSTOP)
        engine.cancel(job)

    failed = engine.execute(job, freeze)
    assert isinstance(failed, Failed) and "did not stop within 0.2 s" in failed.reason
    assert not engine.alive and not job.recording.exists()


def test_a_dead_engine_is_replaced(engines: Pool, job: RunOrder) -> None:
    with taken(engines) as engine:
        os.kill(engine._process.pid or 0, signal.SIGKILL)
        engine._process.join()
    with taken(engines) as another:
        assert another is not engine
        assert isinstance(another.execute(replace(job, plan=plan(duration=1.0)), lambda told: None), Done)


def test_an_engine_that_dies_over_a_job_is_told_apart_from_a_failed_test(engine: JobProcess, job: RunOrder) -> None:
    with pytest.raises(ProcessDied, match="exit code -9"):
        engine.execute(job, lambda told: os.kill(engine._process.pid or 0, signal.SIGKILL))
    assert not engine.alive


def test_an_engine_left_in_the_middle_of_a_job_is_given_no_other(engine: JobProcess, job: RunOrder) -> None:
    def break_down(told: Any) -> None:
        raise RuntimeError("the listener broke")

    with pytest.raises(RuntimeError, match="listener"):
        engine.execute(job, break_down)
    assert not engine.alive


def test_an_error_in_a_plan_is_a_failed_run_in_plain_words(engine: JobProcess, job: RunOrder) -> None:
    failed = engine.execute(replace(job, plan={**job.plan, "duration": -1.0}), lambda told: None)
    assert isinstance(failed, Failed) and "duration" in failed.reason and "> 0" in failed.reason


def test_an_engine_ends_with_its_worker(job: RunOrder) -> None:
    engine = JobProcess(RUNS)
    engine.wait_ready()
    engine._pipe.close()  # as the death of the worker's process does
    engine._process.join(20)
    assert engine._process.exitcode == 0
