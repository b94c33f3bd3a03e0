"""Messages between the service, the server of processes and a calculation: a kind, a length and a body."""

from __future__ import annotations

import struct
from enum import IntEnum

HEAD = struct.Struct("<BQ")  # kind of the message, bytes of its body


class Said(IntEnum):
    """Kinds of messages."""

    ORDER = 1  # to a calculation: what to execute
    ANSWER = 2  # its result
    RAISED = 3  # the error that it raised
    ENDED = 4  # by the server: the wait status of the process


def message(kind: Said, body: bytes) -> bytes:
    """A message as bytes."""
    return HEAD.pack(kind, len(body)) + body
