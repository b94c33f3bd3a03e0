"""Replay of one component on recorded signals, with the steps of the loop."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import entry
from rths_engine.foundation.part import Part
from rths_engine.parts import actuators, compensators, specimens
from rths_engine.parts.physics.effect import COMMAND, F_SENSOR, FORCE, INPUT, PART, PISTON, SERIES, X_SENSOR, Effect, amended
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.running import loop, starting
from rths_engine.running.dispatch import (
    acts,
    actuate,
    compensate,
    effects,
    extend_actuator,
    extend_sensor,
    extend_specimen,
    resist,
    resisted,
)
from rths_engine.running.setup import left_out, setup


def specimen(
    part: Part, extended: Sequence[Effect], x: Array, current: Array, dt: float, start: float = 0.0, pressed: float = 0.0
) -> Array:
    """Force (N) of a specimen with effects, from displacement (m) and current, every dt (s) from `start` (s).

    `pressed` is the force (N) before the first sample.
    """
    part = amended(part, extended)
    parameters, state = part.build(dt)
    code = specimens.KINDS.index(type(part))
    force: Array = np.empty(len(x))
    _specimen(x, current, start, dt, pressed, code, parameters, state, effects(_stepping(extended), dt), force)
    return force


def actuator(part: Part, extended: Sequence[Effect], command: Array, load: Array, dt: float, start: float = 0.0) -> Array:
    """Displacement reading (m) of an actuator with effects, from its command (m) and the force on it (N)."""
    part = amended(part, extended)
    parameters, state = part.build(dt)
    code = actuators.KINDS.index(type(part))
    x: Array = np.empty(len(command))
    _actuator(command, load, start, dt, code, parameters, state, effects(_stepping(extended), dt), x)
    return x


def compensator(part: Part, x_cmd: Array, x_meas: Array, dt: float) -> Array:
    """Compensated command (m) from the command and the measured displacement (m)."""
    parameters, state = part.build(dt)
    sent: Array = np.empty(len(x_cmd))
    _compensator(x_cmd, x_meas, dt, compensators.KINDS.index(type(part)), parameters, state, sent)
    return sent


def structure(planned: Plan | Model, inputs: Array, reactions: Array) -> Array:
    """Displacements (steps + 1, DOF), m, of a plan's structure under inputs and the stations' forces.

    The inputs (steps + 1, 1 + forces) are the ground acceleration (m/s^2) and the forces on floors (N); the stations' forces
    are (steps + 1, stations), N.
    """
    model = Model.of(planned)
    stations = len(model.plan.stations)
    held, parts = setup(model, inputs, np.zeros((len(inputs), stations)), np.zeros((0, stations, 2)))
    x, v, carry = starting.state(model, inputs[0] @ held.loads)
    state = loop.State(x, v, carry, np.zeros((len(model.built.members.dofs), 3)), parts, np.zeros((stations, loop.MEMORY)))
    history: Array = np.empty((len(inputs), len(x)))
    history[0] = x
    _structure(held, state, left_out(model), reactions, history)
    return history


def _stepping(extended: Sequence[Effect]) -> list[Effect]:
    return [effect for effect in extended if effect.hook != PART]


@entry
def _specimen(x, current, start, dt, pressed, code, parameters, state, extended, force):
    f, inner, flexibility, last, last_u = pressed, 0.0, 0.0, x[0], 0.0
    moves, gives, adds, misread = acts(INPUT, extended), acts(SERIES, extended), acts(FORCE, extended), acts(F_SENSOR, extended)
    before = np.empty(state.size)
    for q in range(x.size):
        t = start + q * dt
        v = (x[q] - last) / dt
        u = last = x[q]
        if moves:
            u = extend_specimen(INPUT, extended, u, x[q], v, f, t, dt)
        if gives:
            flexibility = extend_specimen(SERIES, extended, 0.0, x[q], v, f, t, dt)
            u, f = resisted(code, parameters, state, flexibility, u, dt, before, inner)
        else:
            f = resist(code, parameters, state, u, dt)
        inner = f
        last_u = u if q == 0 else last_u
        if adds:
            f = extend_specimen(FORCE, extended, f, u, (u - last_u) / dt, current[q], t, dt)
        last_u = u
        force[q] = extend_sensor(F_SENSOR, extended, f, x[q], v, f, t, dt) if misread else f


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
    memory = np.zeros(loop.MEMORY)
    for q in range(x_cmd.size):
        last, read, ti = memory[loop.X_CMD], memory[loop.X_MEAS], memory[loop.TI]
        sent[q] = compensate(code, parameters, state, x_cmd[q], last, read, ti, dt)
        loop.track(memory, x_cmd[q], x_meas[q], 0.0)


@entry
def _structure(held, state, extended, reactions, history):
    residual, work, x_next = np.empty(state.x.size), np.empty(state.x.size), np.empty(state.x.size)
    for i in range(history.shape[0] - 1):
        for j in range(reactions.shape[1]):
            state.memory[j, loop.F_MEAS] = reactions[i, j]
        loop.integrate(i, held, state, extended, residual, work, x_next)
        state.x[:] = x_next
        history[i + 1] = x_next
