"""NRMSE = sqrt(mean (d_c - d_m)^2) / (max d_c - min d_c) and PTE = max |d_c - d_m| / max |d_c|, numbers.

`x_cmd` and `x_meas` (samples), m. Both are None where the command never moved. The RMS of equation (10) divides by the
RMS of the command instead of its range; a long time at rest lowers the NRMSE and does not change the RMS. Riascos, Ou and
Dyke, Hybrid Simulation Current Assessment Measures (2014). Not meaningful where the command hardly moves, because of noise.
"""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array


def normalised_rms(x_cmd: Array, x_meas: Array) -> float | None:
    """Root mean square error over the command's range."""
    span = float(np.ptp(x_cmd)) if len(x_cmd) else 0.0
    return float(np.sqrt(np.mean((x_cmd - x_meas) ** 2))) / span if span > 0 else None


def rms_to(reference: Array, x: Array) -> float | None:
    """sqrt(sum (x - r)^2 / sum r^2) against a reference r; None where it never moved."""
    power = float(np.sum(reference**2))
    return float(np.sqrt(np.sum((x - reference) ** 2) / power)) if power > 0 else None


def peak_error(x_cmd: Array, x_meas: Array) -> float | None:
    """Largest error over the largest command."""
    largest = float(np.max(np.abs(x_cmd), initial=0.0))
    return float(np.max(np.abs(x_cmd - x_meas))) / largest if largest > 0 else None
