"""The Jacobian of a misfit: by differences, and by secant updates between them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
DIFFERENCE = 1e-3  # of the scale of a parameter: wide beside the kinks of friction and backlash
KEPT = 2  # secant steps before the next Jacobian by differences


def differences(misfit: Callable[[Array], Array], z: Array, plain: Array, bounds: Array) -> Array:
    """Jacobian (N, k) of the misfit by forward differences, or by backward differences at an upper bound."""
    columns = []
    for place in range(len(z)):
        size = DIFFERENCE * max(1.0, abs(z[place]))
        size = size if z[place] + size <= bounds[place, 1] else -size
        moved = z.copy()
        moved[place] += size
        columns.append((misfit(moved) - plain) / size)
    return np.column_stack(columns) if columns else np.zeros((len(plain), 0))


class Slopes:
    """Misfit and Jacobian for a search, with secant updates. Source: Broyden (1965), Math. Comp. 19, 577-593."""

    def __init__(self, misfit: Callable[[Array], Array], bounds: Array):
        self._misfit, self._bounds = misfit, bounds
        self._known: dict[bytes, Array] = {}
        self._at: tuple[Array, Array, Array] | None = None
        self._age = 0

    def misfit(self, z: Array) -> Array:
        self._known[z.tobytes()] = found = self._misfit(z)
        return found

    def jacobian(self, z: Array) -> Array:
        plain = self._known.get(z.tobytes())
        plain = self.misfit(z) if plain is None else plain
        self._known = {z.tobytes(): plain}
        if self._at is None or self._age >= KEPT:
            slopes, self._age = differences(self._misfit, z, plain, self._bounds), 0
        else:
            before, value, last = self._at
            step = z - before
            slopes = last + np.outer(plain - value - last @ step, step / max(float(step @ step), 1e-300))
            self._age += 1
        self._at = z.copy(), plain, slopes
        return slopes
