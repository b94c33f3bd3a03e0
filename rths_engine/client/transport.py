"""What TCP and UDP have in common: a listener waits for one client, and a peer exchanges messages with it."""

from __future__ import annotations

import socket
import struct
from typing import Protocol

# chosen; see docs/decisions/0023
LOOK_S = 0.1  # longest time within `receive` without a message
SENDING_S = 5.0  # longest time within `send`


class Peer(Protocol):
    """The connection to one client."""

    address: str

    def receive(self, message: memoryview) -> bool:
        """Fill `message`, and return True; False where it is not complete after LOOK_S. Raises Gone or Ended."""

    def acknowledge(self) -> None:
        """Acknowledge a message that gets no answer; an answer acknowledges its message itself."""

    def send(self, message: bytes | bytearray | memoryview) -> None:
        """Send a message. Raises Gone."""

    def close(self) -> None:
        """Close the connection."""


class Listener(Protocol):
    """A port on which the rig waits for one client."""

    host: str
    port: int

    def accept(self, within_s: float) -> Peer | None:
        """The first client that connects; None where none connects within this time."""

    def close(self) -> None:
        """Stop listening."""


def limit_waits(connection: socket.socket) -> None:
    """Bound the time within each system call. The kernel does so itself, which saves a call to `poll` for each message."""
    connection.settimeout(None)
    for option, seconds in ((socket.SO_RCVTIMEO, LOOK_S), (socket.SO_SNDTIMEO, SENDING_S)):
        connection.setsockopt(socket.SOL_SOCKET, option, struct.pack("ll", int(seconds), int(seconds % 1 * 1e6)))
