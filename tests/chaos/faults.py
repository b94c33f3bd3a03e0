"""The faults of a chaos run. Each is a function of the world and of its drawn numbers, and leaves the world whole again."""

from __future__ import annotations

import os
import random
import signal
import sqlite3
import time
from collections.abc import Callable
from contextlib import suppress

from tests.chaos.world import NAMES, World, ended, killed

Fault = Callable[[World, random.Random], None]


def kill_worker(world: World, draw: random.Random) -> None:
    name = draw.choice(NAMES)
    killed(world.workers[name])
    time.sleep(draw.uniform(0, 1))
    world.start_worker(name)


def kill_worker_without_heartbeat(world: World, draw: random.Random) -> None:
    """As a worker dies that has taken a test and has not told yet that it lives: no heartbeat is left."""
    name = draw.choice(NAMES)
    killed(world.workers[name])
    _forget(world, name)
    world.start_worker(name)


def kill_worker_at_its_start(world: World, draw: random.Random) -> None:
    name = draw.choice(NAMES)
    killed(world.workers[name])
    world.start_worker(name)
    time.sleep(draw.uniform(0, 6))
    killed(world.workers[name])
    world.start_worker(name)


def kill_engine(world: World, draw: random.Random) -> None:
    engines = world.engines(draw.choice(NAMES))
    if engines:
        with suppress(ProcessLookupError):
            os.kill(draw.choice(engines), signal.SIGKILL)


def freeze_worker(world: World, draw: random.Random) -> None:
    """A worker that does nothing for longer than others wait for its heartbeat, and then goes on."""
    process = world.workers[draw.choice(NAMES)]
    with suppress(ProcessLookupError):
        process.send_signal(signal.SIGSTOP)
        time.sleep(draw.uniform(2, 12))
        process.send_signal(signal.SIGCONT)


def kill_web(world: World, draw: random.Random) -> None:
    killed(world.web)
    time.sleep(draw.uniform(0, 2))
    world.start_web()


def kill_all(world: World, draw: random.Random) -> None:
    """As a machine loses its power."""
    for process in (world.web, *world.workers.values()):
        killed(process)
    if world.database is not None:
        world.database.kill()
        world.database.start()
    world.start_web()
    for name in draw.sample(NAMES, len(NAMES)):
        world.start_worker(name)


def kill_database(world: World, draw: random.Random) -> None:
    """The server of PostgreSQL dies for a while; with SQLite another program holds the lock of its file."""
    if world.database is not None:
        world.database.kill()
        time.sleep(draw.uniform(0, 5))
        world.database.start()
        return
    other = sqlite3.connect(world.data / "rths.sqlite", timeout=30, isolation_level=None)
    with suppress(sqlite3.OperationalError):
        other.execute("begin immediate")
        time.sleep(draw.uniform(0, 8))
    other.close()


def fill_disk(world: World, draw: random.Random) -> None:
    if not world.small_disk:
        return
    filler = world.fill()
    time.sleep(draw.uniform(1, 6))
    filler.unlink()


def jump_clock(world: World, draw: random.Random) -> None:
    """The clocks of one process, or of all, jump by hours, and stay there."""
    if world.clock_library is None:
        return
    hours = draw.choice([-5.0, -1.0, -0.01, 0.01, 1.0, 5.0])
    for name in draw.choice([*([name] for name in world.clocks), list(world.clocks)]):
        world.clocks[name].turn(hours)


def cut_network(world: World, draw: random.Random) -> None:
    """The network of one worker is cut, to the web service and to the database server."""
    silently = draw.random() < 0.5
    proxies = world.networks[draw.choice(NAMES)]
    for proxy in proxies:
        proxy.cut(silently)
    time.sleep(draw.uniform(1, 15))
    for proxy in proxies:
        proxy.mend()


FAULTS: tuple[Fault, ...] = (
    kill_worker,
    kill_worker_without_heartbeat,
    kill_worker_at_its_start,
    kill_engine,
    freeze_worker,
    kill_web,
    kill_all,
    kill_database,
    fill_disk,
    jump_clock,
    cut_network,
)


def revive(world: World) -> int:
    """Start what has ended by itself, as systemd does; returns how many processes that were."""
    found = 0
    if ended(world.web):
        found += 1
        world.start_web()
    for name, process in world.workers.items():
        if ended(process):
            found += 1
            world.start_worker(name)
    return found


def _forget(world: World, name: str) -> None:
    import sqlalchemy as sa

    from app.db import connect

    url = world.database.url if world.database is not None else f"sqlite:///{world.data / 'rths.sqlite'}"
    engine = connect(url)
    with suppress(sa.exc.SQLAlchemyError), engine.begin() as connection:
        connection.execute(sa.text("delete from worker_heartbeat where worker like :name"), {"name": f"{name}-%"})
    engine.dispose()
