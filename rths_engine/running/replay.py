"""Replay of one component on recorded signals, with the steps of the loop."""

from __future__ import annotations

from collections.abc import Sequence
from threading import Lock
from typing import NamedTuple

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import entry
from rths_engine.foundation.part import Part
from rths_engine.parts import actuators, compensators
from rths_engine.parts.physics.effect import (
    COMMAND,
    F_SENSOR,
    FORCE,
    HEAT,
    INPUT,
    PART,
    PISTON,
    SERIES,
    X_SENSOR,
    Effect,
    amended,
)
from rths_engine.planning.model import Model
from rths_engine.planning.plan import ROOM, Plan
from rths_engine.running import passes, small_structure
from rths_engine.running.data import F_MEAS, MEMORY, TI, X_CMD, X_MEAS
from rths_engine.running.dispatch import (
    acts,
    actuate,
    compensate,
    effects,
    extend_actuator,
    extend_sensor,
)
from rths_engine.running.integration import integrate
from rths_engine.running.setup import left_out, setup
from rths_engine.running.station import track

# chosen; see docs/decisions/0023
KEPT, KEPT_BYTES = 96, 48_000_000  # most forces that are kept for one displacement, and their memory


class KeptForces:
    """Forces of specimens without effects under one displacement and one current, the latest ones.

    Most effects add a force to the force of the specimen and leave its displacement as it is. The specimen's own steps, which
    may be costly, are then the same for all hypotheses and are replayed once. Several threads may share the object.
    """

    def __init__(self) -> None:
        self._known: dict[tuple[Part, float], Array] = {}
        self._lock = Lock()

    def of(self, part: Part, x: Array, current: Array, dt: float) -> Array:
        """The force (N) of the specimen `part` under displacement x (m) and current (A), every dt (s); not to be changed."""
        with self._lock:
            found = self._known.pop((part, dt), None)
        if found is None:
            found = passes.resist(part, x, current, dt)
        with self._lock:
            self._known[part, dt] = found
            while len(self._known) > max(2, min(KEPT, KEPT_BYTES // x.nbytes)):
                del self._known[next(iter(self._known))]
        return found


def specimen(
    part: Part,
    extended: Sequence[Effect],
    x: Array,
    current: Array,
    dt: float,
    start: float = 0.0,
    pressed: float = 0.0,
    kept: KeptForces | None = None,
    temperature: Array | None = None,
) -> Array:
    """Force (N) of a specimen with effects, from displacement (m) and current, every dt (s) from `start` (s).

    `pressed` is the force (N) before the first sample. `kept` holds the forces of specimens without effects under this
    displacement and current; the result may be one of them, and is not to be changed. The temperature (K) has one value for
    each sample or one for all; without it the specimen is at ROOM.
    """
    part = amended(part, extended)
    steps = _stepping(extended)
    warmth = np.broadcast_to(ROOM if temperature is None else temperature, x.shape)
    if any(effect.hook in (INPUT, SERIES) for effect in steps):
        force = passes.moved(part, steps, x, current, warmth, dt, start, pressed)
    else:
        force = passes.resist(part, x, current, dt) if kept is None else kept.of(part, x, current, dt)
        if not steps:
            return force
        force, v = force.copy(), passes.velocity(x, dt, x[0])
        for effect in (one for one in steps if one.hook == FORCE):
            passes.extend(effect, force, x, v, current, start, dt)
        for effect in (one for one in steps if one.hook == HEAT):
            passes.extend(effect, force, x, v, warmth, start, dt)
    misread = [one for one in steps if one.hook == F_SENSOR]
    if misread:
        true, v = force.copy(), passes.velocity(x, dt, x[0])
        for effect in misread:
            passes.extend(effect, force, x, v, true, start, dt)
    return force


def actuator(part: Part, extended: Sequence[Effect], command: Array, load: Array, dt: float, start: float = 0.0) -> Array:
    """Displacement reading (m) of an actuator with effects, from its command (m) and the force on it (N)."""
    part = amended(part, extended)
    steps = _stepping(extended)
    if any(effect.hook == COMMAND for effect in steps):
        parameters, state = part.build(dt)
        code = actuators.KINDS.index(type(part))
        x: Array = np.empty(len(command))
        _actuator(command, load, start, dt, code, parameters, state, effects(steps, dt), x)
        return x
    x = passes.act(part, command, load, dt)
    late = np.concatenate([[0.0], load[:-1]])  # an actuator feels the force of the substep before
    for effect in (one for one in steps if one.hook == PISTON):
        passes.extend(effect, x, command, passes.velocity(command, dt, 0.0), late, start, dt)
    misread = [one for one in steps if one.hook == X_SENSOR]
    true, v = x, passes.velocity(x, dt, 0.0)
    x = true.copy() if misread else x
    for effect in misread:
        passes.extend(effect, x, true, v, true, start, dt)
    return x


def compensator(part: Part, x_cmd: Array, x_meas: Array, dt: float) -> Array:
    """Compensated command (m) from the command and the measured displacement (m)."""
    parameters, state = part.build(dt)
    sent: Array = np.empty(len(x_cmd))
    _compensator(x_cmd, x_meas, dt, compensators.KINDS.index(type(part)), parameters, state, sent)
    return sent


class Moved(NamedTuple):
    """How a structure moved: displacements (m) of the floors, and strokes (m) of the stations, at steps 0, 1, ..."""

    floors: Array  # (steps + 1, floors)
    strokes: Array  # (steps + 1, stations)


def structure(planned: Plan | Model, inputs: Array, reactions: Array) -> Moved:
    """The motion of a plan's structure under inputs and the stations' forces.

    The inputs (steps + 1, 1 + forces) are the ground acceleration (m/s^2) and the forces on floors (N); the stations' forces
    are (steps + 1, stations), N.
    """
    model = Model.of(planned)
    if small_structure.fits(model):
        x = small_structure.moved(model, inputs, reactions)
        return Moved(x[:, model.built.floors], x @ model.drifts.T)
    stations = len(model.plan.stations)
    held, state = setup(model, inputs, np.zeros((len(inputs), stations)), np.zeros((0, stations, 2)))
    history: Array = np.empty((len(inputs), len(state.x)))
    history[0] = state.x
    _structure(held, state, left_out(model, held.kept), reactions, history)
    return Moved(history[:, held.floors], history @ held.drifts.T)


def _stepping(extended: Sequence[Effect]) -> list[Effect]:
    return [effect for effect in extended if effect.hook != PART]


@entry
def _actuator(command, load, start, dt, code, parameters, state, extended, reading):
    x, v, last_sent, force = 0.0, 0.0, 0.0, 0.0
    commands, moves, misread = acts(COMMAND, extended), acts(PISTON, extended), acts(X_SENSOR, extended)
    for q in range(command.size):
        t = start + q * dt
        sent = extend_actuator(COMMAND, extended, command[q], x, v, force, t, dt) if commands else command[q]
        moved = actuate(code, parameters, state, sent, force)
        if moves:
            moved = extend_actuator(PISTON, extended, moved, sent, (sent - last_sent) / dt, force, t, dt)
        x, v, last_sent, force = moved, (moved - x) / dt, sent, load[q]
        reading[q] = extend_sensor(X_SENSOR, extended, x, x, v, x, t, dt) if misread else x


@entry
def _compensator(x_cmd, x_meas, dt, code, parameters, state, sent):
    memory = np.zeros(MEMORY)
    for q in range(x_cmd.size):
        last, read, ti = memory[X_CMD], memory[X_MEAS], memory[TI]
        sent[q] = compensate(code, parameters, state, x_cmd[q], last, read, ti, dt)
        track(memory, x_cmd[q], x_meas[q], 0.0)


@entry
def _structure(held, state, extended, reactions, history):
    residual, work, x_next = np.empty(state.x.size), np.empty(state.x.size), np.empty(state.x.size)
    for i in range(history.shape[0] - 1):
        for j in range(reactions.shape[1]):
            state.memory[j, F_MEAS] = reactions[i, j]
        integrate(i, held, state, extended, residual, work, x_next)
        state.x[:] = x_next
        history[i + 1] = x_next
