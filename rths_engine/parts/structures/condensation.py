"""Static condensation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import PlanError
from rths_engine.parts.structures.modes import MECHANISM


def condensed(stiffness: Array, kept: NDArray[np.int64]) -> Array:
    """K_c = inv(F_kk) with F = inv(K): the stiffness (N/m) of the degrees of freedom `kept`, with no load on the others.

    Exact in a linear run from rest with C = a0 M + a1 K, when mass, ground motion and stations act on the kept degrees of
    freedom only: the others then follow statically, x_s = -inv(K_ss) K_sk x_k. Not valid when a member yields.
    Raises PlanError for a mechanism.
    Source: Guyan (1965), AIAA J. 3, 380; Chopra, Dynamics of Structures, section 9.3.
    """
    try:
        flexibility = cho_solve(cho_factor(stiffness), np.eye(len(stiffness))[:, kept])[kept]
        inverse: Array = np.linalg.inv((flexibility + flexibility.T) / 2)
    except (LinAlgError, np.linalg.LinAlgError):
        raise PlanError(MECHANISM) from None
    return np.asarray((inverse + inverse.T) / 2)
