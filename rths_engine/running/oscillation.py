"""Count the consecutive half waves of a command that oscillates without decay: an unstable loop below the other limits."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.kernel import compiled, entry

# chosen; see docs/decisions/0023
LEAST = 0.02  # m/s, smallest peak of a half wave that counts
LONGEST = 0.2  # s, longest half wave that counts: above 2.5 Hz
DYING = 0.8  # of the largest peak in the row; a lower peak starts a new row

# state: signed peak of the present half wave (m/s), its age (s), largest peak of the row (m/s), half waves in it
PEAK, AGE, LARGEST, COUNT, SIZE = range(5)


@compiled
def half_waves(state, velocity, dt):
    """The length of the row after one more substep at this command velocity (m/s)."""
    if velocity * state[PEAK] < 0.0:
        peak = abs(state[PEAK])
        if peak < LEAST or state[AGE] > LONGEST:
            state[COUNT], state[LARGEST] = 0.0, 0.0
        elif peak < DYING * state[LARGEST]:
            state[COUNT], state[LARGEST] = 1.0, peak
        else:
            state[COUNT], state[LARGEST] = state[COUNT] + 1.0, max(peak, state[LARGEST])
        state[PEAK], state[AGE] = velocity, 0.0
    elif abs(velocity) > abs(state[PEAK]):
        state[PEAK] = velocity
    state[AGE] += dt
    return state[COUNT]


@entry
def longest_rows(velocity, dt):
    """The length of the row after each substep of a command velocity (samples), m/s."""
    state, rows = np.zeros(SIZE), np.empty(velocity.size)
    for q in range(velocity.size):
        rows[q] = half_waves(state, velocity[q], dt)
    return rows
