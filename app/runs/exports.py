"""What is downloaded of a run: its recording as HDF5 or CSV, and its report."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from app.config import Settings
from app.models import Run
from app.problems import Conflict
from app.runs.schemas import RunDetail
from rths_engine.ground_motions import MotionLibrary
from rths_engine.recording import load

ROWS = 4096


def recording_path(run: Run, settings: Settings) -> Path:
    """The recording's file. Raises Conflict while there is none."""
    path = settings.recordings / f"{run.id}.h5"
    if not run.recording_sha256:
        raise Conflict(f"The test is {run.state} and has no recording.")
    if not path.exists():
        raise Conflict(f"The recording of run {run.id} is missing from the data folder.")
    return path


def csv_lines(path: Path) -> Iterator[bytes]:
    """The recording as CSV: time and all channels in shown units, the units in the header."""
    recording = load(path)
    names = [f"{channel.key} ({channel.shown})" if channel.shown != "1" else channel.key for channel in recording.channels]
    yield (",".join(["t (s)", *names]) + "\r\n").encode()
    factors = np.array([channel.factor for channel in recording.channels])
    for first in range(0, len(recording.signals), ROWS):
        part = slice(first, first + ROWS)
        text = io.BytesIO()
        table = np.column_stack([recording.time[part], recording.signals[part] / factors])
        np.savetxt(text, table, fmt="%.9g", delimiter=",", newline="\r\n")
        yield text.getvalue()


def report(run: Run, settings: Settings) -> str:
    """Self-contained HTML of a run with a recording."""
    from app.reports.service import report_html

    return report_html(
        RunDetail.of(run).model_dump(mode="json"), load(recording_path(run, settings)), MotionLibrary(settings.motions)
    )
