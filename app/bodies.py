"""Bodies of requests: bounded in size and shape before anything reads them."""

from __future__ import annotations

import re

from starlette.concurrency import run_in_threadpool
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.config import Settings, is_form
from app.pace import TooSlow, paced
from app.problems import problem, too_large, too_slow

# Chosen: 500 plans of 100 storeys have 65 000 objects and lists, 260 000 texts, and 12 levels; an object has 60 keys at most.
DEEPEST, MOST_CONTAINERS, MOST_TEXTS, MOST_DIGITS, MOST_KEYS = 40, 100_000, 400_000, 400, 2000
BRIEF = 65_536  # bytes: checked at once; longer bodies are checked beside the other requests

_TEXT = re.compile(rb'"(?:[^"\\]++|\\.)*+"?', re.DOTALL)
_SHAPE = re.compile(rb"[\[\]{}:]")
_DIGITS = re.compile(rb"[0-9]{%d}" % (MOST_DIGITS + 1))


class Bodies:
    """ASGI middleware that reads the body of a request without files up to its limit, and refuses JSON that is out of shape.

    A body that trickles gets 408: app/pace.py.

    Forms with files pass: the framework writes them to disk and counts their bytes.
    """

    def __init__(self, app: ASGIApp, settings: Settings):
        self.app, self.limit = app, settings.body_limit

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or scope["method"] in {"GET", "HEAD"}:
            await self.app(scope, receive, send)
            return
        kind = Headers(scope=scope).get("content-type", "")
        receive = paced(receive)
        if is_form(kind):
            await self.app(scope, receive, send)
            return
        limit = self.limit(scope["path"], kind)
        try:
            body = await _read(receive, limit)
        except TooSlow as slow:
            await too_slow(slow.detail)(scope, receive, send)
            return
        if body is None:
            await too_large(limit)(scope, receive, send)
            return
        fault = await _checked(body) if "json" in kind else None
        await (problem(400, f"{fault}.") if fault else self.app)(scope, _again(body, receive), send)


def fault_of(body: bytes) -> str | None:
    """Why JSON is out of shape, from a glance at its texts, brackets and digits; None where it can be read."""
    if b"\0" in body:
        return "The body is not JSON in UTF-8: it has a NUL character"
    bare, texts = _TEXT.subn(b"s", body)
    if texts > MOST_TEXTS:
        return f"The body has {texts} keys and texts; the limit is {MOST_TEXTS}"
    containers = bare.count(b"[") + bare.count(b"{")
    if containers > MOST_CONTAINERS:
        return f"The body has {containers} objects and lists; the limit is {MOST_CONTAINERS}"
    keys = [0]  # of each object or list that is open
    for sign in _SHAPE.findall(bare):
        if sign == b":":
            keys[-1] += 1
            if keys[-1] > MOST_KEYS:
                return f"The body has an object with too many keys; the limit is {MOST_KEYS}"
        elif sign in b"[{":
            keys.append(0)
            if len(keys) > DEEPEST + 1:
                return f"The body is nested too deeply; the limit is {DEEPEST} levels"
        elif len(keys) > 1:
            keys.pop()
    if _DIGITS.search(bare):
        return f"The body has a number with too many digits; the limit is {MOST_DIGITS} digits"
    return None


async def _checked(body: bytes) -> str | None:
    return fault_of(body) if len(body) <= BRIEF else await run_in_threadpool(fault_of, body)


async def _read(receive: Receive, limit: int) -> bytes | None:
    """The whole body; None where it is longer than `limit`. The body of a client that left ends where it left."""
    parts, size = [], 0
    while True:
        message = await receive()
        if message["type"] != "http.request":
            break
        parts.append(message.get("body", b""))
        size += len(parts[-1])
        if size > limit:
            return None
        if not message.get("more_body", False):
            break
    return b"".join(parts)


def _again(body: bytes, receive: Receive) -> Receive:
    """`receive` that gives the body once more, and then what follows."""
    given = False

    async def again() -> Message:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": body, "more_body": False}

    return again
