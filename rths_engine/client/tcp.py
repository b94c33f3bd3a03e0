"""TCP: a stream of messages without framing."""

from __future__ import annotations

import socket

from rths_engine.client.ended import Gone
from rths_engine.client.transport import limit_waits, untaken

# Linux: acknowledge at once
_QUICK = getattr(socket, "TCP_QUICKACK", None)


class TcpPeer:
    """A client by TCP."""

    def __init__(self, connection: socket.socket, address: tuple[str, int]):
        self._connection, self.got = connection, 0
        self.address = f"{address[0]}:{address[1]}"
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        limit_waits(connection)

    def receive(self, message: memoryview) -> bool:
        size = len(message)
        try:
            got = self._connection.recv_into(message[self.got :] if self.got else message)
        except BlockingIOError:
            return False
        except OSError:
            raise Gone from None
        if got == 0:
            raise Gone
        self.got += got
        if self.got < size:
            self.acknowledge()
            return False
        self.got = 0
        return True

    def acknowledge(self) -> None:
        """OpenSees waits for the acknowledgement of one message before it sends the next (Nagle). Linux delays it by 40 ms."""
        if _QUICK is not None:
            self._connection.setsockopt(socket.IPPROTO_TCP, _QUICK, 1)

    def send(self, message: bytes | bytearray | memoryview) -> None:
        try:
            self._connection.sendall(message)
        except BlockingIOError:
            raise untaken() from None
        except OSError:
            raise Gone from None

    def close(self) -> None:
        self._connection.close()


class TcpListener:
    """A TCP port. It is closed when a client connects, so that a second client is refused at once."""

    def __init__(self, host: str, port: int):
        self._socket = socket.create_server((host, port), backlog=1)
        self.host, self.port = self._socket.getsockname()[:2]

    def accept(self, within_s: float) -> TcpPeer | None:
        self._socket.settimeout(within_s)
        try:
            connection, address = self._socket.accept()
        except TimeoutError:
            return None
        self.close()
        return TcpPeer(connection, address)

    def close(self) -> None:
        self._socket.close()
