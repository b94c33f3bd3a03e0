"""The measures of one station, inside in SI, shown in the units of their names. None: not defined for this record."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.results.metrics.correlation import correlation_delay
from rths_engine.results.metrics.frequency import Evaluation, frequency_evaluation
from rths_engine.results.metrics.relative import normalised_rms, peak_error
from rths_engine.results.metrics.tracking import (
    energy_error,
    maximum_tracking_error,
    rms_tracking_error,
    signed_peak,
    tracking_indicator,
)


class StationMeasures(NamedTuple):
    """MTE (m), RMS (number), MTI (m^2), MEE (J), stroke (m), force of one damper (N), and those beyond the paper's."""

    mte: float
    rms: float
    mti: float
    mee: float
    stroke: float
    force: float
    frequency: Evaluation | None
    normalised_rms: float | None
    peak_error: float | None
    delay: float | None

    def shown(self, name: str, energy_error_ratio: float | None) -> dict[str, Any]:
        """JSON form; `energy_error_ratio` is the station's HSEE."""
        frequency = self.frequency
        return {
            "name": name,
            "mte_mm": self.mte * 1e3,
            "rms_percent": self.rms * 1e2,
            "mti_mm2": self.mti * 1e6,
            "mee_kNm": self.mee * 1e-3,
            "peak_stroke_mm": self.stroke * 1e3,
            "peak_force_kN": self.force * 1e-3,
            "fei_delay_ms": _times(frequency and frequency.delay, 1e3),
            "fei_amplitude": _times(frequency and frequency.amplitude, 1.0),
            "nrms_percent": _times(self.normalised_rms, 1e2),
            "peak_error_percent": _times(self.peak_error, 1e2),
            "delay_ms": _times(self.delay, 1e3),
            "energy_error_percent": _times(energy_error_ratio, 1e2),
        }


@np.errstate(over="ignore", invalid="ignore")
def station_measures(x_cmd: Array, x_meas: Array, f_meas: Array, dt: float) -> StationMeasures:
    """The measures of a whole record: displacements (m) and force of one damper (N), every `dt` (s)."""
    return StationMeasures(
        mte=maximum_tracking_error(x_cmd, x_meas),
        rms=rms_tracking_error(x_cmd, x_meas),
        mti=signed_peak(tracking_indicator(x_cmd, x_meas)),
        mee=signed_peak(energy_error(x_cmd, x_meas, f_meas)),
        stroke=float(np.max(np.abs(x_meas), initial=0.0)),
        force=float(np.max(np.abs(f_meas), initial=0.0)),
        frequency=frequency_evaluation(x_cmd, x_meas, dt),
        normalised_rms=normalised_rms(x_cmd, x_meas),
        peak_error=peak_error(x_cmd, x_meas),
        delay=correlation_delay(x_cmd, x_meas, dt),
    )


def _times(value: float | None, factor: float) -> float | None:
    return None if value is None or not math.isfinite(value) else value * factor
