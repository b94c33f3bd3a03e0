"""CR explicit integration."""

from __future__ import annotations

from typing import ClassVar, Literal

from rths_engine.foundation.arrays import Array
from rths_engine.parts.integrators.scheme import Scheme
from rths_engine.parts.integrators.stepping import Stepping


class CrIntegrator(Stepping):
    """CR explicit integration.

    v[i+1] = v[i] + dt beta a[i];  x[i+1] = x[i] + dt v[i] + dt^2 beta a[i];  beta = 4 inv(4 M + 2 dt C + dt^2 K) M   (3)

    Since M a = F - C v - r, beta a solves (M + dt/2 C + dt^2/4 K) beta a = F - C v - r. M is not inverted, so massless degrees
    of freedom are allowed. Explicit, and unconditionally stable for linear elastic systems. K and C include the equivalent
    stiffness and damping of the stations. Second order in x; v[i] is the backward difference (x[i] - x[i-1])/dt, half a step
    behind.
    Not valid when the tangent stiffness exceeds K.
    Source: Chen and Ricles (2008), J. Eng. Mech. 134; equation numbers from Chen and Ricles (2012), EESD 41, 549-569.
    """

    kind: Literal["cr"] = "cr"
    title: ClassVar[str] = "CR (Chen and Ricles)"

    def build(self, mass: Array, damping: Array, stiffness: Array) -> Scheme:
        return Scheme(mass + self.dt / 2 * damping + self.dt**2 / 4 * stiffness)
