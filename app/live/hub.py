"""The live runs of the web service: the frames and messages of workers, for viewers."""

from __future__ import annotations

import asyncio
from typing import Any

from app.live.frames import FrameStore


class LiveRun:
    """One attempt of a run, as sent by its worker. `changed` is set at the next change, and then replaced."""

    def __init__(self, attempt: int, schema: dict[str, Any]):
        self.attempt, self.schema = attempt, schema
        self.store = FrameStore(len(schema["channels"]))
        self.progress: dict[str, Any] | None = None
        self.ended = False
        self.changed = asyncio.Event()

    def notify(self) -> None:
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
                self.runs[run_id] = LiveRun(attempt, message)
                if live is not None:
                    live.notify()
        elif live is not None and live.attempt <= attempt:
            if message["type"] == "progress":
                live.progress = message
            else:
                live.ended = True
                del self.runs[run_id]
            live.notify()

    def frame(self, run_id: str, attempt: int, frame: bytes) -> None:
        live = self.runs.get(run_id)
        if live is not None and live.attempt == attempt and live.store.append(frame):
            live.notify()
