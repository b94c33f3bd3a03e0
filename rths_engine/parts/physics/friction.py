"""Functions that several laws of dry friction use."""

from __future__ import annotations

import math

from rths_engine.foundation.kernel import compiled


@compiled
def bristle(z, moved):
    """Bristle deflection z of z' = v - |v| z after a move in one direction, in units of the pre-sliding displacement.

    Source: Dahl (1968), with the exponent 1.
    """
    if moved >= 0.0:
        return 1.0 - (1.0 - z) * math.exp(-moved)
    return (1.0 + z) * math.exp(moved) - 1.0
