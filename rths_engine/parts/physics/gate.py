"""A change in time, continuous in its moment so that a fit can move it."""

from __future__ import annotations

from rths_engine.foundation.kernel import compiled


@compiled
def past(t, moment, dt):
    """Share of the substep that ends at t which lies after `moment`: 0 before, 1 after."""
    return min(max((t - moment) / dt, 0.0), 1.0)
