"""Whether a plan has the excitation of a recording, so that its simulation can be laid over the recording."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.excitation import Start
from rths_engine.planning.model import Model
from rths_engine.planning.motion import scaled
from rths_engine.planning.plan import Plan
from rths_engine.recordings.excitation.recorded import Excitation
from rths_engine.recordings.measured import Measured

# chosen; see docs/decisions/0023
SAME = 0.05  # RMS of the difference of two excitations over the RMS of the recorded one


@dataclass(frozen=True, slots=True)
class Difference:
    """An excitation of a plan that differs from the recorded one: its name, and the relative RMS of the difference."""

    what: str
    size: float

    def __str__(self) -> str:
        return f"the {self.what} differs by {100 * self.size:.3g} % (RMS of the difference over RMS of the recorded signal)"


def under_recorded(plan: Plan, recording: Measured, library: MotionLibrary) -> Plan:
    """The plan itself where it has the recorded excitation, else the plan under the recorded excitation.

    Raises RecordingError where the recording has no excitation for this kind of test, and MotionError where the ground motion
    of the plan cannot be read.
    """
    return plan if not differences(plan, recording, library) else Excitation(plan, recording).planned()


def differences(plan: Plan, recording: Measured, library: MotionLibrary) -> list[Difference]:
    """The excitations of the plan that differ from the recorded ones. Raises RecordingError and MotionError."""
    found = Excitation(plan, recording)
    pairs = _driven(plan, found) if plan.driven else _computed(plan, found, library)
    sized = [Difference(what, _difference(ours, real)) for what, ours, real in pairs]
    return [one for one in sized if not one.size <= SAME]


def lead(plan: Plan, recording: Measured) -> float:
    """Time (s) that the plan takes before the recording begins: the ramp to a command that starts away from 0."""
    found = Excitation(plan, recording)
    if not plan.driven or not found.lead:
        return 0.0
    late, now = (_difference(plan.drive.sample(found.time + shift), found.command) for shift in (found.lead, 0.0))
    return found.lead if late < now else 0.0


Pair = tuple[str, Array, Array]  # what it is, as planned, as recorded


def _driven(plan: Plan, found: Excitation) -> Iterator[Pair]:
    what = {"drive": "drive", "x_meas": "displacement"}.get(found.source, "command")
    yield what, plan.drive.sample(found.time + lead(plan, found.recording)), found.command
    if found.current is not None:
        held = plan.stations[0].controller.mean if plan.stations[0].controller.kind == "constant" else 0.0
        yield "current", np.full(found.recording.samples, held), found.current


def _computed(plan: Plan, found: Excitation, library: MotionLibrary) -> Iterator[Pair]:
    none = np.zeros(found.recording.samples)
    if plan.motion.kind != "none" or found.ground is not None:
        motion = scaled(plan.motion, library, Model(plan).periods)
        own = np.interp(found.time, np.arange(len(motion.acceleration)) * motion.dt, motion.acceleration, right=0.0)
        if found.ground is None and plan.test == "hybrid":
            raise RecordingError(Issue("recording", "has no ground acceleration (role ag): its excitation is not known"))
        yield "ground motion", own, none if found.ground is None else found.ground
    for floor in sorted({*found.forces, *(force.floor for force in plan.forces)}):
        own = none.copy()
        for force in plan.forces:
            own += force.sample(found.time) if force.floor == floor else 0.0
        yield f"force on floor {floor}", own, found.forces.get(floor, none)
    if plan.test == "structure":
        floors = len(Model(plan).built.floors)
        yield "start", _start(plan.start, floors), _start(found.start, floors)


def _start(start: Start, floors: int) -> Array:
    x: Array = np.array(start.displacement, dtype=float)
    return x if len(x) else np.zeros(floors)


def _difference(ours: Array, real: Array) -> float:
    left, size = float(np.sqrt(np.mean((ours - real) ** 2))), float(np.sqrt(np.mean(real**2)))
    return left / size if size > 0 else (float("inf") if left > 0 else 0.0)
