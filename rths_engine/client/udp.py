"""UDP: every message in datagrams of at most 9126 bytes, after a handshake of one byte each way."""

from __future__ import annotations

import socket

from rths_engine.client.ended import Ended, Gone
from rths_engine.client.transport import limit_waits, untaken
from rths_engine.wire.generic import DATAGRAM, HELLO, WELCOME


class UdpPeer:
    """A client by UDP. The socket takes datagrams of this client only. A lost datagram is noticed as silence."""

    def __init__(self, connection: socket.socket, address: tuple[str, int]):
        self._connection, self.got = connection, 0
        self.address = f"{address[0]}:{address[1]}"
        connection.connect(address)
        limit_waits(connection)
        connection.send(WELCOME)

    def receive(self, message: memoryview) -> bool:
        size = len(message)
        try:
            got = self._connection.recv_into(message[self.got :] if self.got else message)
        except BlockingIOError:
            return False
        except OSError:
            raise Gone from None
        expected = min(DATAGRAM, size - self.got)
        if got != expected:
            raise Ended(f"The client sent {got} bytes in place of {expected}. Its data size is not that of its setup message.")
        self.got += got
        if self.got < size:
            return False
        self.got = 0
        return True

    def acknowledge(self) -> None:
        """UDP has no acknowledgements."""

    def send(self, message: bytes | bytearray | memoryview) -> None:
        try:
            if len(message) <= DATAGRAM:
                self._connection.send(message)
                return
            whole = memoryview(message)
            for first in range(0, len(whole), DATAGRAM):
                self._connection.send(whole[first : first + DATAGRAM])
        except BlockingIOError:
            raise untaken() from None
        except OSError:
            raise Gone from None

    def close(self) -> None:
        self._connection.close()


class UdpListener:
    """A UDP port. Datagrams before the handshake are ignored."""

    def __init__(self, host: str, port: int):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.bind((host, port))
        except OSError:
            self._socket.close()
            raise
        self.host, self.port = self._socket.getsockname()[:2]

    def accept(self, within_s: float) -> UdpPeer | None:
        self._socket.settimeout(within_s)
        try:
            said, address = self._socket.recvfrom(16)
        except TimeoutError:
            return None
        return UdpPeer(self._socket, address) if said == HELLO else None

    def close(self) -> None:
        self._socket.close()
