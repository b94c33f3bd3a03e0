"""Explicit Newmark integration."""

from __future__ import annotations

from typing import ClassVar, Literal

from rths_engine.foundation.arrays import Array
from rths_engine.parts.integrators.scheme import Scheme
from rths_engine.parts.integrators.stepping import Stepping


class ExplicitNewmark(Stepping):
    """Explicit Newmark integration.

    M a + C v + r = F;  x[i+1] = x[i] + dt v[i] + dt^2/2 a[i];  v[i+1] = v[i] + dt/2 (a[i] + a[i+1])

    beta = 0 and gamma = 1/2. With the velocity at half steps w[i] = v[i] + dt/2 a[i]:
    (M + dt/2 C) a[i] = F[i] - C w[i-1] - r[i], w[i] = w[i-1] + dt a[i], x[i+1] = x[i] + dt w[i].
    The velocity of the loop is w. Second order, no numerical damping; stable while omega dt <= 2 in every mode, so every degree
    of freedom needs mass. The scheme does not use K, so it suits tests whose stiffness is not known before the test.
    Source: Newmark (1959), J. Eng. Mech. Div. 85, 67-94; Mahin and Shing (1985), J. Struct. Eng. 111, 1482-1503.
    """

    kind: Literal["explicit_newmark"] = "explicit_newmark"
    title: ClassVar[str] = "Explicit Newmark"
    stable_up_to: ClassVar[float] = 2.0

    def build(self, mass: Array, damping: Array, stiffness: Array) -> Scheme:
        return Scheme(mass + self.dt / 2 * damping)
