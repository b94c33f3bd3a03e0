"""The stop operator of hysteresis."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.kernel import entry


@entry
def stop(x, r):
    """Stop operator: y of each x, from -1 to 1, for an elastic slider that follows x and slips at the distance r.

    Source: Brokate and Sprekels (1996), Hysteresis and Phase Transitions, section 2.1.
    """
    held = np.empty_like(x)
    y = 0.0
    for k in range(x.size):
        if k > 0:
            y = min(max(y + x[k] - x[k - 1], -r), r)
        held[k] = y / r
    return held
