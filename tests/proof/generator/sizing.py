"""How far an effect stands out of the noise.

    lambda = min over the baseline's numbers p of  sum over channels and frequencies |y - y_0|^2 / (N S) + sum ((p - p_0) / d)^2

y the noise-free outputs, y_0 those of the baseline, S the spectrum of each output's noise: N_eff times the squared misfit over
sigma^2, with the noise's colour instead of an N_eff. d is how far a planned number may be off, infinite where it is free.
The numbers are refitted by Gauss and Newton with the derivatives at the true numbers, by steps halved where they go too far,
which makes lambda rather too large than too small. S holds the noise of the displacement as the baseline takes it to the
output, and the sum ends at 50 Hz (`noise.Colour`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from tests.proof.generator.motion import Array
from tests.proof.generator.noise import Colour

Outputs = list[Array]
Output = Callable[[dict[str, float]], Outputs]
SHIFT = 1e-3  # of a number, for its derivative
REFITS = 12
HALVED = (1.0, 0.5, 0.25, 0.125)
NEGLIGIBLE = 0.03  # of lambda


class Absorbed:
    """What the baseline's own numbers can take up of a misfit. `tolerances` d are shares of the numbers; none: free."""

    def __init__(
        self, output: Output, numbers: dict[str, float], noises: Sequence[Colour], tolerances: Sequence[float] = ()
    ) -> None:
        self.output, self.noises = output, noises
        self.numbers = {name: value for name, value in numbers.items() if value}
        self.fixed = {name: value for name, value in numbers.items() if not value}
        self.held = 1 / np.array(tolerances) if tolerances else np.zeros(0)
        plain, shifts = self._at(np.zeros(len(self.numbers))), SHIFT * np.eye(len(self.numbers))
        columns = [self._white(self._at(shift), plain) / SHIFT for shift in shifts]
        self.rows = np.vstack([np.column_stack(columns), np.diag(self.held) if tolerances else np.zeros((0, len(columns)))])

    def strength(self, outputs: Outputs) -> float:
        """lambda of the outputs; infinite where they are."""
        shares: Array = np.zeros(len(self.numbers))
        misfit = self._misfit(outputs, shares)
        if not np.isfinite(misfit).all():
            return np.inf
        for _ in range(REFITS):
            step = np.linalg.lstsq(self.rows, misfit, rcond=1e-10)[0]
            best, left = float(misfit @ misfit), misfit - self.rows @ step
            if best - left @ left < NEGLIGIBLE * best:
                break
            nearer = self._nearer(outputs, shares, step, best)
            if nearer is None:
                break
            shares, misfit = nearer
        return float(misfit @ misfit)

    def weakest(self, outputs: Callable[[list[Any]], Outputs], lefts: list[Any]) -> float | None:
        """lambda of what was left out; of several, no more than the weakest alone has. None where nothing was left out."""
        asked = [lefts, *([one] for one in lefts)] if len(lefts) > 1 else [lefts]
        return min(self.strength(outputs(some)) for some in asked) if lefts else None

    def _nearer(self, outputs: Outputs, shares: Array, step: Array, best: float) -> tuple[Array, Array] | None:
        """The first of the step, half of it and so on that takes the squared misfit below `best`, with its misfit."""
        for part in HALVED:
            moved = np.clip(shares + part * step, -0.8, 4.0)
            misfit = self._misfit(outputs, moved)
            if misfit @ misfit < best:
                return moved, misfit
        return None

    def _misfit(self, outputs: Outputs, shares: Array) -> Array:
        return np.concatenate([self._white(outputs, self._at(shares)), -self.held * shares if len(self.held) else []])

    def _at(self, shares: Array) -> Outputs:
        moved = {name: value * (1 + share) for (name, value), share in zip(self.numbers.items(), shares, strict=True)}
        return self.output({**self.fixed, **moved})

    def _white(self, signals: Outputs, plain: Outputs) -> Array:
        return np.concatenate([noise.whitened(one - two) for noise, one, two in zip(self.noises, signals, plain, strict=True)])


def sized(strength: Callable[[float], float], wanted: float, first: float, most: float) -> float:
    """A size whose lambda is near `wanted`, by lambda ~ size^2; at most `most`.

    Where a smaller size makes the generator's equations too stiff to solve (a lag far below a substep), the last size that
    could be solved stays, with a larger lambda than wanted.
    """
    size, solved = first, None
    for _ in range(5):
        found = strength(size)
        if not np.isfinite(found) and solved is not None:
            return solved
        if 0.8 < found / wanted < 1.25:
            break
        solved = size if np.isfinite(found) else None
        size = min(size * min(max(float(np.sqrt(wanted / max(found, 1e-9))), 1 / 30), 5.0), most)
    return size
