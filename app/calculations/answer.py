"""Calculations of a request: as its response, awaited by a coroutine, or called in the thread of an endpoint."""

from __future__ import annotations

import functools
import os
import tempfile
import uuid
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Concatenate, ParamSpec, TypeVar

import anyio.from_thread
from fastapi import Depends, Request
from pydantic_core import to_json
from starlette.responses import FileResponse, Response
from starlette.types import Receive, Scope, Send

from app.access import PERSON, SignedIn
from app.calculations.bound import Bound
from app.calculations.calculations import Calculations, ClientLeft, Reply, result
from app.calculations.orders import Here, order

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
        self.bound, self.ordered = bound, order(bound, made_by, (functools.partial(function, *arguments, **named),), {})

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            made: Made = result(self.bound, await _reply(scope, receive, self.bound, self.ordered))
        except ClientLeft:
            return
        headers = {**made.headers, **{name.decode(): text.decode() for name, text in self.raw_headers if name == b"set-cookie"}}
        await Response(made.content, self.status_code, headers, made.media_type, self.background)(scope, receive, send)


class MadeFile(FileResponse):
    """A file that was made for this request: its time and a tag of it would say nothing to the next one."""

    def set_stat_headers(self, stat_result: os.stat_result) -> None:
        self.headers.setdefault("content-length", str(stat_result.st_size))


class CalculatedFile(Response):
    """A download that a calculation writes: `write(path, ...)` in its process. The file is removed when it was sent."""

    def __init__(
        self,
        bound: Bound,
        name: str,
        media_type: str,
        write: Callable[Concatenate[Path, P], None],
        /,
        *arguments: P.args,
        **named: P.kwargs,
    ):
        super().__init__()
        self.bound, self.name, self.kind = bound, name, media_type
        self.path = Path(tempfile.gettempdir()) / f"download-{uuid.uuid4()}"
        self.ordered = order(bound, write, (self.path, *arguments), named)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            result(self.bound, await _reply(scope, receive, self.bound, self.ordered))
            await MadeFile(self.path, media_type=self.kind, filename=self.name)(scope, receive, send)
        except ClientLeft:
            return
        finally:
            self.path.unlink(missing_ok=True)


class Calculator:
    """Calculations in the thread of an endpoint, which waits for them."""

    def __init__(self, request: Request):
        self.request = request

    def __reduce__(self) -> tuple[type[Here], tuple[()]]:
        return Here, ()

    def __call__(self, bound: Bound, function: Callable[P, T], /, *arguments: P.args, **named: P.kwargs) -> T:
        ordered = order(bound, function, arguments, named)
        found: T = result(bound, anyio.from_thread.run(_reply, self.request.scope, self.request.receive, bound, ordered))
        return found


HERE = Here()
Calculate = Calculator | Here


def made_by(function: Callable[[], Any]) -> Made:
    """The result of a calculation as a body, made in its process."""
    found = function()
    return found if isinstance(found, Made) else Made(to_json(found, inf_nan_mode="null"), JSON)


def calculator(request: Request) -> Calculator:
    """The calculations of a request."""
    return Calculator(request)


Calculating = Annotated[Calculator, Depends(calculator)]


async def _reply(scope: Scope, receive: Receive, bound: Bound, ordered: bytes) -> Reply:
    async def left() -> None:
        while (await receive())["type"] != "http.disconnect":
            pass

    calculations: Calculations = scope["app"].state.calculations
    return await calculations.reply(client_of(scope), left, bound, ordered)


def client_of(scope: Scope) -> str:
    """Whose share of the places a request takes: that of its account, or of its address where there are no accounts."""
    person: SignedIn | None = scope.get(PERSON)
    if person is not None and person.how != "local":
        return f"account {person.name}"
    address = scope.get("client")
    return address[0] if address else ""
