"""The result of a run: its signals and their measures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rths_engine.foundation.arrays import Array
from rths_engine.parts.ground_motions import Motion
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.safety import Trip
from rths_engine.results import measured
from rths_engine.results.channels import Channel
from rths_engine.results.signals import RunSignals
from rths_engine.results.timing import Timing


@dataclass(frozen=True, slots=True)
class Result:
    """Signals (substeps, channels) every `dt` (s) and history (steps + 1, 2, floors) of x and v at integration steps; SI.

    `total` is the number of substeps of the whole test, recorded or not. `client` tells of the client of a test that has one,
    and `timing` of the deadlines of a test in real time.
    """

    model: Model
    motion: Motion
    status: str
    trip: Trip | None
    elapsed_s: float
    dt: float
    total: int
    channels: tuple[Channel, ...]
    signals: Array
    history: Array
    client: dict[str, Any] | None = None
    timing: Timing | None = None

    @property
    def plan(self) -> Plan:
        return self.model.plan

    @property
    def simulated_s(self) -> float:
        return len(self.signals) * self.dt

    def signal(self, key: str) -> Array:
        """The column named `key` (`x_cmd.1`), SI."""
        column: Array = self.signals[:, [channel.key for channel in self.channels].index(key)]
        return column

    def summary(self) -> dict[str, Any]:
        """JSON form: how the run ended, and its measures in shown units."""
        whole = RunSignals(self.model, self.dt, self.channels, self.signals, self.history[0, 0])
        return {
            "status": self.status,
            "trip": self.trip.as_dict() if self.trip else None,
            "elapsed_s": self.elapsed_s,
            "simulated_s": self.simulated_s,
            **measured.of_run(whole),
            **({"client": self.client} if self.client else {}),
            **({"timing": self.timing.summary()} if self.timing else {}),
        }
