"""A rig for tests: a plan whose stations follow a client, and sessions with clients in threads or with OpenSees."""

from __future__ import annotations

import socket
import subprocess
import threading
from collections.abc import Callable, Sequence
from typing import Any

from rths_engine.client.session import Session, listening
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from rths_engine.planning.safety import Stop
from rths_engine.running.client_run import ClientRun
from rths_engine.wire.generic import Action, Numbers, Request, Sizes, datagrams, pack_request, pack_sizes, unpack_values

STIFFNESS, DAMPING = 1.0e6, 2.0e4  # of the specimen, N/m and N s/m
RATE = 1000.0  # Hz


def ended(session: Session) -> str:
    """The sentence of a session that stopped its test for another reason than a limit."""
    assert isinstance(session.run.trip, Stop)
    return session.run.trip.sentence


def station(name: str = "Spring", **changed: Any) -> dict[str, Any]:
    return {
        "name": name,
        "compensator": {"kind": "none"},
        "actuator": {"kind": "first_order_delay", "alpha": 1.0},
        "specimen": {"kind": "linear", "stiffness": STIFFNESS, "damping": DAMPING},
        "limits": {"displacement": 0.1, "velocity": 0.5, "force": 1e6},
        **changed,
    }


def led(stations: Sequence[dict[str, Any]] = (), client: dict[str, Any] | None = None, **changed: Any) -> Plan:
    """A plan whose stations follow a client, on any free port."""
    client = {"port": 0, "patience": 20.0, "waiting": 60.0, **(client or {})}
    plan = {"test": "client", "client": client, "controller_rate": RATE, "stations": [*stations] or [station()], **changed}
    return read_plan(plan)


class Watched:
    """A watcher that notes what it is shown, and stops the test where `until` says so."""

    def __init__(self, until: Callable[[], bool] = lambda: False):
        self.told: list[str] = []
        self.until = until

    def waiting(self, address: str) -> None:
        self.told.append(f"waiting {address}")

    def connected(self, peer: str) -> None:
        self.told.append(f"connected {peer}")

    def shown(self) -> bool:
        return self.until()


def served(plan: Plan, client: Callable[[Session], Any], until: Callable[[], bool] = lambda: False) -> Session:
    """The session of a plan after its end; `client` runs in a thread of its own, and its errors are raised here."""
    run = ClientRun(plan)
    session = Session(run, listening(run, "127.0.0.1"), Watched(until))
    errors: list[BaseException] = []

    def driven() -> None:
        try:
            client(session)
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=driven)
    thread.start()
    session.serve()
    thread.join(60)
    if errors:
        raise errors[0]
    return session


class Generic:
    """A client written for the tests from the sources of OpenSees and OpenFresco."""

    def __init__(self, session: Session, count: int = 1, size: int = 16, sizes: Sizes | None = None):
        host, _, port = session.address.rpartition(":")
        self.udp = session.run.plan.client.transport == "udp"
        kind = socket.SOCK_DGRAM if self.udp else socket.SOCK_STREAM
        self.socket = socket.socket(socket.AF_INET, kind)
        self.socket.settimeout(60)
        self.socket.connect((host, int(port)))
        self.sizes = sizes or Sizes(Numbers(count, count, count, 0, 1), Numbers(force=count), size)
        if self.udp:
            self.socket.send(b"a")
            assert self.socket.recv(16) == b"b"
        self.socket.send(pack_sizes(self.sizes))

    def say(self, action: int, displacement: Sequence[float] = (), time: float = 0.0) -> None:
        none = (0.0,) * self.sizes.sent.displacement
        sent = self.sizes.sent
        request = Request(action, tuple(displacement) or none, none[: sent.velocity], none[: sent.acceleration], time)
        data = pack_request(request, self.sizes.size)
        for part in datagrams(data) if self.udp else [data]:
            self.socket.send(part)

    def all(self, *messages: tuple[int, Sequence[float], float]) -> None:
        for action, displacement, time in messages:
            self.say(action, displacement, time)

    def ask(self, action: int, count: int) -> tuple[float, ...]:
        self.say(action)
        data = b""
        while len(data) < 8 * self.sizes.size:
            part = self.socket.recv(8 * self.sizes.size - len(data))
            assert part, "the rig closed the connection"
            data += part
        return unpack_values(data, count)

    def step(self, displacement: float, time: float) -> float:
        """One step of a client that moves the first degree of freedom and commits; returns the measured force."""
        self.say(Action.SET_TRIAL, (displacement,), time)
        force = self.ask(Action.FORCE, 1)[0]
        self.say(Action.COMMIT)
        return force

    def end(self) -> None:
        self.say(Action.END)
        self.socket.close()


def opensees(session: Session, python: str, script: str) -> subprocess.CompletedProcess[str]:
    """Run a script of OpenSees that gets the port of the rig as its argument."""
    port = session.address.rpartition(":")[2]
    return subprocess.run([python, "-c", script, port], capture_output=True, text=True, timeout=120)
