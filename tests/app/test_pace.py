"""A body that trickles is ended; a slow line that really sends is not."""

from __future__ import annotations

import asyncio

import pytest
from starlette.types import Message

from app import pace
from app.pace import TooSlow, paced
from tests.coroutines import finished


class Line:
    """A client that sends parts of a body, `size` bytes every `every` seconds of a clock of its own."""

    def __init__(self, size: int, every: float):
        self.now, self.size, self.every, self.left = 0.0, size, every, 1000

    async def receive(self) -> Message:
        self.now += self.every
        self.left -= 1
        return {"type": "http.request", "body": bytes(self.size), "more_body": self.left > 0}


async def taken(line: Line) -> int:
    receive, size = paced(line.receive, lambda: line.now), 0
    while True:
        message = await receive()
        size += len(message["body"])
        if not message["more_body"]:
            return size


def test_a_body_that_comes_in_single_bytes_is_ended() -> None:
    line = Line(1, 1.0)
    with pytest.raises(TooSlow, match="less than 1000 bytes a second over 30 s"):
        finished(taken(line))
    assert line.now == pytest.approx(pace.OVER_S)


def test_a_slow_line_that_really_sends_is_not_ended() -> None:
    assert finished(taken(Line(9000, 8.0))) == 9_000_000


def test_a_body_that_stops_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pace, "SILENT_S", 0.01)

    async def silent() -> Message:
        await asyncio.Event().wait()
        raise AssertionError

    async def run() -> Message:
        return await paced(silent)()

    with pytest.raises(TooSlow, match="No byte"):
        finished(run())


def test_a_client_may_wait_for_its_answer_as_long_as_it_likes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pace, "SILENT_S", 0.01)
    parts: list[Message] = [{"type": "http.request", "body": b"{}", "more_body": False}]

    async def then_stays() -> Message:
        if parts:
            return parts.pop()
        await asyncio.sleep(0.05)
        return {"type": "http.disconnect"}

    async def run() -> str:
        receive = paced(then_stays)
        await receive()
        return str((await receive())["type"])

    assert finished(run()) == "http.disconnect"
