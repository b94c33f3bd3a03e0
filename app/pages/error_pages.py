"""Errors as pages for people: a problem becomes a page where a browser asks for one; 401 leads to the sign-in page and back."""

from __future__ import annotations

import json
from urllib.parse import quote

from starlette.datastructures import Headers
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.pages.errors import error_page
from app.problems import MEDIA_TYPE, TITLES

KEPT = ("allow", "retry-after", "x-request-id")  # headers of the problem that the page has too


class ErrorPages:
    """ASGI middleware around all others. Programs ask for no HTML and get problem+json, as does htmx for parts of a page."""

    def __init__(self, app: ASGIApp):
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or not for_a_person(Headers(scope=scope)):
            await self.app(scope, receive, send)
            return
        problem: tuple[int, Headers] | None = None
        body = b""

        async def shown(message: Message) -> None:
            nonlocal problem, body
            if message["type"] == "http.response.start" and Headers(raw=message["headers"]).get("content-type") == MEDIA_TYPE:
                problem = message["status"], Headers(raw=message["headers"])
            elif problem is None:
                await send(message)
            else:
                body += message.get("body", b"")
                if not message.get("more_body", False):
                    detail = json.loads(body)["detail"] if body else ""  # the answer to HEAD has no body
                    await page_of(Request(scope), *problem, detail)(scope, receive, send)

        await self.app(scope, receive, shown)


def for_a_person(given: Headers) -> bool:
    """Whether a request comes from a browser that shows its answer as a page."""
    accept = given.get("accept", "")
    return "text/html" in accept and "json" not in accept and "hx-request" not in given


def page_of(request: Request, status: int, headers: Headers, detail: str) -> Response:
    """The page of a problem."""
    opened = address(request) if request.method in {"GET", "HEAD"} else ""
    if status == 401:
        return RedirectResponse(f"/sign-in?to={quote(opened, safe='')}" if opened else "/sign-in", 303)
    answer = error_page(request, status, TITLES.get(status, "Error"), detail, opened if status >= 500 else "")
    answer.headers.update({name: headers[name] for name in KEPT if name in headers} | {"Vary": "Accept"})
    return answer


def address(request: Request) -> str:
    """Path and query of a request."""
    query = request.scope["query_string"].decode("latin-1")
    return f"{request.scope['path']}?{query}" if query else str(request.scope["path"])
