"""Connections of the web server: bounded for each client address, and closed where no request comes or no answer is taken."""

from __future__ import annotations

import asyncio
import resource
import socket
from contextlib import suppress
from typing import Any

from uvicorn.protocols.http.auto import AutoHTTPProtocol

MOST_OF_ADDRESS = 500  # browsers open six for each page, and one for each live view
FIRST_REQUEST_S = 20.0
TAKES_S = 300.0
"""A client that takes nothing of what is sent for so long loses its connection, and what waits for it is freed.

A client that reads slowly tells the system only when a good part of its buffer is free: with one of 128 kB, one that takes
less than about half a kilobyte each second counts as one that takes nothing.
"""
FILES = 65_536
_open: dict[str, set[asyncio.Transport]] = {}


class Bounded(AutoHTTPProtocol):  # type: ignore[misc,valid-type]
    """The protocol of a connection. An address that has MOST_OF_ADDRESS connections gets no more, so that others get theirs.

    A connection whose first request is not complete after FIRST_REQUEST_S is closed, and so is one on which the head of a
    later request, or a body that nobody reads any more, trickles for as long.
    """

    _due: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:
        """Take the connection, or close it at once."""
        super().connection_made(transport)
        peer: Any = transport.get_extra_info("peername")
        address = str(peer[0]) if peer else ""
        known = {one for one in _open.get(address, ()) if not one.is_closing()}  # also those that became websockets
        if len(known) >= MOST_OF_ADDRESS:
            transport.abort()
            return
        _open[address] = known | {transport}
        asyncio.get_running_loop().call_later(FIRST_REQUEST_S, self._close_without_request)

    def data_received(self, data: bytes) -> None:
        """Take what came; between requests, a whole head must follow in time."""
        super().data_received(data)
        if self._due is None and self.cycle is not None and self.cycle.response_complete:
            self._due = asyncio.get_running_loop().call_later(FIRST_REQUEST_S, self._close_without_next, self.cycle)

    def _close_without_next(self, last: Any) -> None:
        self._due = None
        if self.cycle is last:
            self._close()

    def _close_without_request(self) -> None:
        if self.cycle is None:
            self._close()

    def _close(self) -> None:
        there = self.transport is not None and not self.transport.is_closing()
        if there and self.transport.get_protocol() is self:  # else it became a websocket
            self.transport.close()


def bound_waiting(listening: socket.socket) -> None:
    """Let the system close connections of this socket whose other end takes nothing for TAKES_S, where it can (Linux).

    Otherwise a client that stops reading and does not close keeps its connection, and what waits for it, for ever: neither
    closing such a connection nor a keepalive of the websocket ends it before all is sent.
    """
    if hasattr(socket, "TCP_USER_TIMEOUT"):
        listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, int(TAKES_S * 1000))


def allow_files() -> None:
    """Let this process open as many files and connections as the system allows it, at most FILES."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = FILES if hard == resource.RLIM_INFINITY else min(FILES, hard)
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, wanted), hard))
