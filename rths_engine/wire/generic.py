"""The protocol of the generic experimental element: OpenSees' `genericClient` and OpenFresco's generic TCP controller.

A client, which computes the structure, drives a server, which holds the rig. There is no frame, version or checksum.

    setup    client -> server   11 int32: numbers of the displacements, velocities, accelerations, forces and times that the
                                client sends and then of those that it reads, and the number of float64 of every later message
    request  client -> server   float64: action, displacements, velocities, accelerations, time, zeros
    reply    server -> client   float64: the values, zeros; only after an action in ANSWERED

On UDP the client first sends HELLO and the server answers WELCOME; a message longer than DATAGRAM is cut. All numbers are
little endian: the protocol is that of the machines that speak it, and these are.
Source: OpenSees 3.7.1, SRC/element/generic/GenericClient.cpp and SRC/actor/channel; seen on the wire with openseespy 3.7.1.2.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from enum import IntEnum
from typing import NamedTuple

HELLO, WELCOME = b"a", b"b"
DATAGRAM = 9126  # bytes, by definition of MAX_UDP_DATAGRAM in OpenSees
COMMON_SIZE = 256  # float64 of a message where the input of OpenSees gives no size, by definition of its default
_SIZES = struct.Struct("<11i")
SETUP_BYTES = _SIZES.size


class Action(IntEnum):
    """What a request asks for."""

    OPEN = 1
    SETUP = 2
    SET_TRIAL = 3
    EXECUTE = 4
    COMMIT = 5
    DATA = 6
    DISPLACEMENT = 7
    VELOCITY = 8
    ACCELERATION = 9
    FORCE = 10
    TIME = 11
    INITIAL_STIFFNESS = 12
    TANGENT_STIFFNESS = 13
    DAMPING = 14
    MASS = 15
    END = 99


ANSWERED = frozenset(range(Action.DATA, Action.MASS + 1))  # actions that get a reply, by their codes


class Numbers(NamedTuple):
    """How many values of each quantity a program sends or reads."""

    displacement: int = 0
    velocity: int = 0
    acceleration: int = 0
    force: int = 0
    time: int = 0


class Sizes(NamedTuple):
    """The setup message: what the client sends and reads, and `size`, the float64 of every later message."""

    sent: Numbers
    read: Numbers
    size: int


class Request(NamedTuple):
    """One request of a client. A code that is not an `Action` stays a number."""

    action: int
    displacement: Sequence[float] = ()
    velocity: Sequence[float] = ()
    acceleration: Sequence[float] = ()
    time: float = 0.0


def smallest_size(degrees: int) -> int:
    """The float64 of the shortest message that holds the action, three vectors of `degrees` values and the time."""
    return 1 + 3 * degrees + 1


def pack_sizes(sizes: Sizes) -> bytes:
    """The bytes of a setup message."""
    return _SIZES.pack(*sizes.sent, *sizes.read, sizes.size)


def unpack_sizes(data: bytes) -> Sizes:
    """The setup message in SETUP_BYTES bytes."""
    found = _SIZES.unpack(data)
    return Sizes(Numbers(*found[:5]), Numbers(*found[5:10]), found[10])


def pack_request(request: Request, size: int) -> bytes:
    """The bytes of a request, filled with zeros to `size` float64."""
    action, displacement, velocity, acceleration, time = request
    return pack_values((float(action), *displacement, *velocity, *acceleration, time), size)


def unpack_request(data: bytes | bytearray, sent: Numbers) -> Request:
    """The request in the bytes of a message of a client that sends `sent`. The code of a value that is no number is -1."""
    found = struct.unpack_from(f"<{1 + sum(sent[:3]) + min(sent.time, 1)}d", data)
    first, second, third = (sum(sent[:end]) + 1 for end in (1, 2, 3))
    action = int(found[0] + 0.5) if abs(found[0]) < 1e6 else -1
    time = found[third] if sent.time else 0.0
    return Request(action, found[1:first], found[first:second], found[second:third], time)


def pack_values(values: Sequence[float], size: int) -> bytes:
    """The bytes of a message of values, filled with zeros to `size` float64. This is the form of a reply."""
    return struct.pack(f"<{len(values)}d{8 * (size - len(values))}x", *values)


def unpack_values(data: bytes | bytearray, count: int) -> tuple[float, ...]:
    """The first `count` values of a message."""
    return struct.unpack_from(f"<{count}d", data)


def datagrams(data: bytes) -> list[bytes]:
    """A message in the datagrams that carry it on UDP."""
    return [data[first : first + DATAGRAM] for first in range(0, len(data), DATAGRAM)]
