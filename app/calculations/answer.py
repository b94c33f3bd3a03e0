"""Calculations of a request: as its response, awaited by a coroutine, or called in the thread of an endpoint."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, ParamSpec, TypeVar

import anyio.from_thread
from fastapi import Depends, Request
from pydantic_core import to_json
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from app.access import PERSON, SignedIn
from app.calculations.bound import Bound
from app.calculations.calculations import Calculations, ClientLeft

P = ParamSpec("P")
T = TypeVar("T")
JSON = "application/json"


@dataclass(frozen=True, slots=True)
class Made:
    """A file that a calculation made, as the body of a response."""

    content: bytes
    media_type: str
    headers: Mapping[str, str] = field(default_factory=dict)


class Calculated(Response):
    """A response that a calculation makes: the `Made` that it returns, or its result as JSON. The session has ended by then."""

    def __init__(self, bound: Bound, function: Callable[P, Any], /, *arguments: P.args, **named: P.kwargs):
        super().__init__()
        self.bound, self.function = bound, functools.partial(function, *arguments, **named)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            made = await _of(scope, receive, self.bound, made_by, self.function)
        except ClientLeft:
            return
        headers = {**made.headers, **{name.decode(): text.decode() for name, text in self.raw_headers if name == b"set-cookie"}}
        await Response(made.content, self.status_code, headers, made.media_type, self.background)(scope, receive, send)


class Calculator:
    """Calculations in the thread of an endpoint, which waits for them."""

    def __init__(self, request: Request):
        self.request = request

    def __call__(self, bound: Bound, function: Callable[P, T], /, *arguments: P.args, **named: P.kwargs) -> T:
        call = functools.partial(of_request, self.request, bound, function, *arguments, **named)
        return anyio.from_thread.run(call)


async def of_request(request: Request, bound: Bound, function: Callable[P, T], /, *arguments: P.args, **named: P.kwargs) -> T:
    """The result of a calculation for the client of a request; see Calculations.do."""
    return await _of(request.scope, request.receive, bound, function, *arguments, **named)


def made_by(function: Callable[[], Any]) -> Made:
    """The result of a calculation as a body, made in its process."""
    found = function()
    return found if isinstance(found, Made) else Made(to_json(found, inf_nan_mode="null"), JSON)


def calculator(request: Request) -> Calculator:
    """The calculations of a request."""
    return Calculator(request)


Calculating = Annotated[Calculator, Depends(calculator)]


async def _of(
    scope: Scope, receive: Receive, bound: Bound, function: Callable[P, T], /, *arguments: P.args, **named: P.kwargs
) -> T:
    async def left() -> None:
        while (await receive())["type"] != "http.disconnect":
            pass

    calculations: Calculations = scope["app"].state.calculations
    return await calculations.do(client_of(scope), left, bound, function, *arguments, **named)


def client_of(scope: Scope) -> str:
    """Whose share of the places a request takes: that of its account, or of its address where there are no accounts."""
    person: SignedIn | None = scope.get(PERSON)
    if person is not None and person.how != "local":
        return f"account {person.name}"
    address = scope.get("client")
    return address[0] if address else ""
