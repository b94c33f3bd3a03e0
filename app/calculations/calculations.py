"""Calculations of the service: a turn, a process, and an answer within bounds. Used on the event loop."""

from __future__ import annotations

import asyncio
import os
import pickle
from collections.abc import Awaitable, Callable
from typing import Any, ParamSpec, TypeVar

from app.calculations.bound import Bound
from app.calculations.orders import order
from app.calculations.processes import Died, Processes, shared
from app.calculations.turns import Turns
from app.calculations.wire import Said
from app.problems import Unavailable
from rths_engine.foundation.errors import Issue, RthsError

P = ParamSpec("P")
T = TypeVar("T")
Reply = tuple[Said, bytes]


class ClientLeft(Unavailable):
    """The client did not wait for the answer."""


class Calculations:
    """The calculations of an application. Short ones and long ones have places of their own."""

    def __init__(self, processes: Processes | None = None):
        self.processes = processes or shared()
        cores = os.cpu_count() or 1
        self.short, self.long = Turns(max(3, cores)), Turns(max(2, cores // 2))

    async def do(
        self,
        client: str,
        left: Callable[[], Awaitable[object]],
        bound: Bound,
        function: Callable[P, T],
        /,
        *arguments: P.args,
        **named: P.kwargs,
    ) -> T:
        """The result of `function(*arguments)` in a process of its own, for a client; `left()` returns when it has left.

        Raises what the function raises, RthsError beyond a bound, Unavailable without a place or an answer, and ClientLeft.
        """
        found: T = result(bound, await self.reply(client, left, bound, order(bound, function, arguments, named)))
        return found

    async def reply(self, client: str, left: Callable[[], Awaitable[object]], bound: Bound, ordered: bytes) -> Reply:
        """The reply of a process to an order, for `result`. Raises as `do`, except what the function raises."""
        work = asyncio.ensure_future(self._done(client, bound, ordered))
        gone = asyncio.ensure_future(left())
        try:
            await asyncio.wait({work, gone}, return_when=asyncio.FIRST_COMPLETED)
            if not work.done():
                raise ClientLeft("The client has left.")
        finally:
            for task in (work, gone):
                task.cancel()
            await asyncio.gather(work, gone, return_exceptions=True)
        return work.result()

    async def _done(self, client: str, bound: Bound, ordered: bytes) -> Reply:
        turns = self.long if bound.long else self.short
        async with turns.turn(client):
            try:
                async with asyncio.timeout(bound.patience_s):
                    return await self.processes.ask(ordered)
            except TimeoutError:
                late = f"The {bound.noun} did not answer within {bound.patience_s:g} s. The machine is busy: try again later."
                raise Unavailable(late) from None
            except Died as died:
                raise _exceeded(bound, died) from None


def result(bound: Bound, reply: Reply) -> Any:
    """What a process replied: the result of its function. Raises what the function raised."""
    kind, body = reply
    found = pickle.loads(body)
    if kind == Said.RAISED:
        raise _exceeded(bound) if isinstance(found, MemoryError) else found
    return found


def _exceeded(bound: Bound, died: Died | None = None) -> Exception:
    """The error of a calculation that met a bound, or whose process died of something else."""
    if died is not None and died.out_of_time:
        limit = f"{bound.seconds} s of processor time"
    elif died is None or died.out_of_memory:
        limit = f"{bound.megabytes} MB of memory"
    else:
        return Unavailable(f"The process of the {bound.noun} ended unexpectedly. Try again in a moment.")
    return RthsError(Issue(bound.where, f"the {bound.noun} needs more than the limit of {limit}", None, bound.mend))
