"""The base class of a controller that commands the current of a specimen."""

from __future__ import annotations

from rths_engine.foundation.part import Part


class Commanding(Part):
    """A controller that commands the current of a specimen: its current range (A), and the current that a plan expects.

    `range` are the smallest and the largest commanded current. `mean` is the current at which the specimen is linearised.
    """

    @property
    def range(self) -> tuple[float, float]:
        raise NotImplementedError

    @property
    def mean(self) -> float:
        return sum(self.range) / 2
