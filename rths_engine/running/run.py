"""A run, the only owner of state that changes. `advance` runs it in parts, for the live view, cancelling and pace."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.parts.ground_motions import Motion, MotionLibrary
from rths_engine.planning import motion
from rths_engine.planning.connections import external
from rths_engine.planning.loads import columns
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.safety import LIMITS, Trip
from rths_engine.results.channels import Channel, channels
from rths_engine.results.result import Result
from rths_engine.results.running_timing import RunningTiming
from rths_engine.results.timing import Timing
from rths_engine.running import loop
from rths_engine.running.coupled import advance_coupled, coupled
from rths_engine.running.data import Record
from rths_engine.running.pacing import DONE, UNPACED, Pacing
from rths_engine.running.setup import effects_in, left_out, setup

# chosen; see docs/decisions/0023
LARGEST_RECORDING = 2_000_000_000  # bytes


class Run:
    """One execution of a plan. `signals[:done]` are the recorded samples in SI, with columns as in `channels`.

    The run starts as planned, or from `initial`: displacements (m) and velocities (m/s) of the loop's degrees of freedom.
    `noise` makes the sensor noise of a plan; a sweep keeps it, because its points often share one seed. Raises PlanError or
    MotionError, before anything runs, when the plan cannot run.
    """

    models_only = True
    """Whether every station is emulated. A plan with external rigs runs as `opening.opened`, or `connections.modelled`."""

    def __init__(
        self,
        planned: Plan | Model,
        motions: MotionLibrary,
        initial: tuple[Sequence[float], Sequence[float]] | None = None,
        noise: Callable[[Plan, int], Array] | None = None,
    ):
        self.model = model = Model.of(planned)
        self.plan = plan = model.plan
        if plan.test == "client":
            problem = "follows a client, which computes its structure: it cannot run alone"
            raise PlanError(Issue("test", problem, plan.test, "serve the client with `rths rig`, or queue the test"))
        if self.models_only and external(plan):
            fix = "connect it, or emulate the station by its models"
            raise PlanError(Issue(f"stations.{min(external(plan))}.connection", "is an external rig", None, fix))
        self.motion: Motion = motion.scaled(plan.motion, motions, model.periods)
        self.dt = plan.substep
        self.trip: Trip | None = None
        self.measured: RunningTiming | None = None  # of a test in real time, so far
        self.timing: Timing | None = None
        self.done = 0
        self._step = 0
        n, dt = plan.substeps, plan.step
        self._steps = _steps(plan.length(self.motion.duration), dt)
        self.total = self._steps * n
        built = model.built
        stations = len(plan.stations)
        self.channels: tuple[Channel, ...] = channels(model)
        if self.total * len(self.channels) * 8 > LARGEST_RECORDING:
            problem = f"{self.total} substeps of {len(self.channels)} channels exceed {LARGEST_RECORDING / 1e9:g} GB"
            raise PlanError(Issue("duration", problem, plan.duration, "shorten the test or lower the controller rate"))
        self.signals: Array = np.zeros((self.total, len(self.channels)))
        self.history: Array = np.zeros((self._steps + 1, 2, len(built.floors)))
        times = np.arange(self._steps + 1) * dt
        drive = np.repeat(plan.drive.sample(times)[:, None], stations, axis=1)
        inputs, noises = _inputs(plan, self.motion, times), (noise or sensor_noise)(plan, self.total)
        self._setup, self._state = setup(model, inputs, drive, noises, initial)
        self._coupled = coupled(plan)
        effects = left_out if self._coupled is None else effects_in
        self._left_out = effects(model, self._setup.kept)
        self._columns = columns(plan)
        shared = len(self._columns) - len(set(self._columns.tolist()))
        written = np.zeros((self.total, len(self.channels) + shared)) if shared else self.signals
        self._record = Record(written, self.history, np.zeros(4))
        self.history[0] = self._state.x[self._setup.floors], self._state.v[self._setup.floors]

    @property
    def noise(self) -> Array:
        """Sensor noise of the recorded samples (done, stations, 2): displacement (m) and force (N)."""
        noise: Array = self._setup.noise[: self.done]
        return noise

    @property
    def finished(self) -> bool:
        return self.trip is not None or self.done >= self.total

    def advance(self, steps: int) -> slice:
        """Run up to `steps` integration steps; returns the new rows of `signals`. A trip ends the run in its substep."""
        if self.finished:
            return slice(self.done, self.done)
        last = min(self._step + steps, self._steps)
        broken, done = self._advance(self._step, last)
        self._step = done // self.plan.substeps
        new = self.take(done)
        if broken:
            self.trip = self._tripped(broken - 1)
        return new

    def touch(self) -> None:
        """Write to every page of the recording, so that no step of a paced run waits for memory."""
        for array in (self.signals, self._record.signals, self.history[1:]):
            array.fill(0.0)

    def run_paced(self, pacing: Pacing) -> None:
        """Run the whole test paced, outside the interpreter lock. Another thread takes the rows of its steps (`take`)."""
        broken, done = self._loop(0, self._steps, pacing)
        pacing.control[DONE] = done
        self._step = self._steps
        if broken > 0:
            self.trip = self._tripped(broken - 1)

    def take(self, done: int) -> slice:
        """Take the rows that the loop has written up to substep `done` into `signals`; returns the new rows."""
        new = slice(self.done, done)
        if self._record.signals is not self.signals:
            self.signals[new] = _summed(self._record.signals[new], self._columns)
        self.done = done
        return new

    def _advance(self, first: int, last: int) -> tuple[int, int]:
        """Integration steps first to last - 1. Returns as `loop.advance`."""
        return self._loop(first, last, UNPACED)

    def _loop(self, first: int, last: int, pacing: Pacing) -> tuple[int, int]:
        """The compiled loop from integration step `first` to `last` - 1. Returns as `loop.advance`."""
        of_run = first, last, self._setup, self._state, self._left_out
        if self._coupled is not None:
            broken, done = advance_coupled(*of_run, self._coupled, self._record, pacing)
        else:
            broken, done = loop.advance(*of_run, self._record, pacing)
        return broken, done

    def result(self, status: str, elapsed_s: float) -> Result:
        """The result so far: recorded signals and their measures. `status` is completed, tripped or cancelled."""
        steps = self.done // self.plan.substeps
        return Result(
            model=self.model,
            motion=self.motion,
            status=status,
            trip=self.trip,
            elapsed_s=elapsed_s,
            dt=self.dt,
            total=self.total,
            channels=self.channels,
            signals=self.signals[: self.done],
            history=self.history[: steps + 1],
            timing=self.timing,
        )

    def _tripped(self, limit: int) -> Trip:
        found = self._record.trip
        station, substep = int(found[0]), int(found[3])
        kind = list(LIMITS)[limit]
        name = self.plan.stations[station].name
        return Trip(station + 1, name, kind, float(found[1]), float(found[2]), LIMITS[kind][1], substep * self.dt, substep)


def simulate(planned: Plan | Model, motions: MotionLibrary | None = None) -> Result:
    """Run a plan to its end as fast as possible."""
    run = Run(planned, motions or MotionLibrary(None))
    start = time.perf_counter()
    run.advance(run.total)
    return run.result("tripped" if run.trip else "completed", time.perf_counter() - start)


def _summed(rows: Array, columns: NDArray[np.int64]) -> Array:
    """The rows of the loop, with the inputs of the same recorded column added; the other columns do not change."""
    inputs = np.full(
        (len(rows), columns.max() + 1), -0.0
    )  # adding a number to -0.0 gives the same number, also for 0.0 and -0.0
    for k, column in enumerate(columns):
        inputs[:, column] += rows[:, k]
    return np.hstack([inputs, rows[:, len(columns) :]])


def sensor_noise(plan: Plan, total: int) -> Array:
    """Sensor noise (substeps, stations, 2): displacement (m) and force (N), from the seed of the plan."""
    scale = np.array([(station.noise.displacement, station.noise.force) for station in plan.stations]).reshape(-1, 2)
    noise: Array = np.zeros((total, len(scale), 2))
    if scale.any():
        noise = np.random.Generator(np.random.PCG64(plan.seed)).standard_normal(noise.shape) * scale
    return noise


def _steps(duration: float, dt: float) -> int:
    return max(1, math.ceil(duration / dt - 1e-9))


def _inputs(plan: Plan, record: Motion, time: Array) -> Array:
    """Inputs (steps + 1, inputs): ground acceleration, linear between samples and zero after the record, and floor forces."""
    if plan.driven:
        return np.zeros((len(time), 0))
    ground = record.acceleration
    for effect in plan.motion_physics:
        ground = effect.shaken(ground, record.dt)
    ground = np.interp(time, np.arange(len(ground)) * record.dt, ground, right=0.0)
    return np.column_stack([ground, *(force.sample(time) for force in plan.forces)])
