"""What a worker does with a run when something fails on the way; a scripted engine stands in for the real one."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.cli.main import main
from app.config import Settings
from app.jobs.queue import DurableQueue
from app.jobs.service import MOST_ATTEMPTS, JobService
from app.jobs.states import State
from app.models import Run
from app.runs.job import RUNS, UNSENT
from app.runs.order import Outcome, RunOrder
from app.runs.repository import RunRepository
from app.runs.service import RunService
from app.store.in_folder import FolderStore
from app.worker import executor as module
from app.worker.child import Done, Failed
from app.worker.executor import Executor
from app.worker.main import send_kept
from app.worker.pool import ProcessDied
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.reading import read_model
from rths_engine.recordings.run_file import save
from rths_engine.running import run as engine_run
from tests.app.conftest import plan

SUMMARY: dict[str, Any] = {
    "status": "completed", "trip": None, "elapsed_s": 0.1, "simulated_s": 2.0, "floors_peak_mm": [1.0, 2.0],
    "input_energy_kNm": 3.0, "stations": []
}  # fmt: skip
Script = Callable[[RunOrder], Done | Failed]


class ScriptedEngine:
    """Does with a job what the test says."""

    script: Script

    def execute(self, job: RunOrder, listener: Any) -> Done | Failed:
        return self.script(job)


class OneEngine:
    """A pool of it; `on_take` happens while a run waits for its engine."""

    def __init__(self) -> None:
        self.engine = ScriptedEngine()
        self.on_take: Callable[[], None] = lambda: None

    def take(self) -> ScriptedEngine:
        self.on_take()
        return self.engine

    def give(self, engine: ScriptedEngine) -> None: ...


class Told:
    """The link, as a list of the runs whose end viewers were told of."""

    class Telling:
        ended = False

        def take(self, told: Any) -> None: ...

    def __init__(self) -> None:
        self.tellings: dict[tuple[str, int], Told.Telling] = {}

    def open(self, run_id: str, attempt: int) -> Telling:
        return self.tellings.setdefault((run_id, attempt), Told.Telling())

    @property
    def ended(self) -> list[tuple[str, int]]:
        return [key for key, telling in self.tellings.items() if telling.ended]


class Bench:
    """An executor on an empty database, with one queued run."""

    def __init__(self, settings: Settings, maker: sessionmaker[Session], queue: DurableQueue):
        self.settings, self.maker = settings, maker
        self.told, self.pool = Told(), OneEngine()
        self.executor = Executor(settings, maker, self.told, "here", [RUNS])  # type: ignore[arg-type]
        with db.unit_of_work(maker) as session:
            (run,) = RunService(session, MotionLibrary(None), queue).submit([plan()], "Ana Ruiz")
            self.run_id = run.id

    def execute(self, script: Script) -> Run:
        self.pool.engine.script = script
        self.executor.execute(RUNS, self.run_id)
        return self.run

    @property
    def run(self) -> Run:
        with db.unit_of_work(self.maker) as session:
            found = RunRepository(session).get(self.run_id)
            assert found is not None
            return found

    def started_elsewhere(self, times: int = 1) -> None:
        """As a worker leaves a run that it was killed with."""
        for _ in range(times):
            with db.unit_of_work(self.maker) as session:
                JobService(session, RUNS).start(self.run_id, "elsewhere")

    def cancel(self) -> None:
        with db.unit_of_work(self.maker) as session:
            RunService(session, MotionLibrary(None)).cancel(self.run_id, "Bo")

    @property
    def files(self) -> list[str]:
        return sorted(path.name for path in self.settings.recordings.iterdir())


@pytest.fixture
def bench(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    engine = db.connect(settings.url)
    queue = DurableQueue(engine)
    pool = OneEngine()
    monkeypatch.setattr(module, "Pool", lambda kind, size: pool)
    made = Bench(settings, db.sessions(engine), queue)
    made.pool = pool
    yield made
    queue.close()
    engine.dispose()


def recorded(job: RunOrder) -> Done:
    job.recording.write_bytes(b"recording")
    return Done(Outcome(SUMMARY, "0" * 64, len(b"recording")))


def never(job: RunOrder) -> Done:
    raise AssertionError("this run must not be executed")


def test_a_recording_goes_to_its_place_and_viewers_are_told_of_the_end(bench: Bench) -> None:
    run = bench.execute(recorded)
    assert run.state is State.COMPLETED and run.recording_sha256 == "0" * 64
    assert bench.files == [f"{run.id}.h5"]
    assert bench.told.ended == [(run.id, 1)]


def test_a_commit_that_fails_after_the_recording_is_in_place_is_done_again_alone(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And the test is not repeated: a database that is away for a while costs no test."""
    real, failures = JobService.finish, iter([True, True])

    class Away(Exception): ...

    def finish(self: JobService[Any, Any], job_id: str, attempt: int, result: Any) -> bool:
        stored = real(self, job_id, attempt, result)
        if next(failures, False):
            sa.event.listen(self.session, "before_commit", lambda _: _away(), once=True)
        return stored

    def _away() -> None:
        raise sa.exc.OperationalError("commit", {}, Away("the database is away"))

    monkeypatch.setattr(JobService, "finish", finish)
    run = bench.execute(recorded)
    assert (run.state, run.attempt) == (State.COMPLETED, 1)
    assert bench.files == [f"{run.id}.h5"]


def test_a_recording_that_cannot_be_put_in_its_place_is_a_failed_run_that_says_why(bench: Bench) -> None:
    def unwritable(job: RunOrder) -> Done:
        (bench.settings.recordings / f"{job.job_id}.h5" / "in the way").mkdir(parents=True)
        return recorded(job)

    run = bench.execute(unwritable)
    assert run.state is State.FAILED and run.recording_sha256 is None
    assert run.reason is not None and "was not stored" in run.reason and "directory" in run.reason
    assert bench.told.ended == [(run.id, 1)]


@pytest.fixture
def kept(bench: Bench) -> Path:
    """A recording that the store did not take: it stays in the folder `unsent` of its worker."""

    def unwritable(job: RunOrder) -> Done:
        test = engine_run.Run(read_model(job.plan), MotionLibrary(None))
        test.advance(100_000)
        result = test.result("completed", 0.1)
        saved = save(job.recording, result)
        (bench.settings.recordings / f"{job.job_id}.h5" / "in the way").mkdir(parents=True)
        return Done(Outcome(result.summary(), saved.sha256, saved.size))

    run = bench.execute(unwritable)
    assert run.state is State.FAILED
    shutil.rmtree(bench.settings.recordings / f"{run.id}.h5")
    return bench.settings.data / UNSENT / f"{run.id}.1.h5"


def test_a_recording_that_was_not_sent_is_attached_to_its_run_by_a_command(bench: Bench, kept: Path) -> None:
    recording, finished_at = kept.read_bytes(), bench.run.finished_at
    command = ["send-recordings", "--data", str(bench.settings.data)]
    assert main(command) == 0
    run = bench.run
    assert run.state is State.COMPLETED and "sent it later" in (run.reason or "") and run.finished_at == finished_at
    assert (bench.settings.recordings / f"{run.id}.h5").read_bytes() == recording and not kept.parent.exists()
    assert run.recording_sha256 == hashlib.sha256(recording).hexdigest() and run.stations[0].measure("mte_mm") is not None
    assert main(command) == 0 and bench.run.reason == run.reason  # nothing is left to send
    assert main([*command, str(kept)]) == 2


def test_a_worker_sends_what_was_not_sent_before_its_start(bench: Bench, kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError("the store does not answer")

    with monkeypatch.context() as away:
        away.setattr(FolderStore, "put", full)
        send_kept(bench.settings, bench.maker)
    assert kept.exists() and bench.run.state is State.FAILED
    send_kept(bench.settings, bench.maker)
    assert not kept.exists() and str(bench.run.state) == "completed"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"attempt": 2}, "of attempt 1 of run 1, which ended with attempt 2"),
        ({"digest": "0" * 64}, "its plan is not the plan of run 1"),
        ({"state": State.CANCELLED}, "run 1 is cancelled, not failed"),
        ({"recording_sha256": "0" * 64}, "run 1 has a recording"),
        ({"id": "00000000-0000-0000-0000-000000000000"}, "there is no such run"),
    ],
)
def test_a_recording_that_does_not_belong_to_a_failed_attempt_is_left(
    bench: Bench, kept: Path, change: dict[str, Any], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with db.unit_of_work(bench.maker) as session:
        session.execute(sa.update(Run).values(**change))
    (kept.parent / "notes.h5").write_bytes(b"no recording")
    kept.with_name(kept.name.replace(".1.", ".3.")).write_bytes(b"cut")
    assert main(["send-recordings", str(kept.parent), "--data", str(bench.settings.data)]) == 1
    told = capsys.readouterr()
    assert said in told.err and "its name is not RUN.ATTEMPT.h5" in told.err and "not a complete" in told.err
    assert "0 recordings attached to their runs, 3 left" in told.out and kept.exists()


def test_what_a_killed_worker_left_behind_is_removed_before_the_next_attempt(bench: Bench) -> None:
    bench.started_elsewhere()
    left = [f".{bench.run_id}.1.h5", f"..{bench.run_id}.1.h5.x1y2.tmp", f"{bench.run_id}.h5"]
    for name in left:
        (bench.settings.recordings / name).write_bytes(b"half")
    seen: list[str] = []

    def look(job: RunOrder) -> Failed:
        seen.extend(bench.files)
        return Failed("looked")

    assert bench.execute(look).attempt == 2
    assert seen == [] and bench.files == []


def test_the_recording_of_an_ended_run_is_left_where_it_is(bench: Bench) -> None:
    bench.execute(recorded)
    assert bench.execute(never).state is State.COMPLETED  # delivered once more
    assert bench.files == [f"{bench.run_id}.h5"]


def test_a_run_that_kept_killing_its_worker_is_parked_and_its_viewers_are_told(bench: Bench) -> None:
    bench.started_elsewhere(MOST_ATTEMPTS)
    (bench.settings.recordings / f"{bench.run_id}.h5").write_bytes(b"uncommitted")
    run = bench.execute(never)
    assert run.state is State.FAILED and "3 times" in (run.reason or "")
    assert bench.files == []
    assert bench.told.ended == [(run.id, MOST_ATTEMPTS)]


def test_a_run_that_keeps_killing_its_engine_is_tried_again_and_then_parked(bench: Bench) -> None:
    def dies(job: RunOrder) -> Done:
        job.recording.write_bytes(b"half")
        raise ProcessDied("exit code -11")

    run = bench.execute(dies)
    assert (run.state, run.attempt) == (State.FAILED, MOST_ATTEMPTS)
    assert "died 3 times. There is no further attempt." in (run.reason or "")
    assert bench.files == [] and bench.executor.running == {}


def test_viewers_are_told_of_a_run_cancelled_after_its_worker_died(bench: Bench) -> None:
    bench.started_elsewhere()
    bench.cancel()
    assert bench.execute(never).state is State.CANCELLED
    assert bench.told.ended == [(bench.run_id, 1)]


def test_a_run_waits_queued_for_an_engine_that_is_being_compiled_and_can_be_cancelled_there(bench: Bench) -> None:
    states: list[State] = []

    def meanwhile() -> None:
        states.append(bench.run.state)
        bench.cancel()

    bench.pool.on_take = meanwhile
    run = bench.execute(never)
    assert states == [State.QUEUED]
    assert run.state is State.CANCELLED and run.attempt == 0


def test_a_worker_taken_for_dead_cannot_fail_the_run_that_another_took_up(bench: Bench) -> None:
    def slow(job: RunOrder) -> Failed:
        bench.started_elsewhere()
        return Failed("too late")

    run = bench.execute(slow)
    assert (run.state, run.worker, run.attempt) == (State.RUNNING, "elsewhere", 2)


def test_a_run_whose_worker_stumbled_is_executed_when_it_is_delivered_again(bench: Bench) -> None:
    def broken(job: RunOrder) -> Failed:
        raise RuntimeError("the listener broke")

    with pytest.raises(RuntimeError):
        bench.execute(broken)
    assert bench.executor.running == {}
    assert bench.execute(recorded).attempt == 2


def test_a_start_whose_commit_got_no_answer_is_the_start_and_not_a_death(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """So it costs no attempt, and ends no test that is not repeated."""
    real, failures = JobService.start, iter([True])

    class Away(Exception): ...

    def unanswered(_: Any) -> None:
        raise sa.exc.OperationalError("commit", {}, Away("the connection was cut"))

    def start(self: JobService[Any, Any], *given: Any) -> Any:
        if next(failures, False):
            sa.event.listen(self.session, "after_commit", unanswered, once=True)
        return real(self, *given)

    monkeypatch.setattr(JobService, "start", start)
    run = bench.execute(recorded)
    assert (run.state, run.attempt) == (State.COMPLETED, 1)


def test_a_worker_that_was_cut_off_leaves_a_test_alone_that_another_took_up(bench: Bench) -> None:
    bench.started_elsewhere()
    bench.executor.holds = lambda delivery: False
    run = bench.execute(never)
    assert (run.state, run.worker, run.attempt) == (State.RUNNING, "elsewhere", 1)


def test_a_test_that_cannot_be_started_fails_alone_and_says_why(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(job: Run, settings: Settings) -> RunOrder:
        raise ValueError("its plan is torn")

    with monkeypatch.context() as patch:
        patch.setattr(RUNS, "order", broken)
        run = bench.execute(never)
    assert run.state is State.FAILED
    assert run.reason == "The test could not be started. ValueError: its plan is torn"
    assert bench.told.ended == [(run.id, 1)]
