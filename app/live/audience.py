"""What all viewers of a run share: its row, read once for all of them, and its replay from the recording.

Rows and recordings are read in threads of their own, so that viewers take none of those that answer requests.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from sqlalchemy.orm import Session, sessionmaker

from app.config import Settings
from app.db import unit_of_work
from app.live import from_recording
from app.live.frames import FrameStore
from app.runs.exports import recording_path
from app.runs.repository import RunRepository
from app.runs.schemas import RunOut
from rths_engine.foundation.errors import RecordingError

POLL_S = 0.25
THREADS = 2
Replay = tuple[dict[str, Any], FrameStore]


class Row:
    """A run as it stands in the database, with the text that viewers get."""

    def __init__(self, run: RunOut):
        self.run = run
        self.text = run.model_dump_json()

    def within(self, message: dict[str, Any]) -> str:
        """A message with the run in it, as text."""
        return f'{json.dumps(message, separators=(",", ":"))[:-1]},"run":{self.text}}}'


class Watched:
    """One run that viewers watch. Viewers that ask at the same time share one answer; an answer is used for POLL_S."""

    def __init__(
        self, run_id: str, read: Callable[[str], Row | None], replay: Callable[[str], Replay], threads: ThreadPoolExecutor
    ):
        self.run_id, self.viewers = run_id, 0
        self._read, self._read_replay, self._threads = read, replay, threads
        self._row: asyncio.Future[Row | None] | None = None
        self._asked = 0.0
        self._replay: asyncio.Future[Replay] | None = None

    async def row(self, fresh_since: float = 0.0) -> Row | None:
        """The run, or None where there is none; read no earlier than `fresh_since` (monotonic time, s)."""
        begun = time.monotonic()
        if self._row is None or self._asked < max(fresh_since, begun - POLL_S):
            self._asked = begun
            self._row = asyncio.get_running_loop().run_in_executor(self._threads, self._read, self.run_id)
        return await asyncio.shield(self._row)

    async def replay(self) -> Replay:
        """Schema and buckets of the recording. Raises OSError and RecordingError."""
        if self._replay is None:
            self._replay = asyncio.get_running_loop().run_in_executor(self._threads, self._read_replay, self.run_id)
        return await asyncio.shield(self._replay)


class Audience:
    """The runs that are watched, by id. Used on the event loop only."""

    def __init__(self, sessions: Callable[[], sessionmaker[Session]], settings: Settings):
        self._sessions, self._settings = sessions, settings
        self._threads = ThreadPoolExecutor(THREADS, "rths-viewers")
        self.watched: dict[str, Watched] = {}

    def enter(self, run_id: str) -> Watched:
        """What the viewers of a run share, until as many have left as came."""
        watched = self.watched.setdefault(run_id, Watched(run_id, self._row, self._replay, self._threads))
        watched.viewers += 1
        return watched

    def leave(self, watched: Watched) -> None:
        watched.viewers -= 1
        if not watched.viewers:
            self.watched.pop(watched.run_id, None)

    def close(self) -> None:
        self._threads.shutdown(wait=False, cancel_futures=True)

    def _row(self, run_id: str) -> Row | None:
        with unit_of_work(self._sessions()) as session:
            found = RunRepository(session).get(run_id)
            return Row(RunOut.of(found)) if found else None

    def _replay(self, run_id: str) -> Replay:
        with unit_of_work(self._sessions()) as session:
            run = RunRepository(session).get(run_id)
            if run is None:
                raise RecordingError("the run was removed")
            path, attempt = recording_path(run, self._settings), run.attempt
        return from_recording.replay(path, attempt)
