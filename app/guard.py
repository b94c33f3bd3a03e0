"""Requests that are refused before an endpoint sees them: from pages of other sites, too large, or with NUL in the address."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from app.config import Settings
from app.problems import problem, too_large

SAFE = {"GET", "HEAD", "OPTIONS"}
NOT_ALLOWED = 4403
ELSEWHERE = (
    "This service accepts changes from its own pages and from programs, not from pages of other sites. "
    "If the service is behind a proxy, keep the Host header and set RTHS_HOSTS to the host name that browsers use."
)


class Guard:
    """ASGI middleware that compares the Origin of a request with its Host, websockets included.

    Programs send no Origin. The Origin of a browser must equal the host of the request, and that host must be in
    `Settings.known_hosts`: otherwise a foreign name that resolves to this machine would pass. The framework counts bodies that
    declare no length (`max_body_size`).
    """

    def __init__(self, app: ASGIApp, settings: Settings):
        self.app, self.limit, self.known = app, settings.body_limit, settings.known_hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        refusal = None
        if scope["type"] in {"http", "websocket"}:
            refusal = self._refusal(scope, Headers(scope=scope))
        if refusal is None:
            await self.app(scope, receive, send)
        elif scope["type"] == "http":
            await refusal(scope, receive, send)
        else:
            await send({"type": "websocket.close", "code": NOT_ALLOWED, "reason": "not allowed"})

    def _refusal(self, scope: Scope, headers: Headers) -> Response | None:
        if "\0" in scope["path"] or b"%00" in scope["query_string"]:
            return problem(400, "The address has a NUL character.")
        if scope.get("method") in SAFE:
            return None
        if not self._own(headers):
            return problem(403, ELSEWHERE)
        limit = self.limit(scope["path"])
        return too_large(limit) if _declared(headers) > limit else None

    def _own(self, headers: Headers) -> bool:
        origin = headers.get("origin")
        if origin is None:
            return True
        try:
            named = urlsplit(origin)
        except ValueError:
            return False
        return named.netloc == headers.get("host") and (not self.known or named.hostname in self.known)


def _declared(headers: Headers) -> int:
    length = headers.get("content-length", "0")
    return int(length[:20]) if length.isdecimal() else 0
