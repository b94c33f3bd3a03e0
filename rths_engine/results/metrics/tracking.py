"""Tracking measures of one actuator, equation (10) of Chen and Ricles (2012), EESD 41, 549-569. SI throughout."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array


def maximum_tracking_error(x_cmd: Array, x_meas: Array) -> float:
    """MTE = max |d_c - d_m| (m); 0 for an empty record."""
    return float(np.max(np.abs(x_cmd - x_meas), initial=0.0))


def rms_tracking_error(x_cmd: Array, x_meas: Array) -> float:
    """RMS = sqrt(sum (d_c - d_m)^2 / sum d_c^2) (number); 0 where the command never moved."""
    power = float(np.sum(x_cmd**2))
    return float(np.sqrt(np.sum((x_cmd - x_meas) ** 2) / power)) if power > 0 else 0.0


def tracking_indicator(x_cmd: Array, x_meas: Array) -> Array:
    """TI = 0.5 (A - TA) (m^2) after each sample, from rest (9); positive where the actuator lags."""
    cmd, meas = _from_rest(x_cmd), _from_rest(x_meas)
    area = np.cumsum(0.5 * (cmd[1:] + cmd[:-1]) * np.diff(meas))
    turned = np.cumsum(0.5 * (meas[1:] + meas[:-1]) * np.diff(cmd))
    return 0.5 * (area - turned)


def energy_error(x_cmd: Array, x_meas: Array, f_meas: Array) -> Array:
    """E = 0.5 sum (r[i] + r[i+1]) ((d_m[i] - d_m[i+1]) - (d_c[i] - d_c[i+1])) (J); negative: lag feeds energy in."""
    force = _from_rest(f_meas)
    moved = np.diff(_from_rest(x_cmd)) - np.diff(_from_rest(x_meas))
    return np.cumsum(0.5 * (force[1:] + force[:-1]) * moved)


def signed_peak(signal: Array) -> float:
    """The value of largest magnitude, with its sign; 0 for an empty record."""
    return float(signal[np.argmax(np.abs(signal))]) if len(signal) else 0.0


def _from_rest(signal: Array) -> Array:
    return np.concatenate([[0.0], signal])
