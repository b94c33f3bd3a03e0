"""The websocket of workers: frames and messages come in. Viewers: app/live/watching.py."""

from __future__ import annotations

import hmac
import json
import struct

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from app.live.hub import Hub

router = APIRouter()
FRAME_HEADER = struct.Struct("<36sI")  # run id, attempt
NOT_ALLOWED = 4403


@router.websocket("/api/v1/worker")
async def ingest(socket: WebSocket) -> None:
    """Receive frames and messages from a worker that sends the worker token."""
    token = socket.headers.get("authorization", "").removeprefix("Bearer ")
    await socket.accept()
    if not hmac.compare_digest(token.encode(), socket.app.state.settings.worker_token.encode()):
        await socket.close(NOT_ALLOWED, "wrong worker token")
        return
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
