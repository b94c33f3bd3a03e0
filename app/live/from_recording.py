"""The live protocol for a run that has ended, from its recording."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.live.frames import Decimator, FrameStore, bucket_size
from app.live.messages import schema
from rths_engine.recordings.run_file import load


def replay(path: Path, attempt: int) -> tuple[dict[str, Any], FrameStore]:
    """Schema and buckets of a recording. Raises RecordingError."""
    recording = load(path)
    done = len(recording.signals)
    bucket = bucket_size(recording.total)
    decimator = Decimator(recording.channels, bucket, recording.dt)
    store = FrameStore(len(decimator.channels))
    frame = decimator.frame(recording.signals, done, ended=True)
    if frame is not None:
        store.append(frame)
    return schema(attempt, recording.dt, bucket, recording.total, decimator.channels), store
