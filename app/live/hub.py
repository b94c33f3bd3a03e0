"""The live runs of the web service: the frames and messages of workers, for viewers."""

from __future__ import annotations

import asyncio
import json
import time
from typing import Any

from app.live.frames import FrameStore

SHORTEST_GAP_S = 1 / 60
COST_S = 0.0004
"""Time between two frames for each viewer: 100 viewers get 25 frames a second, which leave most of a core to requests."""
SILENT_S = 6 * 3600
"""A run of which nothing came for so long has lost its worker; its buckets are dropped when another run begins."""


class LiveRun:
    """One attempt of a run, as sent by its worker. `changed` is set at the next change, and then replaced.

    All viewers of a run hear of its changes at the same moment, at most every `gap` seconds, so that they are at the same
    bucket and get the same bytes.
    """

    def __init__(self, attempt: int, schema: dict[str, Any]):
        self.attempt, self.schema = attempt, schema
        self.store = FrameStore(len(schema["channels"]))
        self.progress: dict[str, Any] | None = None
        self.progress_text = ""
        self.ended = False
        self.changed = asyncio.Event()
        self.viewers = 0
        self.heard = time.monotonic()
        self._told = 0.0
        self._due: asyncio.TimerHandle | None = None
        self._frames: tuple[int, dict[int, bytes | None]] = (0, {})

    def since(self, first: int) -> bytes | None:
        """The next frame from bucket `first` on; viewers at the same bucket share its bytes."""
        count, frames = self._frames
        if count != self.store.count:
            self._frames = (self.store.count, frames := {})
        if first not in frames:
            frames[first] = self.store.since(first)
        return frames[first]

    def take(self, progress: dict[str, Any]) -> None:
        """Take the progress, as text for all viewers too."""
        self.progress, self.progress_text = progress, json.dumps(progress, separators=(",", ":"))

    def notify(self, gap: float = 0.0) -> None:
        """Tell viewers of a change: now, or `gap` (s) after they were last told."""
        self.heard = time.monotonic()
        wait = self._told + gap - self.heard
        if not self.viewers or wait <= 0:
            self._tell()
        elif self._due is None:
            self._due = asyncio.get_running_loop().call_later(wait, self._tell)

    def _tell(self) -> None:
        if self._due is not None:
            self._due.cancel()
            self._due = None
        self._told = time.monotonic()
        self.changed.set()
        self.changed = asyncio.Event()


class Hub:
    """Live runs by id. Used on the event loop only."""

    def __init__(self) -> None:
        self.runs: dict[str, LiveRun] = {}

    def take(self, run_id: str, attempt: int, message: dict[str, Any]) -> None:
        """Take a JSON message of a worker: schema, progress or end. Messages of earlier attempts are ignored."""
        live = self.runs.get(run_id)
        if message["type"] == "schema":
            if live is None or live.attempt < attempt:
                self._forget_silent()
                self.runs[run_id] = LiveRun(attempt, message)
                if live is not None:
                    live.notify()
        elif live is not None and live.attempt <= attempt:
            if message["type"] == "progress":
                live.take(message)
                live.notify(self.gap)
            else:
                self.end(run_id, live)

    def frame(self, run_id: str, attempt: int, frame: bytes) -> None:
        live = self.runs.get(run_id)
        if live is not None and live.attempt == attempt and live.store.append(frame):
            live.notify(self.gap)

    def end(self, run_id: str, live: LiveRun) -> None:
        """The run has ended: its viewers go on with the recording, and its buckets are freed."""
        live.ended = True
        if self.runs.get(run_id) is live:
            del self.runs[run_id]
        live.notify()

    @property
    def gap(self) -> float:
        """Time (s) between two frames for a viewer: longer with more viewers, so that other requests are answered."""
        return max(SHORTEST_GAP_S, COST_S * sum(live.viewers for live in self.runs.values()))

    def _forget_silent(self) -> None:
        begun = time.monotonic() - SILENT_S
        for run_id, live in [item for item in self.runs.items() if item[1].heard < begun]:
            self.end(run_id, live)
