"""Websockets of people that are open, by credential: each closes once its credential has ended or no longer suffices.

The gate serves every websocket of a signed-in person through this module, so that no endpoint looks after itself. Who ends a
credential says so here (app/accounts/credentials.py), and all of them are verified again at regular intervals, with one query
for each table: an ending in another process closes the sockets of this one too.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from typing import Any, NamedTuple

from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocketDisconnect

from app.access import ENDED, Access, Role, SignedIn

NOT_ALLOWED = 4403
CLOSING_S = 5.0  # how long the other end may take to acknowledge the close
OVER = {"session": "your session has ended", "token": "the API token has expired or was revoked"}


class Standing(NamedTuple):
    """What the database says of a credential: whose it is while it is valid, or why it is not."""

    person: SignedIn | None
    why: str = ""


class Ended(OSError):
    """Something is sent to a websocket whose credential has ended."""


class OpenSocket:
    """One websocket of a person, until either end closes it or its credential ends."""

    def __init__(self, person: SignedIn, access: Access, scope: Scope, receive: Receive, send: Send):
        self.person, self.access, self.scope = person, access, scope
        self._receive, self._send = receive, send
        self._loop = asyncio.get_running_loop()
        self._ended: asyncio.Future[Any] = self._loop.create_future()
        self._accepted = asyncio.Event()
        self._begun = False

    async def serve(self, app: ASGIApp) -> None:
        """Let the application talk to the person, and close the websocket once `end` was called."""
        closing = asyncio.create_task(self._close())
        try:
            await app(self.scope, self._received, self._sent)
        except (Ended, WebSocketDisconnect):
            if not self._ended.done():
                raise
        finally:
            if self._ended.done() and self._accepted.is_set():
                await asyncio.wait({closing}, timeout=CLOSING_S)
            closing.cancel()

    def end(self, why: str) -> None:
        """Close the websocket soon. From any thread."""
        with suppress(RuntimeError):  # its event loop has ended, and the websocket with it
            self._loop.call_soon_threadsafe(self._end, why)

    def _end(self, why: str) -> None:
        if not self._ended.done():
            self.scope[ENDED] = True
            self._ended.set_result(why)

    async def _close(self) -> None:
        why = await self._ended
        await self._accepted.wait()
        await self._send({"type": "websocket.close", "code": NOT_ALLOWED, "reason": why})

    async def _received(self) -> Message:
        if not self._begun:
            self._begun = True
            return await self._receive()
        reading: asyncio.Future[Any] = asyncio.ensure_future(self._receive())
        try:
            await asyncio.wait([reading, self._ended], return_when=asyncio.FIRST_COMPLETED)
            if self._ended.done():
                return {"type": "websocket.disconnect", "code": NOT_ALLOWED, "reason": self._ended.result()}
            got: Message = reading.result()
            return got
        finally:
            reading.cancel()

    async def _sent(self, message: Message) -> None:
        if self._ended.done() and self._accepted.is_set():
            raise Ended(self._ended.result())
        await self._send(message)
        if message["type"] == "websocket.accept":
            self._accepted.set()


class OpenSockets:
    """All open websockets of people."""

    def __init__(self) -> None:
        self._open: set[OpenSocket] = set()
        self._lock = threading.Lock()

    @contextmanager
    def held(self, socket: OpenSocket) -> Iterator[OpenSocket]:
        """Keep a websocket here while it is open."""
        with self._lock:
            self._open.add(socket)
        try:
            yield socket
        finally:
            with self._lock:
                self._open.discard(socket)

    def credentials(self, how: str, account_id: str | None = None) -> list[str]:
        """The ids of the sessions or API tokens whose websockets are open; with `account_id` those of one account."""
        mine = [one.person for one in self._listed(how)]
        return sorted({one.credential_id for one in mine if account_id in {None, one.account_id}})

    def settle(self, how: str, standings: Mapping[str, Standing]) -> None:
        """Go by what the database says of credentials, by id."""
        for socket in self._listed(how):
            found = standings.get(socket.person.credential_id)
            if found is None:
                continue
            if found.person is None:
                socket.end(found.why)
            elif isinstance(needed := socket.access.who, Role) and found.person.role < needed:
                socket.end(f"your role is now {found.person.role.name.lower()}; this view needs {needed.name.lower()}")
            else:
                socket.person = found.person

    def expire(self) -> None:
        """Close what has expired: no database is needed for it."""
        now = datetime.now(UTC)
        for how, why in OVER.items():
            for socket in self._listed(how):
                if socket.person.until is not None and socket.person.until <= now:
                    socket.end(why)

    def _listed(self, how: str) -> list[OpenSocket]:
        with self._lock:
            return [one for one in self._open if one.person.how == how]
