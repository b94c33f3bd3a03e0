"""The websocket of workers: frames and messages come in. Viewers: app/live/watching.py."""

from __future__ import annotations

import asyncio
import logging

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from app.abort.links import WorkerLink, WorkerLinks
from app.access import WORKER, allowed
from app.live import uplink
from app.live.hub import Hub
from app.live.relay import Relay
from app.metrics import SOCKETS

router = APIRouter()
log = logging.getLogger(__name__)
MALFORMED = 4400


@router.websocket("/api/v1/worker")
@allowed(WORKER)
async def ingest(socket: WebSocket) -> None:
    """Receive frames and messages from a worker, whose token the gate has checked, and tell it the latch of Abort.

    A malformed message closes the connection with its reason; a worker then connects again and tells everything anew.
    """
    await socket.accept()
    hub: Hub = socket.app.state.hub
    links: WorkerLinks = socket.app.state.desk.links
    relay: Relay = socket.app.state.relay
    link = WorkerLink(socket.send_text, socket.close)
    telling = asyncio.create_task(links.keep(link))
    open_sockets = SOCKETS.labels("worker")
    open_sockets.inc()
    try:
        while True:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            if message.get("bytes") is not None:
                hub.frame(*uplink.frame(message["bytes"]))
            else:
                sent = uplink.message(message["text"])
                if "worker" in sent:
                    links.take(link, sent)
                    continue
                if "contact" in sent:
                    await relay.take(link, sent["contact"])
                    continue
                hub.take(sent["run_id"], sent["attempt"], sent["message"])
    except uplink.BadMessage as error:
        log.warning("closed the connection of a worker: its message %s", error)
        await socket.close(MALFORMED, str(error)[:120])
    except WebSocketDisconnect:
        return
    finally:
        open_sockets.dec()
        telling.cancel()
        await asyncio.gather(telling, return_exceptions=True)
