"""Calculations: a process each, bounds of time and memory, turns, and an end when the client leaves."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Awaitable, Callable, Coroutine
from pathlib import Path
from typing import Any

import pytest

from app.calculations import turns
from app.calculations.bound import Bound
from app.calculations.calculations import Calculations, ClientLeft
from app.calculations.processes import shared
from app.problems import Unavailable
from rths_engine.foundation.errors import RthsError
from tests.app import calculated
from tests.coroutines import finished

BOUND = Bound("trial", seconds=60, megabytes=500, mend="use less", where="plan")
SHORT = Bound("trial", seconds=1, megabytes=50, mend="use less")


async def stays() -> None:
    """A client that waits for its answer."""
    await asyncio.Event().wait()


async def until(condition: Callable[[], bool]) -> None:
    async with asyncio.timeout(60):
        while not condition():
            await asyncio.sleep(0.01)


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def started(task: Path) -> int:
    return int(task.read_text() or 0) if task.exists() else 0


def of(
    calculations: Calculations, function: Callable[..., Any], *arguments: Any, client: str = "one"
) -> Coroutine[Any, Any, Any]:
    return calculations.do(client, stays, BOUND, function, *arguments)


def test_each_calculation_has_a_process_of_its_own_and_raises_what_it_raises() -> None:
    async def run() -> None:
        calculations = Calculations()
        processes = await asyncio.gather(*(of(calculations, calculated.process) for _ in range(3)))
        assert len({os.getpid(), *processes}) == 4
        with pytest.raises(RthsError) as refused:
            await of(calculations, calculated.refused)
        assert refused.value.issues[0].fix == "give a name"
        with pytest.raises(Unavailable, match="ended unexpectedly"):
            await of(calculations, calculated.dies)

    finished(run())


def test_time_and_memory_are_bounded_and_the_error_names_the_bound() -> None:
    async def run() -> None:
        calculations = Calculations()
        with pytest.raises(RthsError, match="more than the limit of 1 s of processor time"):
            await calculations.do("one", stays, SHORT, calculated.works_on)
        with pytest.raises(RthsError, match="more than the limit of 50 MB of memory") as exceeded:
            await calculations.do("one", stays, SHORT, calculated.takes, 200)
        assert exceeded.value.issues[0].fix == "use less"
        assert await calculations.do("one", stays, BOUND, calculated.takes, 200) == 200_000_000

    finished(run())


def test_a_calculation_ends_when_its_client_leaves(tmp_path: Path) -> None:
    async def run() -> None:
        calculations, left = Calculations(), asyncio.Event()
        work = asyncio.ensure_future(calculations.do("one", left.wait, BOUND, calculated.waits, tmp_path / "it", tmp_path))
        await until(lambda: started(tmp_path / "it") > 0)
        left.set()
        with pytest.raises(ClientLeft):
            await work
        await until(lambda: not alive(started(tmp_path / "it")))
        assert not calculations.short.running

    finished(run())


def test_one_client_leaves_a_place_for_others_and_has_a_bounded_queue(tmp_path: Path) -> None:
    async def run() -> None:
        calculations = Calculations()
        calculations.short = turns.Turns(2)
        busy = [
            asyncio.ensure_future(of(calculations, calculated.waits, tmp_path / str(k), tmp_path))
            for k in range(1 + turns.MOST_OF_ONE)
        ]
        await until(lambda: started(tmp_path / "0") > 0)
        with pytest.raises(Unavailable, match="This client has 12 calculations that wait"):
            await of(calculations, calculated.process)
        assert await of(calculations, calculated.process, client="two") > 0
        assert calculations.short.running.total() == 1
        (tmp_path / "go").touch()
        assert await asyncio.gather(*busy) == [str(k) for k in range(len(busy))]
        assert not calculations.short.waiting and not calculations.short.running

    finished(run())


def test_a_calculation_that_waits_is_forgotten_when_its_client_leaves() -> None:
    async def run() -> None:
        one = turns.Turns(1)
        async with one.turn("first"):
            waiting = asyncio.ensure_future(entered(one, "second"))
            await until(lambda: "second" in one.waiting)
            waiting.cancel()
            await asyncio.gather(waiting, return_exceptions=True)
            assert not one.waiting
        assert not one.running

    async def entered(one: turns.Turns, client: str) -> None:
        async with one.turn(client):
            pass

    finished(run())


def test_clients_take_turns() -> None:
    async def run() -> list[str]:
        one, order = turns.Turns(1), []

        async def enter(client: str) -> None:
            async with one.turn(client):
                order.append(client)

        async with one.turn("c"):
            waiting: list[Awaitable[None]] = []
            for client in ("a", "a", "a", "b"):
                waiting.append(asyncio.ensure_future(enter(client)))
                await asyncio.sleep(0)
        await asyncio.gather(*waiting)
        return order

    assert finished(run()) == ["a", "b", "a", "a"]


def test_a_server_of_processes_that_died_is_started_again() -> None:
    async def run() -> None:
        calculations = Calculations()
        await of(calculations, calculated.process)
        server = shared()._server
        assert server is not None
        server.kill()
        server.wait()
        assert await of(calculations, calculated.process) > 0

    finished(run())
