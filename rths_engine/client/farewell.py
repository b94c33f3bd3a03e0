"""The farewell to a client whose test has ended on the rig's side.

OpenSees does not notice a closed connection: it waits for an answer forever, by TCP with a whole processor core. So the rig
goes on answering, with NaN, until the client leaves: an iterating analysis fails at once, and nobody takes the results of any
other for measurements.
"""

from __future__ import annotations

import math
import struct
import threading
import time

from rths_engine.client.ended import Ended, Gone
from rths_engine.client.layout import SHUTDOWN, Layout
from rths_engine.client.transport import Peer
from rths_engine.wire.generic import ANSWERED, Action


class Farewell:
    """Answers a client in a thread of its own until it leaves or is silent for `patience` (s)."""

    def __init__(self, peer: Peer, found: Layout, patience: float):
        self._peer, self._patience = peer, patience
        self._message = memoryview(bytearray(found.bytes))
        self._answer = struct.pack("<d", math.nan) * found.size
        self._code = struct.Struct("<d")
        self._thread = threading.Thread(target=self._serve, daemon=True, name="rths-farewell")
        self._thread.start()

    def wait(self, within_s: float) -> bool:
        """Wait until the client has left; returns whether it has."""
        self._thread.join(within_s)
        return not self._thread.is_alive()

    def _serve(self) -> None:
        heard = time.perf_counter()
        try:
            self._peer.send(self._answer)  # the client may be waiting for the answer to its last message
            while time.perf_counter() - heard < self._patience:
                if not self._peer.receive(self._message):
                    continue
                heard = time.perf_counter()
                code = self._code.unpack_from(self._message)[0]
                if code in (Action.END, SHUTDOWN):
                    return
                if code in ANSWERED:
                    self._peer.send(self._answer)
                else:
                    self._peer.acknowledge()
        except (Gone, Ended):
            return
        finally:
            self._peer.close()
