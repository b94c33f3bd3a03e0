"""The websocket of viewers: a run is sent to whoever watches it."""

from __future__ import annotations

import asyncio
from typing import Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from app.access import Role, allowed
from app.db import unit_of_work
from app.live import from_recording
from app.live.frames import FrameStore
from app.live.hub import Hub, LiveRun
from app.live.messages import progress
from app.runs.exports import recording_path
from app.runs.repository import RunRepository
from app.runs.schemas import RunOut
from rths_engine.foundation.errors import RecordingError

router = APIRouter()
SHORTEST_GAP_S = 1 / 60
WAITING_POLL_S = 0.25
UNKNOWN_RUN, UNREADABLE = 4404, 4409


@router.websocket("/api/v1/runs/{run_id}/live")
@allowed(Role.VIEWER, remembered=True)
async def watch(socket: WebSocket, run_id: str) -> None:
    """Send a run to a viewer: schema, buckets from number `from` on, live frames, and the end; see docs/architecture.md."""
    await socket.accept()
    viewer = _Viewer(socket, run_id, _bucket(socket.query_params.get("from", "0")))
    leaving = asyncio.create_task(_left(socket))
    telling = asyncio.create_task(viewer.tell())
    await asyncio.wait({leaving, telling}, return_when=asyncio.FIRST_COMPLETED)
    for task in (leaving, telling):
        task.cancel()
    for outcome in await asyncio.gather(leaving, telling, return_exceptions=True):
        if isinstance(outcome, Exception) and not isinstance(outcome, WebSocketDisconnect | RuntimeError):
            raise outcome


class _Viewer:
    """One viewer: a cursor into the buffer of a run."""

    def __init__(self, socket: WebSocket, run_id: str, cursor: int):
        self.socket, self.run_id, self.cursor = socket, run_id, cursor
        self.hub: Hub = socket.app.state.hub

    async def tell(self) -> None:
        told: LiveRun | None = None
        while True:
            live = self.hub.runs.get(self.run_id)
            if live is not None:
                if told is not None and told is not live:
                    self.cursor = 0
                told = live
                await self._follow(live)
                continue
            run = await asyncio.to_thread(self._run)
            if run is None:
                return await self.socket.close(UNKNOWN_RUN, "there is no such run")
            if run.state.ended:
                return await self._end(run, told)
            await self.socket.send_json(progress(run.state, 0.0, 0.0, run.duration_s))
            await asyncio.sleep(WAITING_POLL_S)

    async def _follow(self, live: LiveRun) -> None:
        run = await asyncio.to_thread(self._run)
        await self.socket.send_json({**live.schema, "run": run.model_dump(mode="json") if run else None})
        last: dict[str, Any] | None = None
        while True:
            changed = live.changed
            frame = live.store.since(self.cursor)
            if frame is not None:
                self.cursor = live.store.count
                await self.socket.send_bytes(frame)
            if live.progress is not last and live.progress is not None:
                last = live.progress
                await self.socket.send_json(last)
            if live.ended or self.hub.runs.get(self.run_id) is not live:
                return
            await asyncio.sleep(SHORTEST_GAP_S)
            await changed.wait()

    async def _end(self, run: RunOut, told: LiveRun | None) -> None:
        """Send the buckets that the viewer has not seen live, from the recording, and then the end of the run."""
        if run.recording and not self._saw_all(run, told):
            try:
                schema, store = await asyncio.to_thread(self._replay, run.attempt)
            except (OSError, RecordingError):
                return await self.socket.close(UNREADABLE, "the recording is missing or damaged")
            if told is None or told.attempt != run.attempt:
                self.cursor = self.cursor if told is None else 0
                await self.socket.send_json({**schema, "run": run.model_dump(mode="json")})
            frame = store.since(self.cursor)
            if frame is not None:
                await self.socket.send_bytes(frame)
        await self.socket.send_json(progress(run.state, run.simulated_s or 0.0, run.elapsed_s or 0.0, run.duration_s))
        await self.socket.send_json({"type": "end", "run": run.model_dump(mode="json")})
        await self.socket.close()

    def _saw_all(self, run: RunOut, told: LiveRun | None) -> bool:
        if told is None or told.attempt != run.attempt or run.simulated_s is None:
            return False
        substeps: int = round(run.simulated_s / told.schema["dt"])
        return self.cursor >= -(-substeps // int(told.schema["bucket"]))

    def _replay(self, attempt: int) -> tuple[dict[str, Any], FrameStore]:
        with unit_of_work(self.socket.app.state.sessions) as session:
            run = RunRepository(session).get(self.run_id)
            if run is None:
                raise RecordingError("the run was removed")
            path = recording_path(run, self.socket.app.state.settings)
        return from_recording.replay(path, attempt)

    def _run(self) -> RunOut | None:
        with unit_of_work(self.socket.app.state.sessions) as session:
            found = RunRepository(session).get(self.run_id)
            return RunOut.of(found) if found else None


async def _left(socket: WebSocket) -> None:
    """Wait until the viewer leaves. Messages of viewers are ignored."""
    while (await socket.receive())["type"] != "websocket.disconnect":
        pass


def _bucket(text: str) -> int:
    return int(text) if text.isdecimal() and len(text) < 10 else 0
