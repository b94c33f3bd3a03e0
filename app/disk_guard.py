"""While the disk is low, requests that create something are refused before their body is read."""

from __future__ import annotations

import re

from fastapi.routing import iter_route_contexts
from starlette._utils import get_route_path
from starlette.datastructures import Headers
from starlette.routing import compile_path
from starlette.types import ASGIApp, Receive, Scope, Send

from app import disk
from app.config import MEGABYTE, Settings
from app.full import DiskFull
from app.metrics import REFUSED
from app.problems import storage_full

CREATES = 201  # the status of a route that creates something
ALSO = ("/api/v1/sweeps/{sweep_id}/resume", "/api/v1/laboratory/logo")
SMALL_ROWS = frozenset(
    {
        "/api/v1/accounts",
        "/api/v1/accounts/{account_id}/password-link",
        "/api/v1/account/tokens",
        "/api/v1/webhooks",
        "/api/v1/webhooks/{webhook_id}/test",
        "/api/v1/rigs",
        "/api/v1/runs/views",
        "/api/v1/runs/{run_id}/annotations",
        "/api/v1/mappings",
        "/api/v1/library/plans",
        "/api/v1/library/plans/{plan_id}/versions",
        "/api/v1/library/plans/{plan_id}/duplicate",
    }
)
"""Routes that create one row of a few kilobytes: the reserve has room for them."""


class DiskGuard:
    """ASGI middleware that answers 507 to requests that would create something on a disk below its reserve.

    A route creates something where it declares the status 201, or is in ALSO. What only reads, changes or deletes goes on:
    abort, cancel, hold, delete and archive work on a full disk. So does a request of at most a megabyte to one of SMALL_ROWS.
    """

    def __init__(self, app: ASGIApp, settings: Settings):
        self.app, self.settings = app, settings
        self._creating: list[tuple[set[str], re.Pattern[str], bool]] | None = None

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http" and scope["method"] in {"POST", "PUT"}:
            try:
                self._require(scope)
            except DiskFull as full:
                REFUSED.labels("disk").inc()
                await storage_full(str(full))(scope, receive, send)
                return
        await self.app(scope, receive, send)

    def _require(self, scope: Scope) -> None:
        """Raise DiskFull for a request that would create something on a disk below its reserve."""
        if self._creating is None:
            found = [one for one in iter_route_contexts(scope["app"].routes) if creates(one)]
            self._creating = [
                (set(one.methods or ()), compile_path(one.path or "")[0], one.path in SMALL_ROWS) for one in found
            ]
        path, size = get_route_path(scope), _declared(Headers(scope=scope))
        for methods, pattern, small in self._creating:
            if scope["method"] in methods and pattern.match(path):
                if not (small and size <= MEGABYTE):
                    disk.require(self.settings, size)
                return


def creates(route: object) -> bool:
    """Whether a route creates something."""
    methods = getattr(route, "methods", None) or set()
    return bool(methods & {"POST", "PUT"}) and (
        getattr(route, "status_code", None) == CREATES or getattr(route, "path", None) in ALSO
    )


def _declared(headers: Headers) -> int:
    length = headers.get("content-length", "0")
    return int(length) if length.isdecimal() and len(length) < 20 else 0
