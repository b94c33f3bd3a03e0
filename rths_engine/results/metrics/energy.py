"""Input energy E_I(t) = sum_i 0.5 (F[i] + F[i+1]) . (x[i+1] - x[i]) with F = -M iota a_g + p, in J, from ground and forces.

It is -sum (M iota a_g) . v dt relative to the ground (Uang and Bertero 1990, EESD 19, 77-90), by the trapezoidal rule over x,
because v of CR is half a step late. `inputs` (samples, inputs): a_g (m/s^2) and the force on each floor that has one (N);
`floors` (samples, floors): x relative to the ground (m); `loads` (inputs, floors): F by a unit of each input; `start` (floors):
x at t = 0 (m).

The hybrid simulation energy error, as a number: HSEE = n E / max E_I, the energy error E of one damper at its largest magnitude
with its sign, n equal dampers a station; Mosqueda, Stojadinovic and Mahin (2007), J. Struct. Eng. 133, 1140-1148, without the
strain energy that they add to E_I. It is not meaningful at the start, where E_I is almost zero, and in a free vibration.
"""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array


def input_energy(loads: Array, inputs: Array, floors: Array, start: Array, before: Array | None = None) -> Array:
    """E_I (J) after each sample. `before` (1, inputs) are the inputs at `start`; default: those of the first sample."""
    inputs = np.concatenate([inputs[:1] if before is None else before, inputs])
    force = 0.5 * (inputs[1:] + inputs[:-1]) @ loads
    return np.cumsum(np.sum(force * np.diff(floors, axis=0, prepend=start[None, :]), axis=1))


def energy_error_ratio(error: float, dampers: int, largest_input: float | None) -> float | None:
    """HSEE from the energy error of one damper (J) and the largest input energy (J); None without input energy."""
    return dampers * error / largest_input if largest_input is not None and largest_input > 0 else None
