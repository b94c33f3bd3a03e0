"""The compiled loop: integrate, ramp, compensate, actuate, measure, check, record.

Order within step i: from the external and measured forces at step i, the integrator computes x[i+1] and v[i+1], for CR by (3).
The command ramps from L x[i] to L x[i+1] over n substeps (8). Every substep checks the limits, compensates (7), actuates (5),
reads the specimen and the sensors, and updates the tracking indicator (9) and the energy error (10). A test of a specimen or an
actuator alone has no degrees of freedom: its command is the drive.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from rths_engine.foundation.kernel import compiled, entry
from rths_engine.parts.physics.effect import COMMAND, F_SENSOR, FORCE, HEAT, INPUT, PISTON, SERIES, STOREY, X_SENSOR
from rths_engine.parts.structures.assembled import Members
from rths_engine.results.channels import RECORDED
from rths_engine.running.dispatch import (
    actuate,
    command,
    compensate,
    energise,
    extend_actuator,
    extend_sensor,
    extend_specimen,
    extend_storey,
    own,
    resist,
    resisted,
)
from rths_engine.running.oscillation import SIZE, half_waves
from rths_engine.running.restoring import subtract_forces, subtract_product
from rths_engine.running.solve import solve

# memory of a station between substeps
X_CMD, X_MEAS, F_TRUE, F_MEAS, AREA, AREA_TURNED, TI, ENERGY_ERROR, X_TRUE, V_TRUE, X_SENT, X_END, WAVES = range(13)
MEMORY = WAVES + SIZE  # the last ones are oscillation.half_waves'
WIDTH = len(RECORDED)  # columns of every station; the current of a controller follows them
# parts of a station
COMPENSATOR, ACTUATOR, SPECIMEN, CONTROLLER = range(4)


@compiled
def _within(value, limit):
    return abs(value) <= limit


@compiled
def track(memory, x_cmd, x_meas, f_meas):
    """Tracking indicator (9) and energy error (10) by the trapezoidal rule; stores the measured values for the next substep."""
    cmd_move = x_cmd - memory[X_CMD]
    meas_move = x_meas - memory[X_MEAS]
    memory[AREA] += 0.5 * (x_cmd + memory[X_CMD]) * meas_move
    memory[AREA_TURNED] += 0.5 * (x_meas + memory[X_MEAS]) * cmd_move
    memory[TI] = 0.5 * (memory[AREA] - memory[AREA_TURNED])
    memory[ENERGY_ERROR] += 0.5 * (f_meas + memory[F_MEAS]) * (cmd_move - meas_move)
    memory[X_CMD] = x_cmd
    memory[X_MEAS] = x_meas
    memory[F_MEAS] = f_meas


class Setup(NamedTuple):
    """The constant data of a run (SI). S stations, Q substeps of the whole run."""

    n: int  # substeps of an integration step
    dt_step: float  # integration step
    dt: float  # substep
    factor: Any  # the integrator's D factorised
    held: Any  # its E, compressed rows
    weight: float  # its w
    shift: float  # its s
    damping: Any  # C, compressed rows
    elastic: Any  # stiffness beside the members, compressed rows
    members: Members
    loads: Any  # (I, DOF), forces by a unit of each input: -M @ iota for the ground acceleration
    inputs: Any  # (steps + 1, I) at the integration steps
    floors: Any  # DOF of the floors
    drifts: Any  # L (S, DOF)
    drive: Any  # (steps + 1, S), added to L x
    dampers: Any  # number of equal dampers that a station represents (S)
    codes: Any  # part codes (S, 4)
    parameters: Any  # (4, S, widest)
    limits: Any  # (S, 4), in the order of safety.LIMITS
    noise: Any  # (Q, S, 2)
    temperatures: Any  # of the specimens, K (S)
    columns: Any  # first and last column + 1 of the stations in a row of signals (S, 2)


class State(NamedTuple):
    """The data that change from step to step, in place."""

    x: Any  # (DOF)
    v: Any  # (DOF)
    carry: Any  # c of the scheme (DOF)
    plastic: Any  # plastic curvature (members, 3)
    parts: Any  # (4, S, widest)
    memory: Any  # (S, MEMORY)


class LeftOut(NamedTuple):
    """The left-out effects of a plan. A plan without effects has a loop that is compiled without them."""

    stations: Any  # dispatch.Effects, stacked
    storeys: Any  # dispatch.Effects, stacked, E effects of storeys
    drifts: Any  # (E, DOF), maps x to the drift that each effect acts against
    stiffness: Any  # (E), elastic, along that drift


class Record(NamedTuple):
    """The output of a run. Columns of signals: inputs, floors, stations; trip: station from 0, value, bound, substep from 1."""

    signals: Any  # (Q, inputs + floors + columns of the stations)
    history: Any  # (steps + 1, 2, floors), x and v
    trip: Any  # (4)


@compiled
def _extended_rig(j, setup, state, left_out, x_comp, current, noise, t):
    """The readings of station j: its actuator, specimen and sensors with their effects (`physics.effect`)."""
    memory, dt, effects = state.memory[j], setup.dt, own(left_out.stations, j)
    codes, parameters, parts = setup.codes[j], setup.parameters, state.parts
    force, before = memory[F_TRUE], memory[X_TRUE]
    sent = extend_actuator(COMMAND, effects, x_comp, before, memory[V_TRUE], force, t, dt)
    x = actuate(codes[ACTUATOR], parameters[ACTUATOR, j], parts[ACTUATOR, j], sent, force)
    x = extend_actuator(PISTON, effects, x, sent, (sent - memory[X_SENT]) / dt, force, t, dt)
    v = (x - before) / dt
    u = extend_specimen(INPUT, effects, x, x, v, force, t, dt)
    flexibility = extend_specimen(SERIES, effects, 0.0, x, v, force, t, dt)
    own_state = parts[SPECIMEN, j]
    u, force = resisted(codes[SPECIMEN], parameters[SPECIMEN, j], own_state, flexibility, u, dt, own_state.copy(), force)
    rate = (u - memory[X_END]) / dt
    force = extend_specimen(FORCE, effects, force, u, rate, current, t, dt)
    force = extend_specimen(HEAT, effects, force, u, rate, setup.temperatures[j], t, dt)
    memory[X_TRUE], memory[V_TRUE], memory[X_SENT], memory[X_END], memory[F_TRUE] = x, v, sent, u, force
    x_meas = extend_sensor(X_SENSOR, effects, x + noise[0], x, v, x, t, dt)
    f_meas = extend_sensor(F_SENSOR, effects, force + noise[1], x, v, force, t, dt)
    return x_meas, f_meas


@compiled
def _substep(j, setup, state, left_out, x_cmd, noise, time, row):
    """One controller step of station j into its row. Returns 0 or the position plus 1 of the exceeded limit, and the value."""
    memory, limits, dt = state.memory[j], setup.limits[j], setup.dt
    codes, parameters, parts = setup.codes[j], setup.parameters, state.parts
    velocity = (x_cmd - memory[X_CMD]) / dt
    if not _within(x_cmd, limits[0]):
        return 1, x_cmd
    if not _within(velocity, limits[1]):
        return 2, velocity
    waves = half_waves(memory[WAVES:], velocity, dt)
    if not _within(waves, limits[3]):
        return 4, waves
    adapted = parts[COMPENSATOR, j]
    x_last, x_meas_last, ti = memory[X_CMD], memory[X_MEAS], memory[TI]
    x_comp = compensate(codes[COMPENSATOR], parameters[COMPENSATOR, j], adapted, x_cmd, x_last, x_meas_last, ti, dt)
    current = command(codes[CONTROLLER], parameters[CONTROLLER, j], parts[CONTROLLER, j], x_cmd, velocity, memory[F_MEAS], dt)
    energise(codes[SPECIMEN], parameters[SPECIMEN, j], parts[SPECIMEN, j], current, dt)
    if left_out is not None:
        x_meas, f_meas = _extended_rig(j, setup, state, left_out, x_comp, current, noise, time)
    else:
        x_true = actuate(codes[ACTUATOR], parameters[ACTUATOR, j], parts[ACTUATOR, j], x_comp, memory[F_TRUE])
        f_true = resist(codes[SPECIMEN], parameters[SPECIMEN, j], parts[SPECIMEN, j], x_true, dt)
        memory[F_TRUE] = f_true
        x_meas = x_true + noise[0]
        f_meas = f_true + noise[1]
    track(memory, x_cmd, x_meas, f_meas)
    row[0], row[1], row[2], row[3] = x_cmd, x_comp, x_meas, f_meas
    row[4], row[5], row[6], row[7] = x_cmd - x_meas, memory[TI], adapted[0], memory[ENERGY_ERROR]
    if row.size > WIDTH:
        row[WIDTH] = current
    if not _within(f_meas, limits[2]):
        return 3, f_meas
    return 0, 0.0


@compiled
def _resist_drifts(t, dt, state, left_out, residual):
    """Subtract from `residual` the forces of the structure's left-out effects, against the drifts of their storeys."""
    x, v = state.x, state.v
    for k in range(left_out.stiffness.size):
        drift, rate = 0.0, 0.0
        for a in range(x.size):
            drift += left_out.drifts[k, a] * x[a]
            rate += left_out.drifts[k, a] * v[a]
        force = extend_storey(STOREY, own(left_out.storeys, k), 0.0, drift, rate, left_out.stiffness[k] * drift, t, dt)
        for a in range(x.size):
            residual[a] -= left_out.drifts[k, a] * force


@compiled
def integrate(i, setup, state, left_out, residual, work, x_next):
    """x[i+1] into x_next and v[i+1] into state.v by the scheme (`integrators.scheme`), with the measured forces of step i."""
    x, v = state.x, state.v
    for a in range(x.size):
        residual[a] = 0.0
    for k in range(setup.loads.shape[0]):
        for a in range(x.size):
            residual[a] += setup.loads[k, a] * setup.inputs[i, k]
    for j in range(setup.dampers.size):
        force = setup.dampers[j] * state.memory[j, F_MEAS]
        for a in range(x.size):
            residual[a] -= setup.drifts[j, a] * force
    subtract_product(setup.damping, v, residual)
    subtract_product(setup.elastic, x, residual)
    subtract_forces(setup.members, x, state.plastic, residual)
    if left_out is not None:
        _resist_drifts(i * setup.dt_step, setup.dt_step, state, left_out, residual)
    remembers = setup.held.value.size > 0
    if remembers:
        for a in range(x.size):
            now = residual[a]
            residual[a] = (1.0 - setup.weight) * now + state.carry[a]
            state.carry[a] = setup.weight * now
    solve(setup.factor, residual, work, x_next)
    if remembers:
        subtract_product(setup.held, x_next, state.carry)
    for a in range(x.size):
        v[a] += setup.dt_step * x_next[a]
        x_next[a] = x[a] + setup.dt_step * (v[a] + setup.shift * setup.dt_step * x_next[a])


@entry
def advance(first, last, setup, state, left_out, record):
    """Integration steps first to last - 1. Returns 0 or the exceeded limit's position plus 1, and the substeps recorded."""
    x, n, floors, inputs = state.x, setup.n, setup.floors, setup.loads.shape[0]
    stations = setup.dampers.size
    residual, work, x_next, ends = np.empty(x.size), np.empty(x.size), np.empty(x.size), np.empty((stations, 2))
    for i in range(first, last):
        integrate(i, setup, state, left_out, residual, work, x_next)
        for j in range(stations):
            ends[j, 0], ends[j, 1] = setup.drive[i, j], setup.drive[i + 1, j]
            for a in range(x.size):
                ends[j, 0] += setup.drifts[j, a] * x[a]
                ends[j, 1] += setup.drifts[j, a] * x_next[a]
        for q in range(1, n + 1):
            done = i * n + q - 1
            share = q / n
            row = record.signals[done]
            for k in range(inputs):
                row[k] = setup.inputs[i, k] + share * (setup.inputs[i + 1, k] - setup.inputs[i, k])
            for f in range(floors.size):
                a = floors[f]
                row[inputs + f] = x[a] + share * (x_next[a] - x[a])
            for j in range(stations):
                x_cmd = ends[j, 0] + share * (ends[j, 1] - ends[j, 0])
                time, own_row = (done + 1) * setup.dt, row[setup.columns[j, 0] : setup.columns[j, 1]]
                broken, value = _substep(j, setup, state, left_out, x_cmd, setup.noise[done, j], time, own_row)
                if broken > 0:
                    record.trip[0], record.trip[1] = j, value
                    record.trip[2], record.trip[3] = setup.limits[j, broken - 1], done + 1
                    return broken, done
        x[:] = x_next
        for f in range(floors.size):
            record.history[i + 1, 0, f] = x[floors[f]]
            record.history[i + 1, 1, f] = state.v[floors[f]]
    return 0, last * n
