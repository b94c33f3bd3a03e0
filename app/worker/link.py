"""The websockets from a worker to the web services: frames and messages go up, the latch of Abort both ways.

Frames may be lost; the recording is complete. Each connection has a thread that sends and one that listens, so that a service
that reads slowly does not delay Abort.
"""

from __future__ import annotations

import json
import logging
import threading
import time
from contextlib import suppress
from typing import Any

from websockets.exceptions import ConnectionClosedError, WebSocketException
from websockets.sync.client import ClientConnection, connect

from app.live.frames import FrameStore, end_of
from app.live.uplink import FRAME_HEADER
from app.open_sockets import NOT_ALLOWED
from app.worker.contact import Contact
from app.worker.stopping import Stopper
from app.worker.trust import context

log = logging.getLogger(__name__)
SHORTEST_GAP_S = 0.02
ASK_AGAIN_S = 1.0
BACK_OFF_S = (0.2, 5.0)


class Telling:
    """All frames and messages of one execution, stored so that they can be sent again over a new connection."""

    def __init__(self, run_id: str, attempt: int):
        self.run_id, self.attempt = run_id, attempt
        self.schema: dict[str, Any] | None = None
        self.progress: dict[str, Any] | None = None
        self.store: FrameStore | None = None
        self.ended = False

    def take(self, message: Any) -> None:
        """Take a message of the engine: schema, progress or a frame."""
        if isinstance(message, bytes):
            if self.store is not None:
                self.store.append(message)
        elif message["type"] == "schema":
            self.store, self.schema = FrameStore(len(message["channels"])), message
        else:
            self.progress = message

    def only_end(self) -> Telling:
        """The end without frames and messages: they are in the recording."""
        end = Telling(self.run_id, self.attempt)
        end.ended = True
        return end


class _Cursor:
    """What one connection has already sent of one execution."""

    def __init__(self, telling: Telling):
        self.telling = telling
        self.schema_told, self.bucket = False, 0
        self.progress: dict[str, Any] | None = None

    def tell(self, socket: ClientConnection) -> bool:
        """Send everything new; returns whether the end was sent."""
        telling = self.telling
        ended = telling.ended
        if telling.schema is not None and telling.store is not None:
            if not self.schema_told:
                self._say(socket, telling.schema)
                self.schema_told = True
            while (frame := telling.store.since(self.bucket)) is not None:
                self.bucket = end_of(frame)
                socket.send(FRAME_HEADER.pack(telling.run_id.encode(), telling.attempt) + frame)
            if telling.progress is not None and telling.progress is not self.progress:
                self.progress = telling.progress
                self._say(socket, telling.progress)
        if ended:
            self._say(socket, {"type": "end"})
        return ended

    def _say(self, socket: ClientConnection, message: dict[str, Any]) -> None:
        socket.send(json.dumps({"run_id": self.telling.run_id, "attempt": self.telling.attempt, "message": message}))


class Link:
    """The connection to one web service. It reconnects after pauses and then sends everything again."""

    def __init__(self, url: str, token: str, worker: str = "", stopper: Stopper | None = None, contact: Contact | None = None):
        self.url, self.token, self.worker, self.stopper, self.contact = url, token, worker, stopper, contact
        self._tellings: list[Telling] = []
        self._lock = threading.Lock()
        self._due, self._changed = threading.Event(), threading.Event()
        threading.Thread(target=self._keep, daemon=True, name="rths-link").start()

    def add(self, telling: Telling) -> None:
        """Send the frames and messages of an execution."""
        with self._lock:
            self._tellings.append(telling)

    def tell_latch(self) -> None:
        """Say at once what this worker knows of Abort."""
        self._changed.set()
        self._due.set()

    def _keep(self) -> None:
        delay = BACK_OFF_S[0]
        while True:
            begun = time.monotonic()
            try:
                headers = {"Authorization": f"Bearer {self.token}"}
                with connect(
                    self.url, ssl=context(self.url), additional_headers=headers, compression=None, max_size=None
                ) as socket:
                    listening = threading.Thread(target=self._listen, args=(socket,), daemon=True, name="rths-link-listens")
                    listening.start()
                    self._tell(socket)
            except (OSError, WebSocketException) as error:
                refused = isinstance(error, ConnectionClosedError) and error.rcvd is not None and error.rcvd.code == NOT_ALLOWED
                log.log(logging.WARNING if refused else logging.INFO, "no connection to the web at %s: %s", self.url, error)
            self._forget_ended()
            if time.monotonic() - begun > BACK_OFF_S[1]:
                delay = BACK_OFF_S[0]
            time.sleep(delay)
            delay = min(2 * delay, BACK_OFF_S[1])

    def _forget_ended(self) -> None:
        """Free the memory of runs that have ended while there is no connection; their ends are sent after it is back."""
        with self._lock:
            self._tellings = [telling.only_end() if telling.ended else telling for telling in self._tellings]

    def _listen(self, socket: ClientConnection) -> None:
        """Take the latch whenever the service tells it."""
        with suppress(WebSocketException, OSError):
            for message in socket:
                told = json.loads(message)
                if self.stopper is not None and "latch" in told:
                    self.stopper.latch.take(told["latch"])
                if self.contact is not None and "contact" in told:
                    self.contact.answer(told["contact"])
        self._due.set()

    def _tell(self, socket: ClientConnection) -> None:
        cursors: dict[int, _Cursor] = {}
        self._changed.set()
        asked = -ASK_AGAIN_S
        while True:
            if self._changed.is_set() and self.stopper is not None:
                self._changed.clear()
                socket.send(json.dumps({"worker": self.worker, **self.stopper.as_dict()}))
            due = self.contact is not None and time.monotonic() - asked >= ASK_AGAIN_S
            if due and self.contact is not None and (question := self.contact.question()) is not None:
                asked = time.monotonic()
                socket.send(json.dumps({"contact": question}))
            with self._lock:
                tellings = list(self._tellings)
            for telling in tellings:
                if cursors.setdefault(id(telling), _Cursor(telling)).tell(socket):
                    del cursors[id(telling)]
                    with self._lock:
                        self._tellings.remove(telling)
            self._due.wait(SHORTEST_GAP_S)
            self._due.clear()
            if socket.close_code is not None:
                raise socket.protocol.close_exc


class Links:
    """The connections to all web services: `web` are their addresses, separated by commas."""

    def __init__(self, web: str, token: str, worker: str, stopper: Stopper, contact: Contact | None = None):
        addresses = [one.strip() for one in web.split(",") if one.strip()]
        self._links = [Link(f"{one}/api/v1/worker", token, worker, stopper, contact) for one in addresses]
        stopper.tell = self._tell_latch

    def open(self, run_id: str, attempt: int) -> Telling:
        """Tell every service what happens in an execution."""
        telling = Telling(run_id, attempt)
        for link in self._links:
            link.add(telling)
        return telling

    def _tell_latch(self) -> None:
        for link in self._links:
            link.tell_latch()
