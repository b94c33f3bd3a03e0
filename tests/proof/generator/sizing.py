"""How far an effect stands out of the noise.

    lambda = min over the baseline's own numbers of sum over frequencies of |y - y_0|^2 / (N S)

y the noise-free output, y_0 that of the baseline, S the spectrum of the output's noise: N_eff times the squared misfit over
sigma^2, with the noise's colour instead of an N_eff. The baseline's numbers are refitted to first order, which holds while the
effect is small. S holds the noise of the displacement as the baseline takes it to the output (`noise.Colour`).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tests.proof.generator.motion import Array
from tests.proof.generator.noise import Colour

Output = Callable[[dict[str, float]], Array]
SHIFT = 1e-3  # of a number, for its derivative


class Absorbed:
    """What the baseline's own numbers can take up of a misfit, by their derivatives."""

    def __init__(self, output: Output, numbers: dict[str, float], noise: Colour) -> None:
        self.noise, self.plain = noise, output(numbers)
        columns = []
        for name, value in numbers.items():
            step = SHIFT * abs(value) if value else 0.0
            if step:
                columns.append(noise.whitened((output({**numbers, name: value + step}) - self.plain) / step))
        rows = np.column_stack(columns)
        self.basis = np.linalg.qr(rows / np.linalg.norm(rows, axis=0))[0]

    def strength(self, signal: Array) -> float:
        """lambda of an output."""
        white = self.noise.whitened(signal - self.plain)
        left = white - self.basis @ (self.basis.T @ white)
        return float(left @ left)


def sized(strength: Callable[[float], float], wanted: float, first: float, most: float) -> float:
    """A size whose lambda is near `wanted`, by lambda ~ size^2; at most `most`."""
    size = first
    for _ in range(3):
        found = strength(size)
        if 0.8 < found / wanted < 1.25:
            break
        size = min(size * min(max(float(np.sqrt(wanted / max(found, 1e-9))), 1 / 30), 5.0), most)
    return size
