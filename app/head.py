"""HEAD requests: every address that answers GET answers HEAD with the same status and headers and no body."""

from __future__ import annotations

from contextlib import suppress

from starlette.types import ASGIApp, Message, Receive, Scope, Send


class Head:
    """ASGI middleware that runs a HEAD request as GET until the response headers are sent; the body is not read."""

    def __init__(self, app: ASGIApp):
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or scope["method"] != "HEAD":
            await self.app(scope, receive, send)
            return

        async def only_headers(message: Message) -> None:
            await send(message)
            if message["type"] == "http.response.start":
                await send({"type": "http.response.body", "body": b""})
                raise _Answered

        asked = {**scope, "method": "GET"}
        with suppress(_Answered):
            await self.app(asked, receive, only_headers)
        scope["route"] = asked.get("route")


class _Answered(Exception):
    """The headers are sent; the response is complete."""
