"""The scheme of an integrator, as the loop executes it."""

from __future__ import annotations

from typing import NamedTuple

from rths_engine.foundation.arrays import Array


class Scheme(NamedTuple):
    """The scheme of an integrator, as the loop executes it.

    D A[i] = (1 - w) R[i] + c[i-1],  c[i] = w R[i] - E A[i],  R = F - C v - r
    v[i+1] = v[i] + dt A[i];  x[i+1] = x[i] + dt v[i+1] + s dt^2 A[i]

    A (m/s^2) is the weighted acceleration. Every explicit integrator here has this form: one solve with D in each step, and no
    inverse of M. The velocity of the loop is (1/2 + s) dt behind the displacement, like a backward difference.
    """

    effective: Array  # D (n, n), kg
    held: Array | None = None  # E (n, n), kg, or None for a scheme that does not use the last step
    weight: float = 0.0  # w
    shift: float = 0.0  # s
