"""A rig behind a server that speaks the protocol of OpenSees' `genericClient`: the engine is its client."""

from __future__ import annotations

import contextlib
import socket
import time as clock
from typing import ClassVar, Literal

from pydantic import Field

from rths_engine.parts.connections.connection import Adapter, External, Lost, Reading, Terms
from rths_engine.wire import generic
from rths_engine.wire.generic import Action, Numbers, Request, Sizes

# chosen; see docs/decisions/0023
OPENING_S = 5.0  # to connect and to read the rig at rest


TRANSPORTS = {"tcp": "TCP", "udp": "UDP"}


class GenericClient(External):
    """A server of the generic experimental element, with one degree of freedom: `rths rig`, OpenFresco, or a laboratory's own.

    The start sends zero displacement at time zero. Every controller step sends the trial displacement (3), asks for the
    displacement (7) and the force (10), and commits (5). The end repeats the last displacement with zero velocity, and says
    goodbye (99).
    """

    kind: Literal["generic_client"] = "generic_client"
    title: ClassVar[str] = "Generic TCP or UDP server"
    host: str = Field("127.0.0.1", title="Host", min_length=1, max_length=255, pattern=r"^[A-Za-z0-9._:-]+$")
    port: int = Field(8090, title="Port", ge=1, le=65_535)
    transport: Literal["tcp", "udp"] = Field("tcp", title="Transport", json_schema_extra={"titles": {**TRANSPORTS}})
    size: int = Field(
        generic.COMMON_SIZE,
        title="Numbers in a message",
        ge=generic.smallest_size(1),
        le=100_000,
        description="the server takes it from the first message",
    )

    @property
    def peer(self) -> str:
        return f"generic server {self.host}:{self.port} ({self.transport.upper()})"

    def adapter(self, terms: Terms) -> Adapter:
        return GenericRig(self, terms)


class GenericRig(Adapter):
    """The client's side of a connection with one degree of freedom."""

    def __init__(self, connection: GenericClient, terms: Terms):
        self.given, self.terms, self.scale = connection, terms, connection.scale
        self._socket: socket.socket | None = None
        self._longest, self._due = OPENING_S, 0.0  # time of an exchange (s), and its end by the monotonic clock
        self._last: tuple[float, float, float] | None = None  # displacement, velocity and time of the last command

    def open(self) -> Reading:
        given = self.given
        kind = socket.SOCK_STREAM if given.transport == "tcp" else socket.SOCK_DGRAM
        try:
            self._begin(OPENING_S)
            found = socket.getaddrinfo(given.host, given.port, type=kind)[0]
            self._socket = socket.socket(found[0], kind)
            self._socket.settimeout(OPENING_S)
            self._socket.connect(found[4])
            if kind == socket.SOCK_STREAM:
                self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            else:
                self._greet()
            read = Numbers(displacement=1, force=1)
            self._send(generic.pack_sizes(Sizes(Numbers(1, 1, 1, 0, 1), read, given.size)))
            self._ask(Action.DISPLACEMENT, Action.FORCE)
            return self.measure()
        except UnicodeError:
            fix = "give the name or the address of the computer on which the server of the rig runs"
            raise self.terms.refused("host", "cannot be the name of a computer", given.host, fix) from None
        except (OSError, Lost) as error:
            said = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
            fix = "start the server of the rig, and check host, port and transport"
            raise self.terms.refused("host", f"the {given.peer} does not answer: {said}", None, fix) from None

    def command(self, displacement: float, current: float, time: float) -> None:
        self._begin(self.given.patience)
        if self._last is None:
            self._trial(0.0, 0.0, 0.0, 0.0)  # a server begins to count time at the first message, as OpenSees sends it
        x = displacement / self.scale.displacement
        before, v_before, _ = self._last or (x, 0.0, 0.0)
        v = (x - before) / self.terms.dt
        self._last = x, v, time
        self._trial(x, v, (v - v_before) / self.terms.dt, time)
        self._ask(Action.DISPLACEMENT, Action.FORCE)

    def measure(self) -> Reading:
        x, f = (generic.unpack_values(self._receive(), 1)[0] for _ in range(2))
        if self._last is not None:
            self._ask(Action.COMMIT)
        return Reading(x * self.scale.displacement, f * self.scale.force)

    def close(self) -> None:
        if self._socket is None:
            return
        self._begin(self.given.patience)
        with contextlib.suppress(OSError, Lost):
            if self._last is not None:
                self._trial(self._last[0], 0.0, 0.0, self._last[2])
            self._ask(Action.END)
        self._socket.close()
        self._socket = None

    def _begin(self, longest: float) -> None:
        """Begin an exchange of at most `longest` (s): one end for all its messages, however many parts they come in."""
        self._longest, self._due = longest, clock.monotonic() + longest

    def _limit(self) -> socket.socket:
        """The socket, which waits until the end of the exchange at most; after it, it takes only what has come."""
        assert self._socket is not None
        self._socket.settimeout(max(0.0, self._due - clock.monotonic()))
        return self._socket

    def _greet(self) -> None:
        assert self._socket is not None
        self._socket.send(generic.HELLO)
        if self._socket.recv(16) != generic.WELCOME:
            raise Lost("it answered the greeting with other bytes")

    def _trial(self, x: float, v: float, a: float, time: float) -> None:
        self._send(generic.pack_request(Request(Action.SET_TRIAL, (x,), (v,), (a,), time), self.given.size))

    def _ask(self, *actions: Action) -> None:
        for action in actions:
            self._send(generic.pack_request(Request(action, (0.0,), (0.0,), (0.0,)), self.given.size))

    def _send(self, data: bytes) -> None:
        try:
            if self.given.transport == "tcp":
                self._limit().sendall(data)
            else:
                for part in generic.datagrams(data):
                    self._limit().send(part)
        except (TimeoutError, BlockingIOError):
            raise Lost("it took no command within the longest wait") from None
        except ConnectionError:
            raise Lost("it closed the connection") from None
        except OSError as error:
            raise Lost(f"the connection broke: {error.strerror or error}") from None

    def _receive(self) -> bytes:
        wanted, parts = 8 * self.given.size, b""
        try:
            while len(parts) < wanted:
                part = self._limit().recv(65_536 if self.given.transport == "udp" else wanted - len(parts))
                if not part:
                    raise Lost("it closed the connection")
                parts += part
        except (TimeoutError, BlockingIOError):
            raise Lost(f"it did not answer within {self._longest:g} s") from None
        except ConnectionError:
            raise Lost("it closed the connection") from None
        except OSError as error:
            raise Lost(f"the connection broke: {error.strerror or error}") from None
        return parts
