"""How far an effect stands out of the noise.

    lambda = min over the baseline's numbers p of  sum over channels and frequencies |y - y_0|^2 / (N S) + sum ((p - p_0) / d)^2

y the noise-free outputs, y_0 those of the baseline, S the spectrum of each output's noise: N_eff times the squared misfit over
sigma^2, with the noise's colour instead of an N_eff. d is how far a planned number may be off, infinite where it is free.
The numbers are refitted to first order, which holds while the effect is small. S holds the noise of the displacement as the
baseline takes it to the output (`noise.Colour`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from tests.proof.generator.motion import Array
from tests.proof.generator.noise import Colour

Outputs = list[Array]
Output = Callable[[dict[str, float]], Outputs]
SHIFT = 1e-3  # of a number, for its derivative


class Absorbed:
    """What the baseline's own numbers can take up of a misfit, by their derivatives. `tolerances` d are shares; none: free."""

    def __init__(
        self, output: Output, numbers: dict[str, float], noises: Sequence[Colour], tolerances: Sequence[float] = ()
    ) -> None:
        self.noises, self.plain = noises, output(numbers)
        moved = {name: value for name, value in numbers.items() if value}
        columns = []
        for name, value in moved.items():
            shifted = output({**numbers, name: value * (1 + SHIFT)})
            columns.append(self._white([(one - plain) / SHIFT for one, plain in zip(shifted, self.plain, strict=True)]))
        self.held = len(tolerances)
        rows = np.column_stack(columns)
        if tolerances:
            rows = np.vstack([rows, np.diag(1 / np.array(tolerances))])
        self.basis = np.linalg.qr(rows / np.linalg.norm(rows, axis=0))[0]

    def _white(self, signals: Outputs) -> Array:
        return np.concatenate([noise.whitened(one) for noise, one in zip(self.noises, signals, strict=True)])

    def strength(self, outputs: Outputs) -> float:
        """lambda of the outputs."""
        white = self._white([one - plain for one, plain in zip(outputs, self.plain, strict=True)])
        white = np.concatenate([white, np.zeros(self.held)])
        left = white - self.basis @ (self.basis.T @ white)
        return float(left @ left)


def sized(strength: Callable[[float], float], wanted: float, first: float, most: float) -> float:
    """A size whose lambda is near `wanted`, by lambda ~ size^2; at most `most`."""
    size = first
    for _ in range(5):
        found = strength(size)
        if 0.8 < found / wanted < 1.25:
            break
        size = min(size * min(max(float(np.sqrt(wanted / max(found, 1e-9))), 1 / 30), 5.0), most)
    return size
