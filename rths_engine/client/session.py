"""A test with a client, from the first wait to the end: listen, exchange messages, and stop the rig safely."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, Protocol

from rths_engine.client.ended import Ended, Gone
from rths_engine.client.exchange import Exchange
from rths_engine.client.farewell import Farewell
from rths_engine.client.layout import Layout, agreed
from rths_engine.client.rig import Rig
from rths_engine.client.steps import StepTimes
from rths_engine.client.tcp import TcpListener
from rths_engine.client.transport import LOOK_S, Listener, Peer
from rths_engine.client.udp import UdpListener
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.running.client_run import ClientRun
from rths_engine.wire.generic import SETUP_BYTES

# chosen; see docs/decisions/0023
SHOWN_S = 0.02  # wall time between two calls of a watcher
LISTENERS: dict[str, Callable[[str, int], Listener]] = {"tcp": TcpListener, "udp": UdpListener}


class Watcher(Protocol):
    """Who shows a test with a client, and may stop it."""

    def waiting(self, address: str) -> None:
        """The rig listens at this address."""

    def connected(self, peer: str) -> None:
        """A client has connected from this address."""

    def shown(self) -> bool:
        """Show the test as it stands; returns whether to stop it."""


def listening(run: ClientRun, host: str) -> Listener:
    """Listen at the plan's port. Raises PlanError where this machine does not allow it."""
    client = run.plan.client
    try:
        return LISTENERS[client.transport](host, client.port)
    except OSError as error:
        fix = "choose another port; 0 takes any free port"
        raise PlanError(
            Issue("client.port", f"cannot be opened at {host}: {error.strerror or error}", client.port, fix)
        ) from None


class Session:
    """One test with a client. `serve` returns when it has ended; `run` then holds what was recorded, and how it ended."""

    def __init__(self, run: ClientRun, listener: Listener, watcher: Watcher):
        self.run, self.watcher = run, watcher
        self.address = f"{listener.host}:{listener.port}"
        self.times = StepTimes()
        self.exchange: Exchange | None = None
        self.rig = Rig(run, self._look)
        self.cancelled = False
        self.farewell: Farewell | None = None
        self._listener, self._peer, self._sentence = listener, "", ""
        self._looked = 0.0

    def serve(self) -> None:
        """Wait for the client and serve it to its end."""
        peer, found = None, None
        try:
            peer = self._waited()
            found = self._met(peer)
            self._exchanged(peer, found)
        except Gone:
            self._ended(Ended(self._vanished()))
        except Ended as ended:
            self._ended(ended)
            if peer is not None and found is not None and not ended.orderly:
                self.farewell, peer = Farewell(peer, found, self.run.plan.client.patience), None
        finally:
            if peer is not None:
                peer.close()
        self.run.client = self.told()

    def told(self, last: int = 0) -> dict[str, Any]:
        """What the recording tells of the client; of a running test, with the times of the `last` steps only."""
        exchange, rig = self.exchange, self.rig
        return {
            "address": self.address,
            "transport": self.run.plan.client.transport,
            "peer": self._peer,
            "steps": exchange.steps if exchange else 0,
            "messages": {str(code): count for code, count in sorted(exchange.counts.items())} if exchange else {},
            "step_ms": self.times.as_dict(last),
            "iterations": exchange.iterations if exchange else 0,
            "unfollowed_m": exchange.unfollowed if exchange else 0.0,
            "waits": rig.waits,
            "longest_wait_s": rig.longest_wait,
            "warnings": list(exchange.warnings.values()) if exchange else [],
            "ended": self.run.trip.sentence if self.run.trip else self._sentence,
        }

    def _waited(self) -> Peer:
        self.watcher.waiting(self.address)
        begun, longest = time.perf_counter(), self.run.plan.client.waiting
        try:
            while (peer := self._listener.accept(LOOK_S)) is None:
                self._look()
                if time.perf_counter() - begun > longest:
                    raise Ended(f"No client connected to {self.address} within {longest:g} s.", cause="waiting")
        except Ended:
            self._listener.close()
            raise
        self._peer = peer.address
        self.watcher.connected(peer.address)
        return peer

    def _met(self, peer: Peer) -> Layout:
        header = bytearray(SETUP_BYTES)
        self._received(peer, memoryview(header))
        peer.acknowledge()
        return agreed(bytes(header), len(self.run.plan.stations))

    def _exchanged(self, peer: Peer, found: Layout) -> None:
        self.exchange = exchange = Exchange(found, self.rig)
        message = memoryview(bytearray(found.bytes))
        unpack, take, clock = found.fields.unpack_from, exchange.take, time.perf_counter
        acknowledge, send = peer.acknowledge, peer.send
        steps = 0
        while True:
            if not peer.receive(message):
                self._received(peer, message)
            answer = take(unpack(message))
            if answer is not None:
                send(answer)
            else:
                acknowledge()
                if exchange.steps != steps:
                    steps = exchange.steps
                    self.times.ended()
            if clock() - self._looked > SHOWN_S:  # whatever the client sends, also without a commit
                self._look()

    def _received(self, peer: Peer, message: memoryview) -> None:
        """Wait for a whole message as long as the plan has patience."""
        begun, patience = time.perf_counter(), self.run.plan.client.patience
        while not peer.receive(message):
            self._look()
            if time.perf_counter() - begun > patience:
                raise Ended(_late(peer, message, patience))

    def _look(self) -> None:
        now = time.perf_counter()
        if now - self._looked < SHOWN_S:
            return
        stop = self.watcher.shown()
        self._looked = time.perf_counter()
        if stop:
            raise Ended("Stopped.", cause="cancelled")

    def _vanished(self) -> str:
        return "The client vanished: it closed the connection without its last message (99)."

    def _ended(self, ended: Ended) -> None:
        self._sentence = str(ended)
        self.cancelled = ended.cause == "cancelled"
        self.run.finished = True
        if not ended.orderly and not self.cancelled and self.run.trip is None:
            self.run.stop(ended.cause, str(ended))


def _late(peer: Peer, message: memoryview, patience: float) -> str:
    if peer.got:
        return f"The client sent only {peer.got} of the {len(message)} bytes of a message within {patience:g} s."
    return f"The client was silent for {patience:g} s. It may wait for a datagram that was lost, or have stopped."
