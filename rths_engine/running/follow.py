"""The compiled loop of stations that follow given displacements: ramp, compensate, actuate, measure, check, record.

Within a ramp of n controller steps the command of each station goes from its start to its target (8), and every controller step
is that of the loop of a hybrid test.
"""

from __future__ import annotations

from rths_engine.foundation.kernel import entry
from rths_engine.running.loop import _substep


@entry
def follow(first, last, n, start, ends, setup, state, left_out, record):
    """Controller steps first + 1 to last of a ramp of n steps that began at recorded row `start`.

    `ends` (S, 2) are displacements before and after the ramp (m). Returns 0 or the exceeded limit's position plus 1, and the
    number of rows recorded since the start of the test.
    """
    for q in range(first + 1, last + 1):
        done = start + q - 1
        share = q / n
        row = record.signals[done]
        for j in range(ends.shape[0]):
            x_cmd = ends[j, 0] + share * (ends[j, 1] - ends[j, 0])
            time, own_row = (done + 1) * setup.dt, row[setup.columns[j, 0] : setup.columns[j, 1]]
            broken, value = _substep(j, setup, state, left_out, x_cmd, setup.noise[done, j], time, own_row)
            if broken > 0:
                record.trip[0], record.trip[1] = j, value
                record.trip[2], record.trip[3] = setup.limits[j, broken - 1], done + 1
                return broken, done
    return 0, start + last
