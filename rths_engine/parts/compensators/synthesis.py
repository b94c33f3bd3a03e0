"""The synthesis of a compensator's gains: settings for which its equations have no solution are refused."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.parts.compensators.compensator import Compensating


@contextmanager
def synthesis(part: Compensating, dt: float) -> Iterator[None]:
    """Raise PlanError where the equations for the gains of `part` have no solution at the controller step `dt` (s)."""
    try:
        with np.errstate(all="ignore"):
            yield
    except (np.linalg.LinAlgError, ValueError, ArithmeticError):
        problem = f"'{part.title}' has no gains for these settings at a controller rate of {1 / dt:g} Hz"
        fix = "bring its bandwidth, delay and model of the actuator closer to the defaults, or raise the controller rate"
        raise PlanError(Issue("compensator", problem, getattr(part, "kind", None), fix)) from None


def finite(values: Array) -> Array:
    """The values. Raises LinAlgError unless all are finite."""
    if not np.isfinite(values).all():
        raise np.linalg.LinAlgError("not finite")
    return values
