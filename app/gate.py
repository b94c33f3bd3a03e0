"""The gate: every request passes it before its body is read, and only with the role that the address declares."""

from __future__ import annotations

import hmac
from typing import Any

from fastapi.routing import iter_route_contexts
from sqlalchemy.exc import SQLAlchemyError
from starlette._utils import get_route_path
from starlette.applications import Starlette
from starlette.datastructures import Headers
from starlette.requests import HTTPConnection
from starlette.responses import Response
from starlette.routing import Match, compile_path
from starlette.types import ASGIApp, Receive, Send
from starlette.types import Scope as Connection

from app.access import ACTING, LEADS, LOCAL, PERSON, Access, Open, Role, Scope, SignedIn, declared
from app.config import LOOPBACK, Settings
from app.open_sockets import NOT_ALLOWED, OpenSocket, OpenSockets
from app.problems import problem

KEPT = 4096  # addresses whose declaration is remembered
FORWARDED = ("forwarded", "x-forwarded-for", "x-real-ip")
SIGN_IN = "Sign in at /sign-in, or send an API token in the header `Authorization: Bearer TOKEN`: docs/accounts.md."
UNKNOWN = Access(Role.VIEWER, frozenset(Scope))  # an address that leads nowhere: only who is signed in learns that


class Gate:
    """ASGI middleware that finds the declaration of an address and the person behind a request, and refuses what does not fit.

    The routes are read once, at the first request. An address that leads to no route of then is answered here.
    """

    def __init__(self, app: ASGIApp, settings: Settings):
        self.app, self.settings = app, settings
        self._places: list[Place] = []
        self._known: dict[tuple[str, str, str], tuple[Match, Access | None, bool]] = {}

    async def __call__(self, scope: Connection, receive: Receive, send: Send) -> None:
        if scope["type"] not in {"http", "websocket"}:
            await self.app(scope, receive, send)
            return
        ACTING.set(None)
        match, access = self._access(scope)
        refusal = await self._refusal(scope, access)
        if refusal is None and match is Match.NONE:
            refusal = problem(404, f"There is nothing at {scope['path']}.")
        if refusal is None:
            await self._let_in(scope, access, receive, send)
        elif scope["type"] == "http":
            await refusal(scope, receive, send)
        else:
            await _close(access, receive, send)

    async def _let_in(self, scope: Connection, access: Access | None, receive: Receive, send: Send) -> None:
        """Pass a request on; a websocket of a person only as long as the credential holds."""
        person: SignedIn | None = scope.get(PERSON)
        if scope["type"] == "http" or access is None or person is None or person.how == "local":
            await self.app(scope, receive, send)
            return
        sockets: OpenSockets = scope["app"].state.sockets
        with sockets.held(OpenSocket(person, access, scope, receive, send)) as socket:
            await socket.serve(self.app)

    def _access(self, scope: Connection) -> tuple[Match, Access | None]:
        """Whether the address leads to a route, and the declaration of that route."""
        key = (scope["type"], scope.get("method", ""), get_route_path(scope))
        found = self._known.get(key)
        if found is None:
            if not self._places:
                self._places = places(scope["app"])
            if len(self._known) >= KEPT:
                self._known.clear()
            found = self._known[key] = self._looked_up(*key)
        scope[LEADS] = found[2]
        return found[:2]

    def _looked_up(self, kind: str, method: str, path: str) -> tuple[Match, Access | None, bool]:
        partial, leads = None, False
        for place in self._places:
            match = place.match(kind, method, path)
            leads = leads or (match is not Match.NONE and place.named)
            if match is Match.FULL:
                return match, place.access, leads
            if match is Match.PARTIAL:
                partial = match
        other = path.rstrip("/") if path.endswith("/") else f"{path}/"  # to which the router redirects
        if partial or any(place.match(kind, method, other) is not Match.NONE for place in self._places):
            return Match.PARTIAL, UNKNOWN, leads
        return Match.NONE, UNKNOWN, leads

    async def _refusal(self, scope: Connection, access: Access | None) -> Response | None:
        if access is None:
            return problem(403, f"Nobody may use {scope['path']}: the program does not declare who may.")
        if access.who is Open.ANYONE:
            return None
        if access.who is Open.WORKER:
            return None if self._is_worker(Headers(scope=scope)) else problem(403, "This address needs the token of workers.")
        try:
            person = await person_of(scope, self.settings, access.remembered)
        except SQLAlchemyError:
            return _silent()
        if person is None:
            return _sign_in()
        scope[PERSON] = person
        ACTING.set(person)
        if person.role < access.who:
            needs, has = access.who.name.lower(), person.role.name.lower()
            needed = f"{scope['path']} needs the role {needs}; {person.name} has the role {has}."
            return problem(403, f"{needed} An administrator changes roles on the page Settings.")
        return None if person.may(access) else problem(403, _beyond(access))

    def _is_worker(self, headers: Headers) -> bool:
        return hmac.compare_digest(_bearer(headers).encode(), self.settings.worker_token.encode())


async def person_of(scope: Connection, settings: Settings, remembered: bool) -> SignedIn | None:
    """The person behind a request: of an API token where there is one, else of the cookie, else of this computer."""
    connection, state = HTTPConnection(scope), scope["app"].state
    if "authorization" in connection.headers:
        found: SignedIn | None = await state.credentials.person("token", _bearer(connection.headers), remembered)
        return found
    key = connection.cookies.get(cookie_name(settings))
    person: SignedIn | None = await state.credentials.person("session", key, remembered) if key else None
    return person or (LOCAL if settings.local_sign_in and _on_this_computer(scope) else None)


class Place:
    """Where a route lies and who may use it."""

    def __init__(self, context: Any):
        mounted = not context.endpoint
        self.access = declared(context.app if mounted else context.endpoint)
        self.kind = "" if mounted else "http" if context.methods else "websocket"  # a mount takes both
        self.methods = set(context.methods or ())
        self.path = f"{context.path.rstrip('/')}/{{path:path}}" if mounted else context.path
        self.pattern = compile_path(self.path)[0]
        self.named = not self.path.startswith("/{")  # and not the page that takes any address

    def match(self, kind: str, method: str, path: str) -> Match:
        if self.kind not in {"", kind} or not self.pattern.match(path):
            return Match.NONE
        return Match.FULL if not self.methods or method in self.methods else Match.PARTIAL


def places(app: Starlette) -> list[Place]:
    """Every route, websocket and mount of an application, in the order in which the application tries them."""
    return [Place(context) for context in iter_route_contexts(app.routes)]


def cookie_name(settings: Settings) -> str:
    """The name of the cookie of a session, which differs between ports: browsers send cookies to every port of a host."""
    return f"rths-session-{settings.port}"


def _on_this_computer(scope: Connection) -> bool:
    """Whether a request comes from this computer, and not through a proxy on it."""
    address, headers = (scope.get("client") or ("", 0))[0], Headers(scope=scope)
    return address in LOOPBACK and not any(name in headers for name in FORWARDED)


def _bearer(headers: Headers) -> str:
    kind, _, token = headers.get("authorization", "").partition(" ")
    return token if kind.lower() == "bearer" else ""


def _sign_in() -> Response:
    """The answer to a request without credentials, which pages/error_pages.py turns into the sign-in page for people."""
    answer = problem(401, SIGN_IN)
    answer.headers["WWW-Authenticate"] = "Bearer"
    return answer


def _beyond(access: Access) -> str:
    """Why an API token does not suffice."""
    if not access.scopes:
        return "An API token is not enough for this address: sign in in a browser."
    return f"The API token does not have the scope {' or '.join(sorted(access.scopes))}, which this address needs."


def _silent() -> Response:
    answer = problem(503, "The database did not answer, so that the sign-in could not be checked. Try again in a moment.")
    answer.headers["Retry-After"] = "5"
    return answer


async def _close(access: Access | None, receive: Receive, send: Send) -> None:
    """Refuse a websocket. A worker also gets the reason."""
    if access is not None and access.who is Open.WORKER:
        await receive()
        await send({"type": "websocket.accept"})
        await send({"type": "websocket.close", "code": NOT_ALLOWED, "reason": "wrong worker token"})
    else:
        await send({"type": "websocket.close", "code": NOT_ALLOWED, "reason": "sign in first"})
