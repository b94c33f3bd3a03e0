"""One controller step of one station, in pieces: begin, move, react, read, finish.

`begin` checks the command, compensates it (7) and commands the controller. `move`, `react` and `read` are the emulated rig:
actuator (5), specimen, sensors. `finish` records the step and checks the force. A station whose rig is another program or
machine takes `begin` and `finish` with the readings of that rig between them; actuators that share a specimen all `move`
before any of them reacts.

The pieces are compiled into their caller, so that a loop made of them is as fast as a loop that is written in one piece.
"""

from __future__ import annotations

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import compiled, piece
from rths_engine.parts.physics.effect import COMMAND, F_SENSOR, FORCE, HEAT, INPUT, PISTON, SERIES, X_SENSOR
from rths_engine.running.data import (
    ACTUATOR,
    AREA,
    AREA_TURNED,
    COMPENSATOR,
    CONTROLLER,
    ENERGY_ERROR,
    F_MEAS,
    F_TRUE,
    SPECIMEN,
    TI,
    V_TRUE,
    WAVES,
    WIDTH,
    X_CMD,
    X_END,
    X_MEAS,
    X_SENT,
    X_TRUE,
    LeftOut,
    Setup,
    State,
)
from rths_engine.running.dispatch import (
    actuate,
    command,
    compensate,
    energise,
    extend_actuator,
    extend_sensor,
    extend_specimen,
    own,
    resist,
    resisted,
)
from rths_engine.running.oscillation import half_waves

# positions plus 1 of the limits in safety.LIMITS
DISPLACEMENT, VELOCITY, FORCE_LIMIT, OSCILLATION = range(1, 5)


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


@compiled
def _resisted(code, parameters, state, flexibility, u, dt, last):
    return resisted(code, parameters, state, flexibility, u, dt, state.copy(), last)


@piece
def begin(j: int, setup: Setup, state: State, x_cmd: float) -> tuple[int, float, float, float]:
    """Check the command of station j (m), compensate it and command the controller, whose current energises the specimen.

    Returns 0 or the position plus 1 of the exceeded limit and its value, x_comp (m) and the current (A). After an exceeded
    limit nothing has moved, and x_comp and the current are 0.
    """
    memory, limits, dt = state.memory[j], setup.limits[j], setup.dt
    codes, parameters, parts = setup.codes[j], setup.parameters, state.parts
    velocity = (x_cmd - memory[X_CMD]) / dt
    if not _within(x_cmd, limits[0]):
        return DISPLACEMENT, x_cmd, 0.0, 0.0
    if not _within(velocity, limits[1]):
        return VELOCITY, velocity, 0.0, 0.0
    waves = half_waves(memory[WAVES:], velocity, dt)
    if not _within(waves, limits[3]):
        return OSCILLATION, waves, 0.0, 0.0
    adapted = parts[COMPENSATOR, j]
    x_last, x_meas_last, ti = memory[X_CMD], memory[X_MEAS], memory[TI]
    x_comp = compensate(codes[COMPENSATOR], parameters[COMPENSATOR, j], adapted, x_cmd, x_last, x_meas_last, ti, dt)
    current = command(codes[CONTROLLER], parameters[CONTROLLER, j], parts[CONTROLLER, j], x_cmd, velocity, memory[F_MEAS], dt)
    energise(codes[SPECIMEN], parameters[SPECIMEN, j], parts[SPECIMEN, j], current, dt)
    return 0, 0.0, x_comp, current


@piece
def move(j: int, setup: Setup, state: State, left_out: LeftOut | None, x_comp: float, time: float) -> float:
    """The true displacement (m) of station j's actuator under the compensated command (m), with its left-out effects."""
    memory, dt = state.memory[j], setup.dt
    code, parameters, own_state = setup.codes[j, ACTUATOR], setup.parameters[ACTUATOR, j], state.parts[ACTUATOR, j]
    if left_out is None:
        return actuate(code, parameters, own_state, x_comp, memory[F_TRUE])
    effects, force = own(left_out.stations, j), memory[F_TRUE]
    sent = extend_actuator(COMMAND, effects, x_comp, memory[X_TRUE], memory[V_TRUE], force, time, dt)
    x = actuate(code, parameters, own_state, sent, force)
    x = extend_actuator(PISTON, effects, x, sent, (sent - memory[X_SENT]) / dt, force, time, dt)
    memory[X_SENT] = sent
    return x


@piece
def react(j: int, setup: Setup, state: State, left_out: LeftOut | None, x: float, current: float, time: float) -> float:
    """The true force (N) of station j's specimen at the actuator's displacement x (m), with its left-out effects."""
    memory, dt = state.memory[j], setup.dt
    code, parameters, own_state = setup.codes[j, SPECIMEN], setup.parameters[SPECIMEN, j], state.parts[SPECIMEN, j]
    if left_out is None:
        force = resist(code, parameters, own_state, x, dt)
        memory[F_TRUE] = force
        return force
    effects, force = own(left_out.stations, j), memory[F_TRUE]
    v = (x - memory[X_TRUE]) / dt
    u = extend_specimen(INPUT, effects, x, x, v, force, time, dt)
    flexibility = extend_specimen(SERIES, effects, 0.0, x, v, force, time, dt)
    u, force = _resisted(code, parameters, own_state, flexibility, u, dt, force)
    rate = (u - memory[X_END]) / dt
    force = extend_specimen(FORCE, effects, force, u, rate, current, time, dt)
    force = extend_specimen(HEAT, effects, force, u, rate, setup.temperatures[j], time, dt)
    memory[X_TRUE], memory[V_TRUE], memory[X_END], memory[F_TRUE] = x, v, u, force
    return force


@piece
def read(
    j: int, setup: Setup, state: State, left_out: LeftOut | None, x: float, force: float, noise: Array, time: float
) -> tuple[float, float]:
    """The readings (m, N) of the sensors of station j, with their left-out effects and the noise of the step (2)."""
    if left_out is None:
        return x + noise[0], force + noise[1]
    effects, v, dt = own(left_out.stations, j), state.memory[j, V_TRUE], setup.dt
    x_meas = extend_sensor(X_SENSOR, effects, x + noise[0], x, v, x, time, dt)
    f_meas = extend_sensor(F_SENSOR, effects, force + noise[1], x, v, force, time, dt)
    return x_meas, f_meas


@piece
def finish(
    j: int,
    setup: Setup,
    state: State,
    x_cmd: float,
    x_comp: float,
    current: float,
    x_meas: float,
    f_meas: float,
    row: Array,
) -> tuple[int, float]:
    """Track the measured values, record the step in the station's columns of the row, and check the force (N).

    Returns 0 or the position plus 1 of the exceeded limit, and its value.
    """
    memory = state.memory[j]
    track(memory, x_cmd, x_meas, f_meas)
    row = row[setup.columns[j, 0] : setup.columns[j, 1]]
    row[0], row[1], row[2], row[3] = x_cmd, x_comp, x_meas, f_meas
    row[4], row[5], row[6], row[7] = x_cmd - x_meas, memory[TI], state.parts[COMPENSATOR, j][0], memory[ENERGY_ERROR]
    if row.size > WIDTH:
        row[WIDTH] = current
    if not _within(f_meas, setup.limits[j, 2]):
        return FORCE_LIMIT, f_meas
    return 0, 0.0


@piece
def emulated_step(
    j: int, setup: Setup, state: State, left_out: LeftOut | None, x_cmd: float, noise: Array, time: float, row: Array
) -> tuple[int, float]:
    """A whole controller step of station j with its emulated rig; returns as `finish`."""
    broken, value, x_comp, current = begin(j, setup, state, x_cmd)
    if broken > 0:
        return broken, value
    x = move(j, setup, state, left_out, x_comp, time)
    force = react(j, setup, state, left_out, x, current, time)
    x_meas, f_meas = read(j, setup, state, left_out, x, force, noise, time)
    return finish(j, setup, state, x_cmd, x_comp, current, x_meas, f_meas, row)
