"""Who calculates next: a bounded number at a time, the waiting clients in turn. Used on the event loop only."""

from __future__ import annotations

import asyncio
from collections import Counter, deque
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from app.metrics import REFUSED
from app.problems import Unavailable

MOST_WAITING = 64
MOST_OF_ONE = 12  # waiting calculations of one client
WAIT_S = 60.0


class Turns:
    """Places for calculations. A client that holds fewer places comes first; none holds all of them.

    The queue is bounded for each client and as a whole, so that one client's requests never fill it.
    """

    def __init__(self, places: int):
        self.places = places
        self.running: Counter[str] = Counter()
        self.waiting: dict[str, deque[asyncio.Future[None]]] = {}

    @asynccontextmanager
    async def turn(self, client: str) -> AsyncIterator[None]:
        """Wait for a place and hold it. Raises Unavailable where the queue is full or no place becomes free in time."""
        try:
            await self._taken(client)
        except Unavailable:
            REFUSED.labels("calculations").inc()
            raise
        try:
            yield
        finally:
            self._leave(client)

    async def _taken(self, client: str) -> None:
        line = self.waiting.get(client, ())
        if len(line) >= MOST_OF_ONE:
            raise Unavailable(
                f"This client has {MOST_OF_ONE} calculations that wait, which is the limit. "
                "Wait for an answer before the next request."
            )
        if sum(map(len, self.waiting.values())) >= MOST_WAITING:
            raise Unavailable(f"{MOST_WAITING} calculations wait, which is the limit. Try again in a moment.")
        mine: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self.waiting.setdefault(client, deque()).append(mine)
        self._next()
        try:
            async with asyncio.timeout(WAIT_S):
                await asyncio.shield(mine)
        except BaseException as error:
            if mine.done():
                self._leave(client)
            else:
                self._forget(client, mine)
            if isinstance(error, TimeoutError):
                raise Unavailable(f"Other calculations took more than {WAIT_S:g} s. Try again in a moment.") from None
            raise

    def _leave(self, client: str) -> None:
        self.running[client] -= 1
        if not self.running[client]:
            del self.running[client]
        self._next()

    def _forget(self, client: str, mine: asyncio.Future[None]) -> None:
        self.waiting[client].remove(mine)
        if not self.waiting[client]:
            del self.waiting[client]

    def _next(self) -> None:
        """Give free places to the clients that hold the fewest, and among these to the one that was served longest ago."""
        most = max(1, self.places - 1)
        while self.running.total() < self.places:
            allowed = [client for client in self.waiting if self.running[client] < most]
            if not allowed:
                return
            client = min(allowed, key=lambda one: self.running[one])  # the first of equals: the order of `waiting` is a circle
            line = self.waiting.pop(client)
            mine = line.popleft()
            if line:
                self.waiting[client] = line  # behind the others
            self.running[client] += 1
            mine.set_result(None)
