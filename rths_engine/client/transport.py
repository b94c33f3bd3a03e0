"""What TCP and UDP have in common: a listener waits for one client, and a peer exchanges messages with it."""

from __future__ import annotations

import socket
import struct
from typing import Protocol

from rths_engine.client.ended import Ended

# chosen; see docs/decisions/0023
LOOK_S = 0.1  # longest time within `receive` without a message
SENDING_S = 1.0  # longest time within `send`


class Peer(Protocol):
    """The connection to one client."""

    address: str
    got: int
    """Bytes of a message that is not complete yet."""

    def receive(self, message: memoryview) -> bool:
        """Fill `message`, and return True; False where it is not complete yet, LOOK_S later or after a part of it.

        The next call goes on from there. Raises Gone or Ended.
        """

    def acknowledge(self) -> None:
        """Acknowledge a message that gets no answer; an answer acknowledges its message itself."""

    def send(self, message: bytes | bytearray | memoryview) -> None:
        """Send a message. Raises Gone, or Ended where the client takes nothing for SENDING_S."""

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


def untaken() -> Ended:
    """The end of a test whose client takes no answers."""
    return Ended(f"The client took no answer for {SENDING_S:g} s. It may send requests without reading the answers.")


def limit_waits(connection: socket.socket) -> None:
    """Bound the time within each system call. The kernel does so itself, which saves a call to `poll` for each message."""
    connection.settimeout(None)
    for option, seconds in ((socket.SO_RCVTIMEO, LOOK_S), (socket.SO_SNDTIMEO, SENDING_S)):
        connection.setsockopt(socket.SOL_SOCKET, option, struct.pack("ll", int(seconds), int(seconds % 1 * 1e6)))
