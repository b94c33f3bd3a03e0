"""The reference of a hybrid test: the response of the whole structure, the specimens included, under the recorded excitation.

It exists where the whole structure is linear. It is solved apart from the loop: exactly for an excitation that is linear
between two samples, mode by mode.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import LinAlgError, cholesky, expm

from rths_engine.foundation.arrays import Array
from rths_engine.parts.physics.effect import MATRICES
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.parts.specimens.linear_with_mass import LinearWithMass
from rths_engine.planning.loads import columns
from rths_engine.planning.model import Model

# chosen; see docs/decisions/0023
MOST_DOF = 60
MOST_CONDITION = 1e10  # of the modes: beyond it two of them nearly coincide and rounding spoils the response


def whole(model: Model) -> tuple[Array, Array, Array] | None:
    """M, C and K of the structure with its specimens; None where it is not linear, is too large or has massless parts."""
    plan, built = model.plan, model.built
    if plan.test != "hybrid" or plan.couplings or len(built.members.dofs) or len(built.mass) > MOST_DOF:
        return None
    if any(effect.hook != MATRICES for effect in plan.structure_physics):
        return None
    mass, damping, stiffness = built.mass.copy(), built.damping.copy(), built.stiffness.copy()
    for station, drift in zip(plan.stations, model.drifts, strict=True):
        found = _coefficients(station.specimen)
        if found is None or station.specimen_physics:
            return None
        outer = station.dampers * np.outer(drift, drift)
        for matrix, coefficient in zip((mass, damping, stiffness), found, strict=True):
            matrix += coefficient * outer
    try:
        cholesky(mass)
    except LinAlgError:
        return None
    return mass, damping, stiffness


def _coefficients(specimen: Any) -> tuple[float, float, float] | None:
    """Mass, damping and stiffness of a linear specimen."""
    if isinstance(specimen, LinearWithMass):
        return specimen.mass, specimen.damping, specimen.stiffness
    return (0.0, specimen.damping, specimen.stiffness) if isinstance(specimen, LinearSpecimen) else None


def response(model: Model, inputs: Array, dt: float) -> Array | None:
    """Displacements (samples, n) of the whole structure from rest, at the samples (samples, inputs) every dt (s) after t = 0.

    None where there is no reference. The excitation at t = 0, which no sample records, continues the first two samples.
    """
    matrices = whole(model)
    if matrices is None or len(inputs) < 2:
        return None
    mass, damping, stiffness = matrices
    count, loads = len(mass), model.loads[np.unique(columns(model.plan), return_index=True)[1]]
    rates = np.zeros((2 * count, 2 * count))
    rates[:count, count:] = np.eye(count)
    rates[count:] = -np.linalg.solve(mass, np.hstack([stiffness, damping]))
    forced = np.vstack([np.zeros((count, len(loads))), np.linalg.solve(mass, loads.T)])
    values, modes = np.linalg.eig(rates)
    if not np.linalg.cond(modes) < MOST_CONDITION:
        return None
    from scipy.signal import lfilter

    driven = np.linalg.solve(modes, forced.astype(complex))
    before = np.vstack([2 * inputs[0] - inputs[1], inputs[:-1]])
    found: Array = np.zeros((len(inputs), count))
    for value, mode, drive in zip(values, modes.T, driven, strict=True):
        decay, first, last = _step(complex(value), dt)
        found += np.real(mode[:count] * lfilter([1.0], [1.0, -decay], (first * before + last * inputs) @ drive)[:, None])
    return found


def _step(value: complex, dt: float) -> tuple[complex, complex, complex]:
    """Z' = value z + u over dt, u linear from u0 to u1: z -> decay z + first u0 + last u1."""
    rates = np.zeros((3, 3), dtype=complex)  # of z, u and the increment of u
    rates[0, :2] = value * dt, dt
    rates[1, 2] = 1.0
    decay, held, ramp = expm(rates)[0]
    return complex(decay), complex(held - ramp), complex(ramp)
