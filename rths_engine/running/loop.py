"""The compiled loop: integrate, ramp, compensate, actuate, measure, check, record.

Order within step i: from the external and measured forces at step i, the integrator computes x[i+1] and v[i+1], for CR by (3).
The command ramps from L x[i] to L x[i+1] over n substeps (8). Every substep checks the limits, compensates (7), actuates (5),
reads the specimen and the sensors, and updates the tracking indicator (9) and the energy error (10). A test of a specimen or an
actuator alone has no degrees of freedom: its command is the drive.
"""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.kernel import entry
from rths_engine.running.controller_step import controller_step, find_ends, settle
from rths_engine.running.data import LeftOut, Record, Setup, State
from rths_engine.running.integration import integrate


@entry
def advance(first: int, last: int, setup: Setup, state: State, left_out: LeftOut | None, record: Record) -> tuple[int, int]:
    """Integration steps first to last - 1. Returns 0 or the exceeded limit's position plus 1, and the substeps recorded."""
    n, stations = setup.n, setup.dampers.size
    residual, work, x_next = np.empty(state.x.size), np.empty(state.x.size), np.empty(state.x.size)
    ends = np.empty((stations, 2))
    for i in range(first, last):
        integrate(i, setup, state, left_out, residual, work, x_next)
        find_ends(i, setup, state, x_next, ends)
        for q in range(1, n + 1):
            broken = controller_step(i, q, setup, state, left_out, x_next, ends, record)
            if broken > 0:
                return broken, i * n + q - 1
        settle(i, setup, state, x_next, record)
    return 0, last * n
