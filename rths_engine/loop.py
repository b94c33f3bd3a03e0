"""The one compiled loop: integrate, ramp, compensate, actuate, measure, check, record.

Order within integration step i: external force F at step i, W (F - C v - r) gives x[i+1] and v[i+1] (CR, equation 3); the
command ramps from L x[i] to L x[i+1] over n substeps (8); every substep checks the limits, compensates (7), actuates (5),
reads the specimen and the sensors, and updates the tracking indicator (9) and the energy error (10).
"""

from __future__ import annotations

from enum import IntEnum

import numpy as np

from rths_engine import actuators, compensators, specimens
from rths_engine.kernel import compiled, entry, fold

_compensate = fold([part.step for part in compensators.KINDS])
_actuate = fold([part.step for part in actuators.KINDS])
_resist = fold([part.step for part in specimens.KINDS])

# memory of a station between substeps
X_CMD, X_MEAS, X_TRUE, F_TRUE, F_MEAS, AREA, AREA_TURNED, TI, ENERGY_ERROR, MEMORY = range(10)
# columns a station records
STATION_COLUMNS = ("x_cmd", "x_comp", "x_meas", "f_meas", "error", "ti", "d_alpha", "energy_error")
# parts of a station
COMPENSATOR, ACTUATOR, SPECIMEN = range(3)


class Status(IntEnum):
    """What a call of the loop ended with; a trip's code is TRIPPED plus the limit's position in safety.LIMITS."""

    RUNNING = 0
    TRIPPED = 1


@compiled
def _within(value, limit):  # type: ignore[no-untyped-def]
    return abs(value) <= limit


@compiled
def _track(memory, x_cmd, x_meas, f_meas):  # type: ignore[no-untyped-def]
    """Tracking indicator (9) and energy error (10) by the trapezoidal rule; remembers the measured values."""
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
def _substep(j, codes, parameters, states, memory, x_cmd, limits, noise, dt, row):  # type: ignore[no-untyped-def]
    """One controller step of station j. Returns the position of the broken limit plus 1, or 0, and the value."""
    velocity = (x_cmd - memory[X_CMD]) / dt
    if not _within(x_cmd, limits[0]):
        return 1, x_cmd
    if not _within(velocity, limits[1]):
        return 2, velocity
    state = states[COMPENSATOR, j]
    x_comp = _compensate(codes[j, COMPENSATOR], parameters[COMPENSATOR, j], state, x_cmd, memory[X_CMD], memory[TI], dt)
    d_alpha = state[0]
    x_true = _actuate(codes[j, ACTUATOR], parameters[ACTUATOR, j], states[ACTUATOR, j], x_comp, memory[F_TRUE])
    f_true = _resist(codes[j, SPECIMEN], parameters[SPECIMEN, j], states[SPECIMEN, j], x_true, dt)
    memory[X_TRUE] = x_true
    memory[F_TRUE] = f_true
    x_meas = x_true + noise[0]
    f_meas = f_true + noise[1]
    _track(memory, x_cmd, x_meas, f_meas)
    row[0], row[1], row[2], row[3] = x_cmd, x_comp, x_meas, f_meas
    row[4], row[5], row[6], row[7] = x_cmd - x_meas, memory[TI], d_alpha, memory[ENERGY_ERROR]
    if not _within(f_meas, limits[2]):
        return 3, f_meas
    return 0, 0.0


@entry
def advance(first, last, n, dt_step, dt, matrices, influence, ag, drifts, dampers, codes, parameters, states, memory, limits, noise, x, v, history, signals, trip):  # type: ignore[no-untyped-def]
    """Integration steps first to last - 1. Arrays change in place. Returns the status and the substeps recorded so far.

    matrices: C, K, W (3, dof, dof); influence: M @ iota (dof); drifts L (stations, dof); signals (substeps, columns) with columns
    ag, floors, stations; history (steps + 1, 2, dof) holds x and v; trip: station (from 0), value, bound, substep (from 1).
    """
    damping, stiffness, w = matrices[0], matrices[1], matrices[2]
    dof, stations, width = x.size, dampers.size, len(STATION_COLUMNS)
    residual, x_next = np.empty(dof), np.empty(dof)
    for i in range(first, last):
        for a in range(dof):
            total = -influence[a] * ag[i]
            for b in range(dof):
                total -= damping[a, b] * v[b] + stiffness[a, b] * x[b]
            for j in range(stations):
                total -= drifts[j, a] * dampers[j] * memory[j, F_MEAS]
            residual[a] = total
        for a in range(dof):
            accelerated = 0.0
            for b in range(dof):
                accelerated += w[a, b] * residual[b]
            x_next[a] = x[a] + dt_step * v[a] + dt_step * dt_step * accelerated
            v[a] += dt_step * accelerated
        for q in range(1, n + 1):
            done = i * n + q - 1
            share = q / n
            row = signals[done]
            row[0] = ag[i] + share * (ag[i + 1] - ag[i])
            for a in range(dof):
                row[1 + a] = x[a] + share * (x_next[a] - x[a])
            for j in range(stations):
                x_cmd = 0.0
                for a in range(dof):
                    x_cmd += drifts[j, a] * row[1 + a]
                columns = row[1 + dof + j * width : 1 + dof + (j + 1) * width]
                broken, value = _substep(j, codes, parameters, states, memory[j], x_cmd, limits[j], noise[done, j], dt, columns)
                if broken > 0:
                    trip[0], trip[1], trip[2], trip[3] = j, value, limits[j, broken - 1], done + 1
                    return Status.TRIPPED + broken - 1, done
        for a in range(dof):
            x[a] = x_next[a]
            history[i + 1, 0, a] = x[a]
            history[i + 1, 1, a] = v[a]
    return 0, last * n
