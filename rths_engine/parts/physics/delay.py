"""Delay of a signal by a fraction of a substep or more; a negative delay extrapolates the signal."""

from __future__ import annotations

import math

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import compiled

HEAD = 2  # places in the state before the ring: index of the newest sample, and 1 after the first substep


def ring(longest: float, dt: float) -> Array:
    """State that stores a signal over `longest` seconds."""
    return np.zeros(HEAD + math.ceil(max(longest, 0.0) / dt) + 2)


@compiled
def delayed(s, length, y, late):
    """Signal y as it was `late` substeps ago, linear between substeps. For late < 0 it is extrapolated along its last slope.

    `length` is the number of samples of the ring in use.
    """
    if s[1] == 0.0:
        s[HEAD : HEAD + length] = y
        s[1] = 1.0
    newest = (int(s[0]) + 1) % length
    s[0] = newest
    s[HEAD + newest] = y
    whole = min(max(math.floor(late), 0), length - 2)
    near = s[HEAD + (newest - whole) % length]
    far = s[HEAD + (newest - whole - 1) % length]
    return near + min(late - whole, 1.0) * (far - near)
