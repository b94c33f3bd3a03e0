"""What is refused before any endpoint sees it: bodies too large, and changes asked for by other sites' pages."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.problems import problem

SAFE = {"GET", "HEAD", "OPTIONS"}


class BodyTooLarge(Exception):
    """More bytes came than the limit allows."""


class Guard:
    """ASGI middleware. A body is refused by its declared length at once, or when the bytes counted pass the limit."""

    def __init__(self, app: ASGIApp, limit: int):
        self.app, self.limit = app, limit

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in {"http", "websocket"}:
            await self.app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        if not _same_origin(headers) and scope.get("method") not in SAFE:
            await self._refuse_origin(scope, receive, send)
        elif scope["type"] == "websocket":
            await self.app(scope, receive, send)
        else:
            await self._limited(scope, receive, send, headers)

    async def _refuse_origin(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 4403, "reason": "not allowed from another site"})
        else:
            await problem(403, "Changes are taken only from this service's own pages and from programs.")(scope, receive, send)

    async def _limited(self, scope: Scope, receive: Receive, send: Send, headers: Headers) -> None:
        declared = headers.get("content-length", "0")
        if not declared.isdigit() or int(declared) > self.limit:
            await self._too_large()(scope, receive, send)
            return
        seen, answered = 0, False

        async def counted() -> Message:
            nonlocal seen
            message = await receive()
            seen += len(message.get("body", b""))
            if seen > self.limit:
                raise BodyTooLarge
            return message

        async def noted(message: Message) -> None:
            nonlocal answered
            answered = True
            await send(message)

        try:
            await self.app(scope, counted, noted)
        except BodyTooLarge:
            if not answered:
                await self._too_large()(scope, receive, send)

    def _too_large(self):  # type: ignore[no-untyped-def]
        return problem(413, f"The request is larger than {self.limit / 1e6:g} MB, the most that is taken.")


def _same_origin(headers: Headers) -> bool:
    """Programs send no Origin; a browser's must name the host it talks to."""
    origin = headers.get("origin")
    return origin is None or urlsplit(origin).netloc == headers.get("host")
