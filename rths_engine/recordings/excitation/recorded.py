"""A plan under the recorded excitation: its simulation and the recording then show the same test."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.velocity_drive import VelocityDrive
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.parts.controllers.constant_current import ConstantCurrent
from rths_engine.parts.specimens.commanded import Commanded
from rths_engine.planning.excitation import Drive, FloorForce, Start
from rths_engine.planning.motion import InlineMotion, NoMotion
from rths_engine.planning.plan import Plan, Station
from rths_engine.planning.shapes import Samples
from rths_engine.recordings.excitation.smoother import Smoother
from rths_engine.recordings.excitation.start import released_start
from rths_engine.recordings.measured import Measured

# chosen; see docs/decisions/0023
LEAD, STARTED = 1.0, 1e-3  # s before a recording whose command starts away from 0; share of the largest command
ROOM, ROOM_FORCE = 1.05, 3.0  # limits over the largest recorded value: of motion; of force, which effects may raise
FASTEST, STRONGEST = 10.0, 1e8  # m/s and N: bounds of an actuator that follows its command without delay
DIGITS = 9  # digits of a recorded value that a plan keeps
MOST = 990_000  # samples; a plan holds a million, and a ramp of a second may precede them


@dataclass(frozen=True)
class Excitation:
    """The recorded excitation of a test, for a plan of its kind.

    The samples of a measured recording begin at the start of the test, those of a run one controller step later. A recorded
    command that starts away from 0 follows a ramp of LEAD seconds, because every test starts at 0.
    """

    plan: Plan
    recording: Measured

    @property
    def first(self) -> float:
        """Time (s) in the test of the first sample, without the ramp before it."""
        return self.recording.dt if self.recording.of_run else 0.0

    @property
    def time(self) -> Array:
        """Time (s) in the test of every sample, without the ramp before them."""
        time: Array = self.first + np.arange(self.recording.samples) * self.recording.dt
        return time

    @cached_property
    def source(self) -> str:
        """The role of the channel that drives a test of one station: a command, or the measured displacement.

        A command that was recorded at another rate than the controller's was not what the actuator followed.
        """
        same_rate = math.isclose(self.recording.dt, self.plan.substep, rel_tol=1e-6)
        roles = ("x_cmd", "drive", "x_comp") if same_rate or self.plan.test == "actuator" else ()
        found: str | None = next((role for role in (*roles, "x_meas") if _moves(self.recording, role)), None)
        if found is None or (found == "x_meas" and self.plan.test == "actuator"):
            raise RecordingError(Issue("recording", "has no command and no displacement that a test could follow"))
        return found

    @property
    def command(self) -> Array:
        """The recorded command of a test of one station (m or V)."""
        return self.recording.get(self.source)

    @property
    def smooth(self) -> Array:
        """The recorded command; a measured displacement is smoothed, because a dashpot would answer its noise."""
        values = self.command
        if self.source != "x_meas" or self.recording.of_run:
            return values
        return Smoother.of(values, self.recording.dt).smoothed(values)

    @property
    def current(self) -> Array | None:
        """The recorded current (A) that the specimen of a test of one station follows; None where it follows none."""
        station = self.plan.stations[0]
        if not isinstance(station.specimen, Commanded):
            return None
        if self.recording.has("coil_voltage") and not self.recording.has("current"):
            return self.recording.get("coil_voltage") / (station.coil_resistance or 1.0)
        return self.recording.get("current") if self.recording.has("current") else None

    @property
    def lead(self) -> float:
        """Duration (s) of the ramp before the recorded command; 0 for a structure."""
        if not self.plan.driven or self.recording.of_run or isinstance(self.plan.stations[0].actuator, VelocityDrive):
            return 0.0
        return LEAD if abs(self.command[0]) > STARTED * float(np.max(np.abs(self.command))) else 0.0

    @property
    def ground(self) -> Array | None:
        """The recorded ground acceleration (m/s^2)."""
        return self.recording.get("ag") if self.recording.has("ag") else None

    @property
    def forces(self) -> dict[int, Array]:
        """The recorded forces (N) by floor."""
        channels = self.recording.channels
        return {one.number: one.values for one in channels if one.role == "force_ext" and one.number}

    @cached_property
    def start(self) -> Start:
        """The start of a structure: as planned for a run, else as the first samples of the floors show it."""
        if self.recording.of_run or self.plan.test != "structure":
            return self.plan.start
        ground = np.zeros(self.recording.samples) if self.ground is None else self.ground
        released = released_start(self.plan, self.recording, ground, self.forces)
        return Start(displacement=released[0], velocity=released[1]) if released else Start()

    def planned(self) -> Plan:
        """The plan under the recorded excitation. The limits of a station are raised to the recorded motion.

        Raises RecordingError where the recording has no excitation for this kind of test, or more samples than a plan can hold.
        """
        if self.recording.samples > MOST:
            problem = f"has {self.recording.samples} samples; a plan holds at most {MOST} of an excitation"
            raise RecordingError(Issue("recording", problem, None, "import a shorter part of the recording"))
        return self.plan.model_copy(update=self._driven() if self.plan.driven else self._computed())

    def _driven(self) -> dict[str, Any]:
        values, peak = self.smooth, float(np.max(np.abs(self.command)))
        if self.lead:
            ramp = np.arange(round(self.lead / self.recording.dt)) * self.recording.dt / self.lead
            values = np.concatenate([values[0] * (0.5 - 0.5 * np.cos(np.pi * ramp)), values])
        drive = Drive(amplitude=peak, shape=self._samples(values / peak))
        station = self.plan.stations[0]
        changes: dict[str, Any] = {}
        if self.source in ("x_comp", "x_meas"):
            changes["compensator"] = NoCompensation()
        if self.source == "x_meas":  # the specimen follows the recorded motion itself
            follows = FirstOrderDelay(alpha=1, velocity_limit=FASTEST, force_limit=STRONGEST)
            changes |= {"actuator": follows, "actuator_physics": ()}
        if self.current is not None:  # a run holds a current or computes it
            changes["controller"] = ConstantCurrent(current=max(0.0, float(np.mean(self.current))))
        station = station.model_copy(update=changes)
        speed = float(np.max(np.abs(np.diff(values)))) / self.recording.dt
        return {"drive": drive, "stations": (self._room(station, peak, speed),), "duration": drive.shape.duration}

    def _computed(self) -> dict[str, Any]:
        if self.ground is None and not self.forces and self.start.at_rest:
            needed = "it needs the ground acceleration (role ag) or the forces on the floors (role force_ext)"
            raise RecordingError(Issue("recording", f"does not contain the excitation of its test: {needed}"))
        motion: Any = NoMotion()
        if self.ground is not None:
            dt, values = self._thin(self.ground)
            motion = InlineMotion(dt=dt, acceleration=_rounded(values))
        forces = []
        for floor, values in self.forces.items():
            peak = float(np.max(np.abs(values))) or 1.0
            forces.append(FloorForce(floor=floor, amplitude=peak, shape=self._samples(values / peak)))
        dt, kept = self._thin(self.time)
        return {"motion": motion, "forces": tuple(forces), "start": self.start, "duration": dt * (len(kept) - 1)}

    def _room(self, station: Station, peak: float, speed: float) -> Station:
        """The station with limits that the recorded motion and its force do not reach."""
        limits = station.limits
        force = self.recording.get("f_meas") if self.recording.has("f_meas") else np.zeros(1)
        wide = {
            "displacement": min(10.0, max(limits.displacement, ROOM * peak)),
            "velocity": min(station.actuator.velocity_limit, max(limits.velocity, ROOM * speed)),
            "force": min(1e9, max(limits.force, ROOM_FORCE * float(np.max(np.abs(force))))),
        }
        return station.model_copy(update={"limits": limits.model_copy(update=wide)})

    def _samples(self, shares: Array) -> Samples:
        dt, values = self._thin(shares)
        return Samples(dt=dt, values=_rounded(values))

    def _thin(self, values: Array) -> tuple[float, Array]:
        """Time step and values from the start of the test on, at no more than the controller's rate."""
        every = max(1, int(self.plan.substep / self.recording.dt + 1e-9))
        if self.recording.of_run:  # the sample at the start, by the slope of the first two
            values = np.concatenate([[2 * values[0] - values[1]], values])
        return every * self.recording.dt, values[::every]


def _moves(recording: Measured, role: str) -> bool:
    return recording.has(role) and float(np.ptp(recording.get(role))) > 0


def _rounded(values: Array) -> tuple[float, ...]:
    return tuple(float(f"{value:.{DIGITS}g}") for value in values)
