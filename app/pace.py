"""The pace of a body: one that trickles is ended, so that it holds no place; a slow line that really sends is not."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable

from starlette.exceptions import HTTPException
from starlette.types import Message, Receive

SILENT_S = 10.0
"""Without a byte for so long, the client is gone or plays for time."""
OVER_S, LEAST = 30.0, 1000.0
"""A body must bring LEAST bytes a second on average over each OVER_S of waiting: 1 GB takes 12 days at this pace."""


class TooSlow(HTTPException):
    """A body that comes too slowly; `detail` says how slowly."""

    def __init__(self, why: str):
        super().__init__(408, why, {"Connection": "close"})


def paced(receive: Receive, clock: Callable[[], float] = time.monotonic) -> Receive:
    """`receive` that raises TooSlow while a body trickles. Only time in which the service waits for the client counts."""
    waited, came, complete = 0.0, 0, False

    async def timed() -> Message:
        nonlocal waited, came, complete
        if complete:
            return await receive()
        begun = clock()
        try:
            async with asyncio.timeout(SILENT_S):
                message = await receive()
        except TimeoutError:
            raise TooSlow(f"No byte of the body came within {SILENT_S:g} s") from None
        waited, came = waited + clock() - begun, came + len(message.get("body", b""))
        complete = message["type"] != "http.request" or not message.get("more_body", False)
        if waited >= OVER_S and not complete:
            if came < LEAST * waited:
                raise TooSlow(f"The body came with less than {LEAST:g} bytes a second over {OVER_S:g} s")
            waited, came = 0.0, 0
        return message

    return timed
