"""The compiled loop of stations that follow given displacements: ramp, compensate, actuate, measure, check, record.

Within a ramp of n controller steps the command of each station goes from its start to its target (8), and every controller step
is that of the loop of a hybrid test.
"""

from __future__ import annotations

from rths_engine.foundation.kernel import entry
from rths_engine.running.controller_step import step_stations


@entry
def follow(first, last, n, start, ends, setup, state, left_out, record):
    """Controller steps first + 1 to last of a ramp of n steps that began at recorded row `start`.

    `ends` (S, 2) are displacements before and after the ramp (m). Returns 0 or the exceeded limit's position plus 1, and the
    number of rows recorded since the start of the test.
    """
    for q in range(first + 1, last + 1):
        broken = step_stations(start + q - 1, q / n, setup, state, left_out, ends, record)
        if broken > 0:
            return broken, start + q - 1
    return 0, start + last
