"""A run whose stations follow a client: the only owner of state that changes. Its length is not known before its end."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import motion
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.safety import LIMITS, Stop, Trip
from rths_engine.results.channels import Channel, channels
from rths_engine.results.result import Result
from rths_engine.running.data import F_MEAS, X_MEAS, Record
from rths_engine.running.follow import follow
from rths_engine.running.setup import left_out, setup

# chosen; see docs/decisions/0023
FIRST_ROWS = 1 << 16  # rows that are held from the start; full arrays double


class ClientRun:
    """One execution of a plan with a client. `signals[:done]` are the recorded samples in SI, with columns as in `channels`.

    `total` is the largest number of controller steps. `ramp` begins a motion and `advance` executes a part of it.
    """

    def __init__(self, planned: Plan | Model):
        self.model = model = Model.of(planned)
        self.plan = plan = model.plan
        self.motion = motion.scaled(plan.motion, MotionLibrary(None), model.periods)
        self.dt = plan.substep
        self.total = max(1, round(plan.length(0.0) / self.dt))
        self.trip: Trip | None = None
        self.client: dict[str, Any] | None = None
        self.done = 0
        self.finished = False
        self.channels: tuple[Channel, ...] = channels(model)
        stations = len(plan.stations)
        rows = min(self.total, FIRST_ROWS)
        self.signals: Array = np.zeros((rows, len(self.channels)))
        self.history: Array = np.zeros((1, 2, 0))
        self._random = np.random.Generator(np.random.PCG64(plan.seed))
        still = np.zeros((1, stations))
        self._setup, self._state = setup(model, np.zeros((1, 0)), still, self._noise(rows))
        self._left_out = left_out(model, self._setup.kept)
        self._record = Record(self.signals, self.history, np.zeros(4))
        self._ends: Array = np.zeros((stations, 2))
        self._start = self._ramped = self._length = 0
        self.x_meas: Array = self._state.memory[:, X_MEAS]
        self.f_meas: Array = self._state.memory[:, F_MEAS]

    def ramp(self, target: Sequence[float], steps: int) -> None:
        """Begin a ramp of the stations' commands from where they are to `target` (m) within `steps` controller steps."""
        self._ends[:, 0] = self._ends[:, 1]
        self._ends[:, 1] = target
        self._start, self._ramped, self._length = self.done, 0, steps
        if self.done + steps > len(self.signals):
            self._grow(self.done + steps)

    def advance(self, steps: int) -> None:
        """Execute up to `steps` controller steps of the ramp. A limit that is exceeded ends the run in its controller step."""
        last = min(self._length, self._ramped + steps)
        broken, self.done = follow(
            self._ramped, last, self._length, self._start, self._ends, self._setup, self._state, self._left_out, self._record
        )
        self._ramped = last
        if broken:
            self.trip, self.finished = self._tripped(broken - 1), True

    @property
    def moving(self) -> bool:
        """Whether a part of the ramp is left."""
        return self._ramped < self._length and not self.finished

    @property
    def empty(self) -> bool:
        """Whether nothing was recorded: no controller step, nor a limit that tripped in the first one."""
        return self.done == 0 and (self.trip is None or isinstance(self.trip, Stop))

    def stop(self, cause: str, reason: str) -> None:
        """End the run for a reason other than a limit."""
        if self.trip is None:
            self.trip = Stop.at(self.done, self.dt, cause, reason)
        self.finished = True

    def result(self, status: str, elapsed_s: float) -> Result:
        """The result: recorded signals and their measures. `status` is completed, tripped or cancelled."""
        return Result(
            model=self.model,
            motion=self.motion,
            status=status,
            trip=self.trip,
            elapsed_s=elapsed_s,
            dt=self.dt,
            total=self.done,
            channels=self.channels,
            signals=self.signals[: self.done],
            history=self.history,
            client=self.client,
        )

    def _noise(self, rows: int) -> Array:
        """The next rows of sensor noise (rows, stations, 2): in parts, the same numbers as in one piece."""
        scale = np.array([(station.noise.displacement, station.noise.force) for station in self.plan.stations])
        if not scale.any():
            return np.zeros((rows, len(scale), 2))
        noise: Array = self._random.standard_normal((rows, len(scale), 2)) * scale
        return noise

    def _grow(self, needed: int) -> None:
        rows = min(self.total, max(needed, 2 * len(self.signals)))
        more = rows - len(self.signals)
        self.signals = np.concatenate([self.signals, np.zeros((more, len(self.channels)))])
        self._setup = self._setup._replace(noise=np.concatenate([self._setup.noise, self._noise(more)]))
        self._record = self._record._replace(signals=self.signals)

    def _tripped(self, limit: int) -> Trip:
        found = self._record.trip
        station, substep = int(found[0]), int(found[3])
        kind = list(LIMITS)[limit]
        name = self.plan.stations[station].name
        return Trip(station + 1, name, kind, float(found[1]), float(found[2]), LIMITS[kind][1], substep * self.dt, substep)
