"""A rig server that speaks the generic protocol, for tests: a spring and a dashpot in a thread, and its ways to fail."""

from __future__ import annotations

import math
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from rths_engine.wire import generic
from rths_engine.wire.generic import Action


class Server:
    """The server of one client. `ends` maps the number of a trial displacement to what the server then does."""

    def __init__(
        self, stiffness: float, damping: float = 0.0, udp: bool = False, ends: dict[int, str] | None = None, at: float = 0.0
    ):
        self.stiffness, self.damping, self.udp, self.ends = stiffness, damping, udp, ends or {}
        self.asked: list[int] = []
        self.trials: list[generic.Request] = []
        self.at = at
        self._listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM if udp else socket.SOCK_STREAM)
        self._listener.bind(("127.0.0.1", 0))
        self.port: int = self._listener.getsockname()[1]
        if not udp:
            self._listener.listen(1)
        self._listener.settimeout(300)  # the engine may compile first
        self.thread = threading.Thread(target=self._serve, daemon=True)
        self.thread.start()

    def _serve(self) -> None:
        try:
            if self.udp:
                hello, peer = self._listener.recvfrom(16)
                assert hello == generic.HELLO
                self._listener.connect(peer)
                self._listener.send(generic.WELCOME)
                line = self._listener
            else:
                line, _ = self._listener.accept()
                line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                line.settimeout(20)
            with line:
                self._answer(line)
        except OSError:
            pass
        finally:
            self._listener.close()

    def _answer(self, line: socket.socket) -> None:
        sizes = generic.unpack_sizes(self._read(line, generic.SETUP_BYTES))
        x, v = self.at, 0.0
        while True:
            request = generic.unpack_request(self._read(line, 8 * sizes.size), sizes.sent)
            self.asked.append(request.action)
            if request.action == Action.END:
                return
            if request.action == Action.SET_TRIAL:
                self.trials.append(request)
                x, v = request.displacement[0], request.velocity[0]
                if self.ends.get(len(self.trials)) == "vanish":
                    return
            silent = self.ends.get(len(self.trials)) == "silent"
            force = math.nan if self.ends.get(len(self.trials)) == "nan" else self.stiffness * x + self.damping * v
            if request.action in generic.ANSWERED and not silent:
                answer = generic.pack_values((x if request.action == Action.DISPLACEMENT else force,), sizes.size)
                if self.ends.get(len(self.trials)) == "trickle":
                    self._trickle(line, answer)
                else:
                    line.send(answer)

    def _trickle(self, line: socket.socket, answer: bytes) -> None:
        """Send single bytes until the client leaves."""
        for k in range(len(answer)):
            line.send(answer[k : k + 1])
            time.sleep(0.01)

    def _read(self, line: socket.socket, count: int) -> bytes:
        data = b""
        while len(data) < count:
            part = line.recv(65_536 if self.udp else count - len(data))
            if not part:
                raise OSError("closed")
            data += part
        return data


@contextmanager
def serving(
    stiffness: float, damping: float = 0.0, udp: bool = False, ends: dict[int, str] | None = None, at: float = 0.0
) -> Iterator[Server]:
    """A rig server in units of the rig, until the end of the block."""
    server = Server(stiffness, damping, udp, ends or {}, at)
    yield server
    server.thread.join(20)
    assert not server.thread.is_alive(), "the client left without a goodbye"
