"""What the audit log records of requests: those that changed something, and those that were refused for want of a right.

A request that uses the session of the database is recorded in its transaction (`record`, called by the dependency `session`).
The middleware records the others after they were answered: changes of files, Abort, and refusals. No feature records anything
itself.
"""

from __future__ import annotations

from typing import Any

import sqlalchemy as sa
from fastapi import Request
from sqlalchemy.orm import Session
from starlette.routing import BaseRoute
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.access import ENDED, LEADS, PERSON, SignedIn
from app.audit import actions, given
from app.audit.log import Acting, AuditLog
from app.audit.recorder import Recorder, Waiting
from app.db import ONLY_LOCKS

RECORDED, GIVEN, REQUEST = "audit_recorded", "audit_given", "audit request"
CHANGED = "audit changed rows"
CHANGING = frozenset({"INSERT", "UPDATE", "DELETE"})
REFUSED = frozenset({401, 403})
REFUSED_SOCKET = frozenset({4401, 4403})
MOST_MADE = 500
SHARES = frozenset({"sweep_shard"})  # tables whose rows are only shares of something larger


async def given_in(request: Request) -> dict[str, Any]:
    """Dependency: what the log keeps of the JSON body of a request that changes something; its endpoint reads the body too."""
    route = request.scope.get("route")
    kept: dict[str, Any] = {}
    json = request.headers.get("content-type", "").startswith("application/json")
    if json and actions.changes(request.method, route) and getattr(route, "body_field", None) is not None:
        kept = given.kept(actions.area_of(request.url.path), await request.body())
    request.scope.setdefault("state", {})[GIVEN] = kept
    return kept


def watch(session: Session) -> list[dict[str, Any]]:
    """The rows that the session of a request adds, as they are flushed: those with an id of their own."""
    made: list[dict[str, Any]] = []
    session.info[REQUEST], session.info[CHANGED] = True, 0

    def executed(_: Any, cursor: Any, statement: str, __: Any, context: Any, ___: Any) -> None:
        if statement.lstrip()[:6].upper() in CHANGING and ONLY_LOCKS not in context.execution_options:
            counted = "RETURNING" not in statement and cursor.rowcount >= 0
            session.info[CHANGED] += cursor.rowcount if counted else 1

    sa.event.listen(session, "after_begin", lambda _, __, begun: sa.event.listen(begun, "after_cursor_execute", executed))
    sa.event.listen(session, "after_flush", lambda flushed, _: made.extend(_made(flushed)))
    return made


def recorded(session: Session) -> bool:
    """Whether the session belongs to a request, which is recorded as a whole."""
    return REQUEST in session.info


def record(session: Session, request: Request, made: list[dict[str, Any]]) -> None:
    """Record a request that its endpoint has executed, in the transaction of the session."""
    route = request.scope.get("route")
    if not actions.changes(request.method, route):
        return
    session.flush()
    more: dict[str, Any] = {"made": made[:MOST_MADE], "made_in_all": len(made)} if made else {}
    if not session.info[CHANGED]:
        more["rows_changed"] = 0  # nothing was to be done, or files only
    AuditLog(session).add(*_entry(request.scope, route, **more))
    request.scope["state"][RECORDED] = True


class Recording:
    """ASGI middleware that records what `record` did not: changes outside of the database, and refusals."""

    def __init__(self, app: ASGIApp):
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in {"http", "websocket"}:
            return await self.app(scope, receive, send)
        scope.setdefault("state", {})

        async def seen(message: Message) -> None:
            if message["type"] in {"http.response.start", "websocket.http.response.start"}:
                self._answered(scope, message["status"])
            elif message["type"] == "websocket.close" and message.get("code") in REFUSED_SOCKET and ENDED not in scope:
                self._answered(scope, 403)
            await send(message)

        await self.app(scope, receive, seen)

    def _answered(self, scope: Scope, status: int) -> None:
        """Hand an answered request to the recorder, which never makes the answer wait."""
        recorder: Recorder | None = getattr(scope["app"].state, "audit", None) if "app" in scope else None
        if recorder is None:
            return
        route = scope.get("route")
        if status in REFUSED and _tried(scope, status):
            acting, action, about, details = _entry(scope, route, status=status)
            recorder.refused(Waiting(acting, f"refused.{action}", about, details))
        elif status < 400 and not scope["state"].get(RECORDED) and actions.changes(scope.get("method", "GET"), route):
            recorder.put(Waiting(*_entry(scope, route)))


def _tried(scope: Scope, status: int) -> bool:
    """Whether somebody tried something. A page that reads on after its session has ended did not."""
    reads = scope.get("method", "websocket") in actions.SAFE
    return status != 401 or not reads or any(name == b"authorization" for name, _ in scope["headers"])


def _entry(scope: Scope, route: BaseRoute | None, **more: Any) -> tuple[Acting, str, str, dict[str, Any]]:
    """Who, action, about and details of a request."""
    kept: dict[str, Any] = scope["state"].get(GIVEN) or {}
    if "status" in more and PERSON not in scope:
        kept = {}  # what a stranger types as a name may be a password
    known = route is not None or scope.get(LEADS, False)
    path = actions.without_keys(scope["path"]) if known else actions.UNKNOWN
    details = {"method": scope.get("method", "websocket"), "path": path, "address": _address(scope), **more}
    if kept:
        details["given"] = kept
    what = actions.action(route, path), actions.without_keys(actions.about(scope.get("path_params") or {}))
    return _acting(scope, kept, more.get("made") or []), *what, details


def _acting(scope: Scope, kept: dict[str, Any], made: list[dict[str, Any]]) -> Acting:
    """Who made a request: the account, or without accounts the name that the request gives."""
    found: SignedIn | None = scope.get(PERSON)
    if found is None:
        return Acting(str(kept.get("name", "")), "", "not signed in")  # signs in now
    names = [given.name_in(kept), *(str(one["submitted_by"]) for one in made if "submitted_by" in one), found.name]
    typed = next(name for name in names if name)
    return Acting(found.named(typed), found.role.name.lower(), found.how)


def _address(scope: Scope) -> str:
    return str(scope["client"][0]) if scope.get("client") else ""


def _made(session: Session) -> list[dict[str, Any]]:
    found = []
    for row in session.new:
        table, own = str(getattr(row, "__tablename__", "")), getattr(row, "id", None)
        if isinstance(own, str) and table not in SHARES:
            shown = ("number", "digest", "submitted_by")
            found.append({"is": f"{table}:{own}", **{name: getattr(row, name) for name in shown if getattr(row, name, None)}})
    return found
