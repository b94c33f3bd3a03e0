"""Replay of the computed parts of a hybrid test: structure and compensators must agree with the recording to rounding."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.planning.excitation import FloorForce
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured import Measured
from rths_engine.running import replay

# chosen; see docs/decisions/0023
ROUNDING = 1e-5  # of the largest value: text files keep at least five digits


@dataclass(frozen=True)
class Replayed:
    """The errors of a replayed computed part.

    `error` is the largest error over the largest value. `nrmse` is the RMS error over the RMS about the mean. Both are infinite
    where the replay diverges. `what` names the signal in words.
    """

    component: str
    error: float
    nrmse: float
    what: str

    @property
    def differs(self) -> bool:
        return self.error > ROUNDING


def replayed(plan: Plan, recording: Measured) -> list[Replayed]:
    """The replayed compensators and structure of a hybrid test; empty unless it was recorded at the controller rate."""
    if plan.test != "hybrid" or not np.isclose(recording.dt, plan.substep, rtol=1e-6):
        return []
    return [*_compensators(plan, recording), *_structure(plan, recording)]


def _compensators(plan: Plan, recording: Measured) -> list[Replayed]:
    found = []
    for number, station in enumerate(plan.stations, start=1):
        if all(recording.has(role, number) for role in ("x_cmd", "x_comp", "x_meas")):
            x_cmd, x_comp, x_meas = (recording.get(role, number) for role in ("x_cmd", "x_comp", "x_meas"))
            sent = replay.compensator(station.compensator, x_cmd, x_meas, recording.dt)
            found.append(_compared(f"compensator:{number}", x_comp, sent, f"the compensated command of {station.name}"))
    return found


def _structure(plan: Plan, recording: Measured) -> list[Replayed]:
    """Replay x_cmd at the integration steps from the ground motion and the measured forces, if all were recorded."""
    stations = range(1, len(plan.stations) + 1)
    n = plan.substeps
    whole = all(recording.has(role, number) for role in ("x_cmd", "f_meas") for number in stations)
    if not whole or not recording.has("ag") or not stations or not np.isclose(recording.start, recording.dt, rtol=1e-3):
        return []
    forces = [(one.number, one.values) for one in recording.channels if one.role == "force_ext" and one.number]
    if len(forces) != len({force.floor for force in plan.forces}):
        return []
    rows = np.column_stack([recording.get("ag"), *(values for _, values in forces)])
    first = (n * rows[0] - rows[n - 1]) / (n - 1) if n > 1 else rows[0]
    inputs = np.vstack([first, rows[n - 1 :: n]])
    held = [np.concatenate([[0.0], recording.get("f_meas", number)[n - 1 :: n]]) for number in stations]
    model = Model(plan.model_copy(update={"forces": tuple(FloorForce(floor=floor) for floor, _ in forces)}))
    commands = replay.structure(model, inputs, np.column_stack(held)).strokes
    found = []
    for number in stations:
        real = recording.get("x_cmd", number)[n - 1 :: n]
        what = f"the command of {plan.stations[number - 1].name}"
        found.append(_compared("structure", real, commands[1 : 1 + len(real), number - 1], what))
    return found


def _compared(component: str, real: Array, ours: Array, what: str) -> Replayed:
    largest = max(float(np.max(np.abs(real))), 1e-300)
    error = real - ours
    spread = max(float(np.std(real)), 1e-300)
    worst, nrmse = float(np.max(np.abs(error))) / largest, float(np.sqrt(np.mean(error**2))) / spread
    if not np.isfinite([worst, nrmse]).all():
        worst, nrmse = np.inf, np.inf
    return Replayed(component, worst, nrmse, what)
