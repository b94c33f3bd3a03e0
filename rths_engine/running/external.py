"""A run with external rigs: in every controller step the commands go to the rigs, and their readings come back.

Real time is kept for each controller step. A step that starts late shifts the clock of all later steps: commands are never sent
faster than the rate of the plan, because a rig would follow them with a higher velocity.
"""

from __future__ import annotations

import math
import sys
import time
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.parts.connections.connection import Adapter, External, Lost, Reading, Terms
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.connections import external
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan, RealTime
from rths_engine.planning.safety import Stop
from rths_engine.running import external_step
from rths_engine.running.external_step import ACTUATOR, ALL, CURRENT, NOTHING, SENT, SPECIMEN
from rths_engine.running.pacing import DONE, STOP, Pacing
from rths_engine.running.run import Run
from rths_engine.running.setup import effects_in
from rths_engine.running.step_clock import StepClock

LOST = "rig"  # cause of a stop
# chosen; see docs/decisions/0023
LOOK_S = 0.02  # wall time after which the caller can look whether the test was cancelled
SWITCH_S = 0.0002  # longest wait for the interpreter lock while another thread shows the test


class ExternalRun(Run):
    """One execution of a plan with external stations, as a context: the rigs are connected inside it.

    Every way out of the context closes every adapter, which is its safe end. A rig that is lost ends the run with what was
    recorded. `folder` holds the service's files for connections; None: their paths are taken as they are.
    """

    models_only = False

    def __init__(self, planned: Plan | Model, motions: MotionLibrary, folder: Path | None = None):
        super().__init__(planned, motions)
        self._effects = effects_in(self.model, self._setup.kept)  # one form of the loop for all plans: it is compiled once
        self._connections = external(self.plan)
        self._adapters: dict[int, Adapter] = {}
        self._terms = {j: self._terms_of(j, folder) for j in self._connections}
        self._roles = np.full(len(self.plan.stations), NOTHING, dtype=np.int64)
        for j, connection in self._connections.items():
            self._roles[j] = _role(connection)
        pace = self.plan.pace
        self.clock = StepClock(self.dt / pace.factor if isinstance(pace, RealTime) else 0.0)
        self._work = external_step.work(len(self._state.x), len(self.plan.stations))

    def __enter__(self) -> ExternalRun:
        self.rehearse()
        try:
            for j, connection in self._connections.items():
                self._adapters[j] = connection.adapter(self._terms[j])
                self._check_start(j, self._adapters[j].open())
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def rehearse(self) -> None:
        """Compile the loop, or load it, without a rig."""
        external_step.rehearse(self._setup, self._state, self._effects, self._work, self._record)

    def close(self) -> None:
        """The safe end of all rigs."""
        for adapter in self._adapters.values():
            adapter.close()
        self._adapters = {}

    def _terms_of(self, j: int, folder: Path | None) -> Terms:
        limits = self.plan.stations[j].limits
        return Terms(f"stations.{j}.connection", self.dt, limits.displacement, limits.force, folder)

    def _check_start(self, j: int, reading: Reading) -> None:
        """Refuse a rig whose readings are not finite, that stands away from zero, or whose force is beyond its limit."""
        connection, terms = self._connections[j], self._terms[j]
        if (problem := _not_finite(reading)) is not None:
            raise terms.refused("", f"the {connection.peer} {problem} at rest", None, "check its sensors")
        x, f = reading.displacement or 0.0, reading.force or 0.0
        if abs(x) > connection.start_within:
            problem = f"is {connection.start_within * 1e3:g} mm, but the {connection.peer} stands at {x * 1e3:.4g} mm"
            fix = "move the rig to zero first: the test starts there"
            raise terms.refused("start_within", problem, connection.start_within, fix)
        if abs(f) > terms.force_limit:
            problem = (
                f"the {connection.peer} measures {f / 1e3:.4g} kN at rest, beyond the limit of {terms.force_limit / 1e3:g} kN"
            )
            raise terms.refused("", problem, None, "unload the rig, or check the unit of the force")

    def run_paced(self, pacing: Pacing) -> None:
        """Run the whole test at its pace. Another thread takes the rows and times of its steps (`paced.PacedRun`)."""
        self.clock = StepClock(pacing.period / 1e9, pacing.delays, pacing.lengths)
        interval = sys.getswitchinterval()
        sys.setswitchinterval(SWITCH_S)
        try:
            broken, done = self._stepped(0, self._steps, pacing.control, math.inf)
        finally:
            sys.setswitchinterval(interval)
        pacing.control[DONE] = done
        self._step = self._steps
        if broken:
            self.trip = self._tripped(broken - 1)

    def _advance(self, first: int, last: int) -> tuple[int, int]:
        """Integration steps with the rigs, from `first` to at most last - 1, for about LOOK_S. Returns as `loop.advance`."""
        return self._stepped(first, last, np.zeros(3, dtype=np.int64), time.perf_counter() + LOOK_S)

    def _stepped(self, first: int, last: int, control: Any, until: float) -> tuple[int, int]:
        """Integration steps first to last - 1, or until `control` asks to stop or the clock shows `until`.

        A lost rig sets `trip`. Returns as `loop.advance`.
        """
        if not self._adapters:
            fix = "run the plan inside its context"
            raise PlanError(Issue("stations", "has external rigs that are not connected", None, fix))
        setup, state, left_out, work, record = self._setup, self._state, self._effects, self._work, self._record
        for i in range(first, last):
            for done in range(i * setup.n, (i + 1) * setup.n):
                self.clock.wait()
                if done == i * setup.n:
                    external_step.begin_step(i, setup, state, left_out, work)
                broken = external_step.begin_stations(done, self._roles, setup, state, left_out, work, record)
                if not broken and not self._exchanged(done):
                    return 0, done
                broken = broken or external_step.finish_stations(done, self._roles, setup, state, left_out, work, record)
                if broken:
                    return broken, done
                if done == (i + 1) * setup.n - 1:
                    external_step.end_step(i, setup, state, work, record)
                self.clock.end(done)
                control[DONE] = done + 1
                if control[STOP]:
                    return 0, done + 1
            if time.perf_counter() > until:
                return 0, (i + 1) * setup.n
        return 0, last * setup.n

    def _exchanged(self, done: int) -> bool:
        """Send the commands of a controller step and take the readings; False after the loss of a rig."""
        begun, readings = self._work.begun, self._work.readings
        j = 0
        try:
            for j, adapter in self._adapters.items():
                adapter.command(float(begun[j, SENT]), float(begun[j, CURRENT]), (done + 1) * self.dt)
            for j, adapter in self._adapters.items():
                reading = adapter.measure()
                if (problem := _not_finite(reading)) is not None:
                    raise Lost(f"it {problem}")
                readings[j] = reading.displacement or 0.0, reading.force or 0.0
        except Lost as lost:
            self.trip = self._lost(j, done, str(lost))
            return False
        return True

    def _lost(self, j: int, done: int, what: str) -> Stop:
        name, peer = self.plan.stations[j].name, self._connections[j].peer
        good = f"The last good measurement is that of {done * self.dt:.3f} s." if done else "It had not measured before."
        return Stop.at(done, self.dt, LOST, f"Station {j + 1} ({name}) lost its rig, {peer}: {what}. {good}")


def _role(connection: External) -> int:
    given = connection.gives
    if given.displacement is None:
        return SPECIMEN
    return ALL if given.force is not None else ACTUATOR


def _not_finite(reading: Reading) -> str | None:
    for name, value in zip(Reading._fields, reading, strict=True):
        if value is not None and not math.isfinite(value):
            return f"sent a {name} that is not a number" if math.isnan(value) else f"sent a {name} that is infinite"
    return None
