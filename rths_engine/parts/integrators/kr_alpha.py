"""KR-alpha explicit integration."""

from __future__ import annotations

from typing import ClassVar, Literal

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.integrators.scheme import Scheme
from rths_engine.parts.integrators.stepping import Stepping


class KrAlphaIntegrator(Stepping):
    """KR-alpha explicit integration.

    v[i+1] = v[i] + dt alpha_1 a[i];  x[i+1] = x[i] + dt v[i] + (1/2 + gamma) dt^2 alpha_1 a[i]
    M ((1 - alpha_3) a[i] + alpha_3 a[i-1]) = (1 - alpha_f) R[i] + alpha_f R[i-1],  R = F - C v - r

    alpha_1 = inv(M + X) M,  alpha_3 = inv(M + X) (alpha_m M + alpha_f X),  X = gamma dt C + beta dt^2 K
    alpha_m = (2 rho - 1) / (rho + 1),  alpha_f = rho / (rho + 1),  gamma = 1/2 - alpha_m + alpha_f,  beta = (1/2 + gamma)^2 / 4

    rho is the spectral radius at high frequency. rho = 1 has no dissipation and equals CR; rho = 0 removes the highest modes in
    one step. With A = alpha_1 a, and M inv(M + X) X symmetric, the equations become
    D A[i] = (1 - alpha_f) R[i] + alpha_f R[i-1] - E A[i-1], D = (1 - alpha_m) M + (1 - alpha_f) X, E = alpha_m M + alpha_f X,
    so massless degrees of freedom are allowed.
    Explicit, second order, unconditionally stable for linear elastic systems. Not valid when the tangent stiffness exceeds K.
    Source: Kolay and Ricles (2014), EESD 43, 1361-1380.
    """

    kind: Literal["kr_alpha"] = "kr_alpha"
    rho: float = quantity("Spectral radius at high frequency ρ∞", ge=0, le=1, default=0.75, help="1: no dissipation")
    title: ClassVar[str] = "KR-α (Kolay and Ricles)"

    def build(self, mass: Array, damping: Array, stiffness: Array) -> Scheme:
        alpha_m, alpha_f = (2 * self.rho - 1) / (self.rho + 1), self.rho / (self.rho + 1)
        gamma = 0.5 - alpha_m + alpha_f
        beta = (0.5 + gamma) ** 2 / 4
        rest = gamma * self.dt * damping + beta * self.dt**2 * stiffness
        effective = (1 - alpha_m) * mass + (1 - alpha_f) * rest
        return Scheme(effective, alpha_m * mass + alpha_f * rest, alpha_f, gamma - 0.5)
