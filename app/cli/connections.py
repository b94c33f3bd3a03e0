"""Connections of the web server: bounded for each client address, and closed where no request comes."""

from __future__ import annotations

import asyncio
import resource
from contextlib import suppress
from typing import Any

from uvicorn.protocols.http.auto import AutoHTTPProtocol

MOST_OF_ADDRESS = 500  # browsers open six for each page, and one for each live view
FIRST_REQUEST_S = 20.0
FILES = 65_536
_open: dict[str, set[asyncio.Transport]] = {}


class Bounded(AutoHTTPProtocol):  # type: ignore[misc,valid-type]
    """The protocol of a connection. An address that has MOST_OF_ADDRESS connections gets no more, so that others get theirs.

    A connection whose first request is not complete after FIRST_REQUEST_S is closed.
    """

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

    def _close_without_request(self) -> None:
        idle = self.cycle is None and self.transport is not None and not self.transport.is_closing()
        if idle and self.transport.get_protocol() is self:  # else it became a websocket
            self.transport.close()


def allow_files() -> None:
    """Let this process open as many files and connections as the system allows it, at most FILES."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = FILES if hard == resource.RLIM_INFINITY else min(FILES, hard)
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, wanted), hard))
