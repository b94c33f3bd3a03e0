"""Requests that are refused before an endpoint sees them: for or from another host, too large, or with NUL in the address."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app import headers
from app.config import PROBES, Settings
from app.own_names import is_address
from app.problems import problem, too_large

SAFE = {"GET", "HEAD", "OPTIONS"}
NOT_ALLOWED = 4403
ELSEWHERE = (
    "This service accepts changes from its own pages and from programs, not from pages of other sites. "
    "If the service is behind a proxy, keep the Host header and set RTHS_HOSTS to the host name that browsers use."
)


class Guard:
    """ASGI middleware that checks Host and Origin of requests and websockets, and completes the headers of every answer.

    The host of a request must be in `Settings.known_hosts`: otherwise a page of another site could read this service under a
    foreign name that resolves to this machine. An IP address is no such name. Programs send no Origin; the Origin of a browser
    must equal the host of the request. A websocket without Origin is a program, such as a worker that connects by an address,
    and may use any host. `Bodies` and the framework count bodies that declare no length.
    """

    def __init__(self, app: ASGIApp, settings: Settings):
        self.app, self.limit = app, settings.body_limit
        self.known, self.by_any_address = settings.known_hosts, settings.by_any_address

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in {"http", "websocket"}:
            await self.app(scope, receive, send)
            return
        refusal = self._refusal(scope, Headers(scope=scope))
        if scope["type"] == "http":
            await (refusal or self.app)(scope, receive, _completing(send))
        elif refusal is None:
            await self.app(scope, receive, send)
        else:
            await send({"type": "websocket.close", "code": NOT_ALLOWED, "reason": "not allowed"})

    def _refusal(self, scope: Scope, given: Headers) -> Response | None:
        if "\0" in scope["path"] or b"%00" in scope["query_string"]:
            return problem(400, "The address has a NUL character.")
        if not self._at_home(scope, given):
            return problem(421, self._other_host(given.get("host", "")))
        if scope.get("method") in SAFE:
            return None
        if not _own(given):
            return problem(403, ELSEWHERE)
        limit = self.limit(scope["path"], given.get("content-type", ""))
        return too_large(limit) if _declared(given) > limit else None

    def _at_home(self, scope: Scope, given: Headers) -> bool:
        """Whether the request is for this service by the name that it asks for."""
        if scope["path"] in PROBES:
            return True
        if scope["type"] == "websocket" and "origin" not in given:
            return True
        host = _hostname(given.get("host", ""))
        return host in self.known or (self.by_any_address and is_address(host))

    def _other_host(self, host: str) -> str:
        known = ", ".join(sorted(self.known))
        return (
            f"This service does not answer for the host {host[:80] or '(none)'}. Use one of its host names ({known}), "
            "or add the host name to RTHS_HOSTS and start the service again."
        )


def _own(given: Headers) -> bool:
    """Whether a change comes from a program or from a page of the service."""
    origin = given.get("origin")
    if origin is None:
        return True
    try:
        return urlsplit(origin).netloc == given.get("host")
    except ValueError:
        return False


def _hostname(host: str) -> str | None:
    """The name in a Host header, without the port; None where it is not valid."""
    try:
        return urlsplit(f"//{host}").hostname
    except ValueError:
        return None


def _completing(send: Send) -> Send:
    """`send` with the headers of every answer where an answer does not set its own."""

    async def completed(message: Message) -> None:
        if message["type"] == "http.response.start":
            given = MutableHeaders(scope=message)
            for name, value in headers.EVERY.items():
                given.setdefault(name, value)
        await send(message)

    return completed


def _declared(given: Headers) -> int:
    length = given.get("content-length", "0")
    return int(length[:20]) if length.isdecimal() else 0
