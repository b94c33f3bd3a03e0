"""Elastomeric damper as a Maxwell chain."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field, model_validator

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity

BranchStiffness = Annotated[float, Field(gt=0, le=1e12)]
RelaxationTime = Annotated[float, Field(gt=0, le=1e4)]


class Elastomeric(Part):
    """Elastomeric damper as a Maxwell chain.

    f = k x + sum of f_i,  f_i' = k_i v - f_i / tau_i   (generalised Maxwell model, 1 to 4 branches)

    At frequency omega: storage stiffness k + sum k_i (omega tau_i)^2 / (1 + (omega tau_i)^2), loss stiffness
    sum k_i omega tau_i / (1 + (omega tau_i)^2). A cycle dissipates pi X^2 times the loss stiffness. Exact for a displacement
    that is linear between substeps: f_i[q] = e_i f_i[q-1] + k_i (tau_i / dt) (1 - e_i) (x[q] - x[q-1]), e_i = exp(-dt / tau_i).
    x (m), f (N). State: s[0] last displacement (m), s[1 to 4] branch forces (N).
    Not valid at large strain, where the rubber softens with amplitude (Payne effect) and with temperature.
    Source: Christensen (1982), "Theory of Viscoelasticity", 2nd ed., Academic Press.
    """

    kind: Literal["elastomeric"] = "elastomeric"
    stiffness: float = quantity("Long-term stiffness k", "N/m", "kN/m", ge=0, le=1e12, default=5.0e6)
    branch_stiffnesses: tuple[BranchStiffness, ...] = quantity(
        "Branch stiffnesses kᵢ", "N/m", "kN/m", min_length=1, max_length=4, default=(8.0e6, 4.0e6)
    )
    relaxation_times: tuple[RelaxationTime, ...] = quantity(
        "Relaxation times τᵢ", "s", min_length=1, max_length=4, default=(0.05, 0.5), help="one time for each branch"
    )
    title: ClassVar[str] = "Elastomeric (Maxwell chain)"

    @model_validator(mode="after")
    def _paired(self) -> Elastomeric:
        stiffnesses, times = len(self.branch_stiffnesses), len(self.relaxation_times)
        if stiffnesses != times:
            raise ValueError(f"has {stiffnesses} branch stiffnesses and {times} relaxation times: give both for each branch")
        return self

    def build(self, dt: float) -> tuple[Array, Array]:
        ratio = dt / np.array(self.relaxation_times)
        decay, gain = np.exp(-ratio), -np.expm1(-ratio) / ratio * np.array(self.branch_stiffnesses)
        return np.array([self.stiffness, len(ratio), *np.column_stack([decay, gain]).ravel()]), np.zeros(5)

    @staticmethod
    def step(p, s, x, dt):
        move = x - s[0]
        s[0] = x
        force = p[0] * x
        for i in range(int(p[1])):
            s[1 + i] = p[2 + 2 * i] * s[1 + i] + p[3 + 2 * i] * move
            force += s[1 + i]
        return force
