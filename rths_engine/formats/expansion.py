"""Bounds of what a packed file expands to, by the sizes that it declares, before anything of it is unpacked."""

from __future__ import annotations

from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
ALWAYS = 32_000_000  # bytes that any file may expand to
MOST_RATIO = 300  # unpacked over packed size beyond that
MOST_NODES = 100_000  # datasets and groups, however often a link names them


class Expansion:
    """Counts what a file of `packed` bytes expands to while it is walked."""

    def __init__(self, packed: int):
        self.most = max(ALWAYS, MOST_RATIO * packed)
        self.bytes = self.nodes = 0

    def add(self, declared: int) -> None:
        """Count an array before it is read. Raises FileError beyond the bounds."""
        self.bytes += declared
        if self.bytes > self.most:
            problem = f"expands to more than {self.most / 1e6:.0f} MB; measurements are never packed so much"
            raise FileError(Issue("file", problem, fix="write the file again without compression, or export it as CSV"))

    def node(self) -> None:
        """Count a group or dataset. Raises FileError for too many, such as those of links that lead round in a circle."""
        self.nodes += 1
        if self.nodes > MOST_NODES:
            problem = f"has more than {MOST_NODES} groups and arrays, counted by their links"
            raise FileError(Issue("file", problem, fix="export fewer signals, or export it as CSV"))
