"""A change at one moment, continuous in the moment, so that a fit can move the moment."""

from __future__ import annotations

from rths_engine.foundation.kernel import compiled


@compiled
def past(t, moment, dt):
    """Share, 0 to 1, of the substep ending at t that lies after `moment`."""
    return min(max((t - moment) / dt, 0.0), 1.0)
