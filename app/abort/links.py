"""The workers that are connected: the service sends them the latch at once, and they answer what they do. Event loop only."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from typing import Any

from app.latch import Latch

Send = Callable[[str], Awaitable[None]]
SLOW_S = 5.0  # to take a message; then the worker counts as not connected


class WorkerLink:
    """The connection to one worker: its name, the presses that it has acknowledged, and the tests that its engines execute."""

    def __init__(self, send: Send, close: Callable[[], Awaitable[None]]):
        self.send, self.close = send, close
        self.name = ""
        self.acknowledged: frozenset[str] = frozenset()
        self.stopping: list[str] = []
        self._waits = asyncio.Event()
        self._waits.set()

    def push(self) -> None:
        """Tell the worker the latch as soon as the connection takes it."""
        self._waits.set()

    async def keep_told(self, latch: Latch) -> None:
        """Tell the worker the latch at first and after each push, until the connection ends."""
        while True:
            await self._waits.wait()
            self._waits.clear()
            try:
                async with asyncio.timeout(SLOW_S):
                    await self.send(json.dumps({"latch": latch.as_dict()}))
            except TimeoutError:
                return await self.close()


class WorkerLinks:
    """All connections to workers. `heard` is called after each message of a worker."""

    def __init__(self, latch: Latch):
        self.latch = latch
        self.connected: list[WorkerLink] = []
        self.heard: Callable[[], None] = lambda: None

    def push(self) -> None:
        """Tell every worker the latch."""
        for link in self.connected:
            link.push()

    async def keep(self, link: WorkerLink) -> None:
        """Keep a worker told while it is connected."""
        self.connected.append(link)
        try:
            await link.keep_told(self.latch)
        finally:
            self.connected.remove(link)
            self.heard()

    def take(self, link: WorkerLink, told: dict[str, Any]) -> None:
        """Take what a worker says of itself: its name, its latch, and the tests that its engines execute."""
        link.name = str(told["worker"])
        link.stopping = [str(one) for one in told["stopping"]]
        link.acknowledged = frozenset(str(one) for one in told["acknowledged"])
        self.latch.take(told["latch"])
        self.heard()
