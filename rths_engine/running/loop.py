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
from rths_engine.running.pacing import STOPPED, Pacing, await_step, end_step, start


@entry
def advance(
    first: int, last: int, setup: Setup, state: State, left_out: LeftOut | None, record: Record, pacing: Pacing
) -> tuple[int, int]:
    """Integration steps first to last - 1. They run as fast as possible, or paced from `first` = 0 to the end.

    Returns 0, the exceeded limit's position plus 1, or STOPPED where a paced run was asked to stop; and the substeps recorded.
    """
    n, stations, paced = setup.n, setup.dampers.size, pacing.period > 0.0
    residual, work, x_next = np.empty(state.x.size), np.empty(state.x.size), np.empty(state.x.size)
    ends = np.empty((stations, 2))
    if paced:
        start(pacing)
    for i in range(first, last):
        for q in range(1, n + 1):
            done = i * n + q - 1
            if paced:
                await_step(done, pacing)
            if q == 1:
                integrate(i, setup, state, left_out, residual, work, x_next)
                find_ends(i, setup, state, x_next, ends)
            broken = controller_step(i, q, setup, state, left_out, x_next, ends, record)
            if broken > 0:
                return broken, done
            if q == n:
                settle(i, setup, state, x_next, record)
            if paced and end_step(done, pacing):
                return STOPPED, done + 1
    return 0, last * n
