"""Functions that measures are made of, one idea a file; `rths_engine.results.measures` is the table of measures."""

from rths_engine.results.metrics.correlation import correlation_delay
from rths_engine.results.metrics.energy import energy_error_ratio, input_energy
from rths_engine.results.metrics.frequency import Evaluation, frequency_evaluation
from rths_engine.results.metrics.relative import normalised_rms, peak_error, rms_to
from rths_engine.results.metrics.tracking import (
    energy_error,
    maximum_tracking_error,
    rms_tracking_error,
    signed_peak,
    tracking_indicator,
)

__all__ = [
    "Evaluation",
    "correlation_delay",
    "energy_error",
    "energy_error_ratio",
    "frequency_evaluation",
    "input_energy",
    "maximum_tracking_error",
    "normalised_rms",
    "peak_error",
    "rms_to",
    "rms_tracking_error",
    "signed_peak",
    "tracking_indicator",
]
