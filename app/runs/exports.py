"""Downloads of a run: recording as HDF5 or CSV, and measures as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from app.config import Settings
from app.measures import rows as measured
from app.models import Run
from app.problems import Conflict
from app.runs.schemas import RunOut
from app.store.filed import Filed, of_run
from app.store.opening import store_of
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.run_file import rows
from rths_engine.results.channels import Channel

ROWS = 4096


def recording_path(run: Run, settings: Settings) -> Path:
    """The path of the verified recording. Raises Conflict while there is no recording, Damaged where its file is not intact."""
    return store_of(settings).verified(filed(run))


def filed(run: Run) -> Filed:
    """The file of a recording as the row of its run describes it. Raises Conflict while there is no recording."""
    if not run.recording_sha256:
        raise Conflict(removed(run) or f"The test has no recording: it is {run.state}.")
    what = f"The recording of run {run.number} ({run.name})"
    return Filed(of_run(run.id), what, run.recording_sha256, run.recording_size)


def removed(run: Run) -> str:
    """The sentence for a recording that retention removed; empty where it did not."""
    if run.recording_removed_at is None:
        return ""
    what = f"The recording of run {run.number} ({run.name}) was removed by retention"
    return f"{what} on {run.recording_removed_at:%Y-%m-%d}. Its plan and its measures are kept."


def csv_parts(path: Path) -> Iterator[bytes]:
    """The recording as CSV in parts: time and all channels in the units shown; the header has the units.

    Raises RecordingError for a damaged file, before the first part.
    """
    return _parts(*rows(path, ROWS))


def _parts(channels: tuple[Channel, ...], dt: float, signals: Iterator[Array]) -> Iterator[bytes]:
    yield (",".join(["t (s)", *(channel.heading for channel in channels)]) + "\r\n").encode()
    factors, first = np.array([channel.factor for channel in channels]), 0
    for part in signals:
        time = np.arange(first + 1, first + 1 + len(part)) * dt
        first += len(part)
        text = io.BytesIO()
        np.savetxt(text, np.column_stack([time, part / factors]), fmt="%.9g", delimiter=",", newline="\r\n")
        yield text.getvalue()


def measures_text(run: Run) -> str:
    """The measures of a run as CSV. Raises Conflict while there are no measures."""
    if not run.recording_sha256 and run.recording_removed_at is None:
        raise Conflict(f"The test has no measures: it is {run.state}.")
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(["station or floor", "key", "measure", "value", "unit"])
    for what, one, value in measured(RunOut.of(run).model_dump(), run.test):
        writer.writerow([what, one.key, one.label, "" if value is None else f"{value:.9g}", one.shown])
    return text.getvalue()
