"""Each request gets an id, a line in the log and its place in the metrics; an unexpected error names the id."""

from __future__ import annotations

import logging
import re
import secrets
import time

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app import logs, metrics
from app.access import PERSON
from app.problems import unexpected

log = logging.getLogger("rths.web")
HEADER = "X-Request-ID"
WELL_FORMED = re.compile(r"[A-Za-z0-9._-]{8,64}")
METHODS = {"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"}
UNMATCHED = "unmatched"
ABORT = "/api/v1/abort"
QUIET = {"/livez", "/healthz", "/readyz", "/metrics", "/static"}  # asked for all the time: logged at the level debug


class Observed:
    """ASGI middleware around all others. A well-formed X-Request-ID of the client is kept; the answer carries the id."""

    def __init__(self, app: ASGIApp):
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in {"http", "websocket"}:
            await self.app(scope, receive, send)
            return
        request_id = identifier(Headers(scope=scope).get(HEADER))
        scope["request_id"] = request_id
        with logs.about(request_id=request_id):
            if scope["type"] == "http":
                await self._answer(scope, receive, send)
            else:
                await self.app(scope, receive, send)

    async def _answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        begun, status = time.perf_counter(), 0

        async def named(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                MutableHeaders(scope=message)[HEADER] = scope["request_id"]
            await send(message)

        metrics.IN_PROGRESS.inc()
        try:
            await self.app(scope, receive, named)
        except Exception:
            if status:
                raise  # the answer has begun: the server closes the connection
            log.exception("%s %s failed", scope["method"], template(scope))
            await unexpected(scope["request_id"])(scope, receive, named)
        finally:
            metrics.IN_PROGRESS.dec()
            _tell(scope, status, time.perf_counter() - begun)


def identifier(given: str | None) -> str:
    """The id of a request: the one that its client gave, if it is well formed, else a new one."""
    return given if given and WELL_FORMED.fullmatch(given) else secrets.token_hex(8)


def template(scope: Scope) -> str:
    """The route that a request matched, with the names of its parameters in place of their values."""
    route = scope.get("route")
    if route is not None:
        return str(route.path)
    return "/static" if scope["path"].startswith("/static/") else UNMATCHED


def _tell(scope: Scope, status: int, seconds: float) -> None:
    method, route = scope["method"] if scope["method"] in METHODS else "other", template(scope)
    metrics.REQUESTS.labels(method, route, str(status)).inc()
    metrics.REQUEST_SECONDS.labels(method, route).observe(seconds)
    if route == ABORT and method == "POST" and status < 400:
        metrics.ABORT_SECONDS.observe(seconds)
    level = logging.DEBUG if route in QUIET and status != 500 else logging.WARNING if status >= 500 else logging.INFO
    told = {"method": method, "route": route, "status": status, "ms": round(1e3 * seconds, 1)}
    if PERSON in scope:
        told["account"] = scope[PERSON].name
    log.log(level, "request", extra={"fields": told})
