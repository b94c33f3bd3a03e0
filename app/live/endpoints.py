"""The websocket of workers: frames and messages come in. Viewers: app/live/watching.py."""

from __future__ import annotations

import json
import struct

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from app.access import WORKER, allowed
from app.live.hub import Hub

router = APIRouter()
FRAME_HEADER = struct.Struct("<36sI")  # run id, attempt


@router.websocket("/api/v1/worker")
@allowed(WORKER)
async def ingest(socket: WebSocket) -> None:
    """Receive frames and messages from a worker, whose token the gate has checked."""
    await socket.accept()
    hub: Hub = socket.app.state.hub
    try:
        while True:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            if message.get("bytes") is not None:
                run_id, attempt = FRAME_HEADER.unpack_from(message["bytes"])
                hub.frame(run_id.decode(), attempt, message["bytes"][FRAME_HEADER.size :])
            else:
                sent = json.loads(message["text"])
                hub.take(sent["run_id"], sent["attempt"], sent["message"])
    except WebSocketDisconnect:
        return
