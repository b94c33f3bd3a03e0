"""Abort in the web service: the latch, the workers, the record, and what is known of all three."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Iterable

from app.abort.links import WorkerLinks
from app.abort.recorder import Recorder
from app.abort.schemas import AbortOut, WorkerOut
from app.latch import Latch, Press

ANSWER_S = 0.1
"""How long an answer waits for the acknowledgements and the record; without them it says what is missing."""


class Desk:
    """Abort in the web service. Its coroutines use no thread and no connection of the database."""

    def __init__(self, url: str):
        self.latch = Latch()
        self.links = WorkerLinks(self.latch)
        self.recorder = Recorder(url, self.latch)
        self._loop: asyncio.AbstractEventLoop | None = None
        self._changed = asyncio.Event()

    def start(self) -> None:
        """Serve from now on. Called on the event loop."""
        self._loop = asyncio.get_running_loop()
        self.links.heard = self._tell
        self.recorder.stored = lambda: self._soon(self._tell)
        self.latch.listen(self._latched)
        self.recorder.start()

    def stop(self) -> None:
        """End the thread of the record."""
        self.latch.forget(self._latched)
        self.recorder.stop()

    async def press(self, by: str) -> AbortOut:
        """Set the latch at once, and answer what is known after ANSWER_S at most."""
        press = self.latch.press(by)
        until = time.monotonic() + ANSWER_S
        while not self._complete(press) and (left := until - time.monotonic()) > 0:
            changed = self._changed
            try:
                async with asyncio.timeout(left):
                    await changed.wait()
            except TimeoutError:
                break
        return self.state()

    def state(self) -> AbortOut:
        """What is known now."""
        presses, links = self.latch.presses, self.links.connected
        ids = {one.id for one in presses}
        workers = [
            WorkerOut(name=one.name, acknowledged=ids <= one.acknowledged, stopping=one.stopping if ids else [])
            for one in sorted(links, key=lambda one: one.name)
        ]
        running = _each(one for worker in workers for one in worker.stopping)
        recorded = all(one.id in self.recorder.recorded for one in presses)
        asked = [run for one in presses for run in self.recorder.recorded.get(one.id, [])]
        acknowledged = bool(workers) and all(one.acknowledged for one in workers)
        return AbortOut(
            held=bool(presses),
            by=presses[0].by or None if presses else None,
            at=presses[0].time if presses else None,
            stopping=_each([*asked, *running]),
            running=running,
            workers=workers,
            acknowledged=bool(presses) and acknowledged,
            recorded=bool(presses) and recorded,
            sentence=_sentence(workers, running, recorded) if presses else "Abort is not pressed.",
        )

    def _complete(self, press: Press) -> bool:
        told = all(press.id in one.acknowledged for one in self.links.connected)
        return told and press.id in self.recorder.recorded

    def _latched(self) -> None:
        self._soon(self.links.push)

    def _soon(self, action: object) -> None:
        """Do something on the event loop; called by any thread."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(action)  # type: ignore[arg-type]

    def _tell(self) -> None:
        self._changed.set()
        self._changed = asyncio.Event()


def _sentence(workers: list[WorkerOut], running: list[str], recorded: bool) -> str:
    """What a person needs to know first: whether something may still move."""
    silent = [one.name for one in workers if not one.acknowledged]
    if not workers:
        said = "No worker is connected."
    elif silent:
        said = f"Not acknowledged yet by {', '.join(silent)}."
    elif running:
        said = f"Acknowledged by every connected worker. {_tests(len(running))} still stopping."
    else:
        said = "Acknowledged by every connected worker. No test of these workers runs."
    if recorded:
        return f"{said} The queue is held."
    return f"{said} This service holds the queue, but the database has not stored the hold yet."


def _tests(count: int) -> str:
    return "1 test is" if count == 1 else f"{count} tests are"


def _each(ids: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(ids))
