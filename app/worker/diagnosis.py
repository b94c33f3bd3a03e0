"""The process of one diagnosis: reads, diagnoses, tells through a pipe, and ends with its worker."""

from __future__ import annotations

import json
import os
import threading
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

NICER = 10  # tests go first


@dataclass(frozen=True, slots=True)
class DiagnosisJob:
    """One attempt at a diagnosis: the plan, the file of the recording and of those held out, the rate of false alarms."""

    diagnosis_id: str
    attempt: int
    plan: dict[str, Any]
    recording: Path
    heldout: tuple[Path, ...]
    level: float


@dataclass(frozen=True, slots=True)
class Progress:
    """What is being done, and the share of the whole that is."""

    doing: str
    share: float


@dataclass(frozen=True, slots=True)
class Found:
    verdict: dict[str, Any]
    pictures: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Undone:
    """Why the recording can't be diagnosed."""

    reason: str


def serve(pipe: Connection, job: DiagnosisJob) -> None:
    threading.Thread(target=_end_with_worker, args=(pipe,), daemon=True).start()
    os.nice(NICER)
    try:
        told: Found | Undone = _diagnosed(job, pipe)
    except (BrokenPipeError, ConnectionError):
        return
    except Exception as error:
        told = Undone(f"{type(error).__name__}: {error}")
    pipe.send(told)


def _diagnosed(job: DiagnosisJob, pipe: Connection) -> Found | Undone:
    from rths_engine.diagnosis import diagnose
    from rths_engine.diagnosis.pictures import pictures
    from rths_engine.foundation.errors import RthsError
    from rths_engine.planning.reading import read_plan
    from rths_engine.recordings import opening

    def tell(doing: str, share: float) -> None:
        pipe.send(Progress(doing, min(1.0, max(0.0, float(share)))))

    try:
        plan, recording = read_plan(job.plan), opening.load(job.recording)
        found = diagnose(plan, recording, [opening.load(path) for path in job.heldout], job.level, told=tell)
    except RthsError as error:
        return Undone("; ".join(_named(str(issue)) for issue in error.issues))
    return Found(_finite(found.verdict), _finite(pictures(found)))


def _named(issue: str) -> str:
    """The command line's words for its arguments as the service's."""
    return issue.replace("REC.h5", "The recording").replace("--holdout", "A recording held out")


def _finite(result: dict[str, Any]) -> dict[str, Any]:
    """With null for what came out as no finite number, which JSON can't hold."""
    found: dict[str, Any] = json.loads(json.dumps(result), parse_constant=lambda _: None)
    return found


def _end_with_worker(pipe: Connection) -> None:
    try:
        pipe.recv()
    except (EOFError, OSError):
        os._exit(1)
