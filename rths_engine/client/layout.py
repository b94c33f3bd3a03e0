"""The layout of a client's messages, from its setup message: what it sends and reads, and whether this rig can serve it."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from rths_engine.client.ended import Ended
from rths_engine.wire.generic import Numbers, Sizes, unpack_sizes

NUMBER = 8  # bytes, by definition of float64
SHUTDOWN = 98  # by definition of OF_RemoteTest_shutdown, OpenFresco's FrescoGlobals.h
# chosen; see docs/decisions/0023
LARGEST = 1 << 20  # numbers in a message
KINDS = ("displacements", "velocities", "accelerations", "forces")


@dataclass(frozen=True, slots=True)
class Layout:
    """The layout of the messages of one client: counts of the numbers that it sends and reads, and numbers in a message."""

    sent: Numbers
    read: Numbers
    size: int

    @property
    def count(self) -> int:
        """Number of basic degrees of freedom."""
        return self.sent.displacement

    @property
    def time(self) -> int | None:
        """Position of the time in a message; None for a client that sends none."""
        return 1 + sum(self.sent[:4]) if self.sent.time else None

    @property
    def fields(self) -> struct.Struct:
        """The used numbers of a message of the client: action, displacements, velocities, accelerations, forces, times."""
        return struct.Struct(f"<{1 + sum(self.sent)}d")

    @property
    def bytes(self) -> int:
        """Bytes of a message."""
        return self.size * NUMBER


def agreed(header: bytes, stations: int) -> Layout:
    """The layout in a setup message. Raises Ended where the rig, which has this number of stations, cannot serve the client."""
    sizes = unpack_sizes(header)
    if not _plausible(sizes):
        if _plausible(unpack_sizes(_turned(header))):
            raise Ended("The client sends big-endian numbers; the rig reads little-endian. Run the client on another machine.")
        listed = ", ".join(str(one) for one in (*sizes.sent, *sizes.read, sizes.size))
        raise Ended(f"The first message of the client is not a setup message of this protocol: it reads as {listed}.")
    found = Layout(*sizes)
    if found.count == 0:
        raise Ended("The client sends no displacements. The rig follows displacements: switch on their control mode.")
    if found.count != stations:
        has = f"{found.count} basic degree{'' if found.count == 1 else 's'} of freedom"
        plan = f"{stations} station{'' if stations == 1 else 's'}"
        fix = "Give one station for each degree of freedom, in their order."
        raise Ended(f"The client has {has}, but the plan has {plan}. {fix}")
    for numbers, verb in ((found.sent, "sends"), (found.read, "reads")):
        for kind, count in zip(KINDS, numbers[:4], strict=True):
            if count not in (0, found.count):
                raise Ended(f"The client {verb} {count} {kind} for {found.count} degrees of freedom. Both must be equal.")
    needed = max(1 + sum(found.sent), sum(found.read), found.count**2)
    if found.size < needed:
        raise Ended(f"The messages of the client have {found.size} numbers; its layout needs {needed}. Raise its data size.")
    return found


def _plausible(sizes: Sizes) -> bool:
    return all(0 <= one <= LARGEST for one in (*sizes.sent, *sizes.read)) and 0 < sizes.size <= LARGEST


def _turned(header: bytes) -> bytes:
    return b"".join(header[first : first + 4][::-1] for first in range(0, len(header), 4))
