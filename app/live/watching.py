"""The websocket of viewers: a run is sent to whoever watches it."""

from __future__ import annotations

import asyncio
import json
import time

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from app.access import Role, allowed
from app.live.audience import POLL_S, Audience, Row, Watched
from app.live.frames import end_of
from app.live.hub import Hub, LiveRun
from app.live.messages import progress
from app.metrics import FRAME_LAG_SECONDS, SOCKETS
from rths_engine.foundation.errors import RecordingError

router = APIRouter()
SILENT_S = 2.0
"""Where nothing came for so long, the row of the run says whether it has ended: its worker may be gone."""
UNKNOWN_RUN, UNREADABLE = 4404, 4409


@router.websocket("/api/v1/runs/{run_id}/live")
@allowed(Role.VIEWER, remembered=True)
async def watch(socket: WebSocket, run_id: str) -> None:
    """Send a run to a viewer: schema, buckets from number `from` on, live frames, and the end; see docs/architecture.md."""
    await socket.accept()
    open_sockets = SOCKETS.labels("viewer")
    open_sockets.inc()
    audience: Audience = socket.app.state.audience
    watched = audience.enter(run_id)
    try:
        viewer = _Viewer(socket, watched, _bucket(socket.query_params.get("from", "0")))
        leaving = asyncio.create_task(_left(socket))
        telling = asyncio.create_task(viewer.tell())
        await asyncio.wait({leaving, telling}, return_when=asyncio.FIRST_COMPLETED)
        for task in (leaving, telling):
            task.cancel()
        for outcome in await asyncio.gather(leaving, telling, return_exceptions=True):
            if isinstance(outcome, Exception) and not isinstance(outcome, WebSocketDisconnect | RuntimeError):
                raise outcome
    finally:
        open_sockets.dec()
        audience.leave(watched)


class _Viewer:
    """One viewer: a cursor into the buffer of a run. A slow viewer misses changes and then gets larger frames."""

    def __init__(self, socket: WebSocket, watched: Watched, cursor: int):
        self.socket, self.watched, self.cursor = socket, watched, cursor
        self.hub: Hub = socket.app.state.hub

    async def tell(self) -> None:
        told: LiveRun | None = None
        fresh_since = 0.0
        while True:
            live = self.hub.runs.get(self.watched.run_id)
            if live is not None:
                if told is not None and told is not live:
                    self.cursor = 0
                told = live
                await self._follow(live)
                fresh_since = live.heard
                continue
            row = await self.watched.row(fresh_since)
            if row is None:
                return await self.socket.close(UNKNOWN_RUN, "there is no such run")
            if row.run.state.ended:
                return await self._end(row, told)
            await self._say(progress(row.run.state, 0.0, 0.0, row.run.duration_s))
            await asyncio.sleep(POLL_S)

    async def _follow(self, live: LiveRun) -> None:
        live.viewers += 1
        try:
            row = await self.watched.row()
            await self.socket.send_text(row.within(live.schema) if row else json.dumps({**live.schema, "run": None}))
            await self._stream(live)
        finally:
            live.viewers -= 1

    async def _stream(self, live: LiveRun) -> None:
        told = ""
        while True:
            changed = live.changed
            frame = live.since(self.cursor)
            if frame is not None:
                self.cursor = end_of(frame)
                await self.socket.send_bytes(frame)
                FRAME_LAG_SECONDS.observe(time.monotonic() - live.heard)
            if live.progress_text is not told and live.progress_text:
                told = live.progress_text
                await self.socket.send_text(told)
            if self.hub.runs.get(self.watched.run_id, live) is not live:
                return
            if self.cursor < live.store.count:
                continue
            if live.ended:
                return
            try:
                await asyncio.wait_for(changed.wait(), SILENT_S)
            except TimeoutError:
                row = await self.watched.row()
                if row is not None and (row.run.state.ended or row.run.attempt > live.attempt):
                    self.hub.end(self.watched.run_id, live)

    async def _end(self, row: Row, told: LiveRun | None) -> None:
        """Send the buckets that the viewer has not seen live, from the recording, and then the end of the run."""
        run = row.run
        if run.recording and not self._saw_all(row, told):
            try:
                schema, store = await self.watched.replay()
            except (OSError, RecordingError):
                return await self.socket.close(UNREADABLE, "the recording is missing or damaged")
            if told is None or told.attempt != run.attempt:
                self.cursor = self.cursor if told is None else 0
                await self.socket.send_text(row.within(schema))
            while (frame := store.since(self.cursor)) is not None:
                self.cursor = end_of(frame)
                await self.socket.send_bytes(frame)
        await self._say(progress(run.state, run.simulated_s or 0.0, run.elapsed_s or 0.0, run.duration_s))
        await self.socket.send_text(row.within({"type": "end"}))
        await self.socket.close()

    def _saw_all(self, row: Row, told: LiveRun | None) -> bool:
        run = row.run
        if told is None or told.attempt != run.attempt or run.simulated_s is None:
            return False
        substeps: int = round(run.simulated_s / told.schema["dt"])
        return self.cursor >= -(-substeps // int(told.schema["bucket"]))

    async def _say(self, message: object) -> None:
        await self.socket.send_text(json.dumps(message, separators=(",", ":")))


async def _left(socket: WebSocket) -> None:
    """Wait until the viewer leaves. Messages of viewers are ignored."""
    while (await socket.receive())["type"] != "websocket.disconnect":
        pass


def _bucket(text: str) -> int:
    return int(text) if text.isdecimal() and len(text) < 10 else 0
