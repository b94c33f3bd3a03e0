"""Recordings that a worker kept because the store did not take them, sent to it and attached to their runs."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy.orm import Session, sessionmaker

from app.db import unit_of_work
from app.jobs.service import JobService
from app.jobs.states import State
from app.models import Run
from app.runs.job import RUNS
from app.runs.order import Outcome
from app.store.base import Store
from app.store.filed import RECORDINGS, of_run
from rths_engine.foundation import files
from rths_engine.foundation.errors import RthsError
from rths_engine.recordings import run_file

NAMED = re.compile(r"(?P<run>[0-9a-f-]{36})\.(?P<attempt>[0-9]{1,6})\.h5")  # as RunKind.place names them


@dataclass(frozen=True, slots=True)
class Sent:
    """What became of a recording: attached to its run, or kept in its folder with the reason."""

    path: Path
    attached: bool
    sentence: str


def send(folder: Path, maker: sessionmaker[Session], store: Store) -> Iterator[Sent]:
    """Send the recordings of a folder, one after another. Raises OSError where the store does not take one; it stays there."""
    if not folder.is_dir():
        return
    for path in sorted(folder.glob("*.h5")):
        try:
            yield _sent(path, maker, store)
        except RthsError as error:
            yield Sent(path, False, str(error))
    if not any(folder.iterdir()):
        folder.rmdir()


def _sent(path: Path, maker: sessionmaker[Session], store: Store) -> Sent:
    """Send one recording: row and file together. Raises RecordingError for a damaged file."""
    found = NAMED.fullmatch(path.name)
    if found is None:
        return Sent(path, False, "its name is not RUN.ATTEMPT.h5")
    recording = run_file.load(path)
    outcome = Outcome(recording.summary, files.checksum(path), path.stat().st_size)
    with unit_of_work(maker) as session:
        jobs = JobService(session, RUNS)
        run = jobs.rows.locked(found["run"])
        refusal = _refusal(run, int(found["attempt"]), recording.plan.digest)
        if run is None or refusal:
            return Sent(path, False, refusal)
        jobs.finish_late(run, outcome)
        session.flush()
        copied = store.scratch(RECORDINGS) / f".late-{path.name}"
        try:
            shutil.copyfile(path, copied)
            files.sync(copied)
            store.put(copied, of_run(run.id))
        finally:
            copied.unlink(missing_ok=True)
    path.unlink()
    return Sent(path, True, f"attached to run {run.number}")


def _refusal(run: Run | None, attempt: int, digest: str) -> str:
    """Why a recording is not attached; empty where it is."""
    if run is None:
        return "there is no such run"
    if run.recording_sha256:
        return f"run {run.number} has a recording"
    if run.state is not State.FAILED:
        return f"run {run.number} is {run.state}, not failed"
    if run.attempt != attempt:
        return f"it is of attempt {attempt} of run {run.number}, which ended with attempt {run.attempt}"
    return "" if run.digest == digest else f"its plan is not the plan of run {run.number}"
