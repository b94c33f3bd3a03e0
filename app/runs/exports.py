"""What is downloaded of a run: its recording as HDF5 or CSV, and its report."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from app.config import Settings
from app.models import Run
from app.problems import Conflict
from app.runs.schemas import RunDetail
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.recordings.run_file import load

ROWS = 4096


def recording_path(run: Run, settings: Settings) -> Path:
    """The recording's file. Raises Conflict while there is none."""
    path = settings.recordings / f"{run.id}.h5"
    if not run.recording_sha256:
        raise Conflict(f"The test is {run.state} and has no recording.")
    if not path.exists():
        raise Conflict(f"The recording of run {run.id} is missing from the data folder.")
    return path


def csv_parts(path: Path) -> Iterator[bytes]:
    """The recording as CSV, read part by part: time and all channels in shown units, the units in the header.

    Raises Conflict for a damaged file, before the first part.
    """
    try:
        file = h5py.File(path, "r")
        channels = json.loads(file.attrs["channels"])
        dt, signals = float(file.attrs["dt"]), file["signals"]
    except (OSError, KeyError, ValueError) as error:
        raise Conflict(f"The recording {path.name} is damaged: {error}") from None
    return _parts(file, channels, dt, signals)


def _parts(file: h5py.File, channels: list[dict[str, Any]], dt: float, signals: Any) -> Iterator[bytes]:
    with file:
        yield (",".join(["t (s)", *(_heading(channel) for channel in channels)]) + "\r\n").encode()
        factors = np.array([channel["factor"] for channel in channels])
        for first in range(0, len(signals), ROWS):
            values = signals[first : first + ROWS] / factors
            time = np.arange(first + 1, first + 1 + len(values)) * dt
            text = io.BytesIO()
            np.savetxt(text, np.column_stack([time, values]), fmt="%.9g", delimiter=",", newline="\r\n")
            yield text.getvalue()


def _heading(channel: dict[str, Any]) -> str:
    return channel["key"] if channel["shown"] == "1" else f"{channel['key']} ({channel['shown']})"


def report(run: Run, settings: Settings) -> str:
    """Self-contained HTML of a run with a recording."""
    from app.reports.service import report_html

    return report_html(
        RunDetail.of(run).model_dump(mode="json"), load(recording_path(run, settings)), MotionLibrary(settings.motions)
    )
