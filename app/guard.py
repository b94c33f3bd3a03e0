"""What is refused before any endpoint sees it: changes that another site's page asks for, and bodies declared too large."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from app.problems import problem, too_large

SAFE = {"GET", "HEAD", "OPTIONS"}
NOT_ALLOWED = 4403


class Guard:
    """ASGI middleware. Programs send no Origin; a browser's must name the host it talks to, websockets included.

    Bodies that declare no length are counted by the framework (`max_body_size`).
    """

    def __init__(self, app: ASGIApp, limit: int):
        self.app, self.limit = app, limit

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in {"http", "websocket"} or scope.get("method") in SAFE:
            await self.app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        if _same_origin(headers):
            if _declared(headers) > self.limit:
                await too_large(self.limit)(scope, receive, send)
            else:
                await self.app(scope, receive, send)
        elif scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": NOT_ALLOWED, "reason": "not allowed from another site"})
        else:
            await problem(403, "Changes are taken only from this service's own pages and from programs.")(scope, receive, send)


def _declared(headers: Headers) -> int:
    length = headers.get("content-length", "0")
    return int(length) if length.isdecimal() else 0


def _same_origin(headers: Headers) -> bool:
    origin = headers.get("origin")
    return origin is None or urlsplit(origin).netloc == headers.get("host")
