"""Checks of a single channel: missing, constant and clipped values."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.roles import shown

# chosen; see docs/decisions/0023
LONGEST_RUN = 10  # missing samples in a row that are interpolated; a longer run is an error
LARGEST = 1e30  # SI: computations with larger values can overflow
CLIPPED_RUN = 4  # samples at exactly the extreme
CLIPPED_SAMPLES = 8  # in all runs: fewer samples can come from a coarse resolution at one peak
ABRUPT = 4.0  # of the resolution, over two samples: a smooth peak has smaller steps near its top


def filled(values: Array, times: Array, channel: str) -> tuple[Array, list[Finding]]:
    """The values with short runs of missing values interpolated, and findings about them."""
    bad = ~np.isfinite(values)
    if not bad.any():
        return values, []
    if bad.all():
        return values, [Finding("error", channel, "contains no values", fix="leave the channel out")]
    starts, ends = _runs(bad)
    lengths = ends - starts
    longest = int(np.argmax(lengths))
    at = float(times[starts[longest]])
    value = f"{bad.sum()} of {len(values)} samples, {lengths[longest]} in a row"
    if lengths[longest] > LONGEST_RUN:
        fix = f"cut the file with start or stop, or leave the channel out; up to {LONGEST_RUN} in a row are interpolated"
        return values, [Finding("error", channel, "has missing values (NaN)", value, at, fix)]
    bridged = np.interp(times, times[~bad], values[~bad])
    return bridged, [Finding("warning", channel, "has missing values (NaN); they were interpolated", value, at)]


def too_large(values: Array, channel: str, unit: str) -> list[Finding]:
    """Findings about values, in the SI `unit`, that are larger than any measurement."""
    if float(np.nanmax(np.abs(values), initial=0.0)) < LARGEST:
        return []
    return [
        Finding(
            "error",
            channel,
            "is larger than any measurement",
            f"above {LARGEST:g} {unit}",
            fix="check its gain and unit",
        )
    ]


def shape(values: Array, times: Array, channel: str, unit: str) -> list[Finding]:
    """Findings about a channel, in the SI `unit`, that is constant or clipped at its extremes."""
    if np.ptp(values) == 0:
        fix = "leave the channel out unless it is meant to be constant"
        return [Finding("warning", channel, "is constant", f"{_text(values[0], unit)} throughout", float(times[0]), fix)]
    return [*_clipped(values, times, channel, unit, 1.0), *_clipped(values, times, channel, unit, -1.0)]


def _clipped(values: Array, times: Array, channel: str, unit: str, sign: float) -> list[Finding]:
    """Findings about runs at the extreme value that the signal reaches abruptly. Runs at the start or end can be rest."""
    level = sign * float(np.max(sign * values))
    starts, ends = _runs(values == level)
    resolution = _resolution(values)
    inside = [
        (first, last)
        for first, last in zip(starts, ends, strict=True)
        if first > 0
        and last < len(values)
        and last - first >= CLIPPED_RUN
        and sign * (level - values[max(first - 2, 0)]) > ABRUPT * resolution
    ]
    samples = sum(last - first for first, last in inside)
    if samples < CLIPPED_SAMPLES:
        return []
    word = "largest" if sign > 0 else "smallest"
    value = f"{samples} samples in {len(inside)} run{'s' if len(inside) > 1 else ''} at exactly {_text(level, unit)}"
    problem = f"stays at its {word} value: it is clipped, saturated or a constant command"
    return [
        Finding("warning", channel, problem, value, float(times[inside[0][0]]), "check the range of the sensor or the drive")
    ]


def _resolution(values: Array) -> float:
    """The smallest difference between two values, except for rounding."""
    steps = np.diff(np.unique(values))
    told = steps[steps > 1e-9 * np.ptp(values)]
    return float(told.min()) if len(told) else 0.0


def _text(value: float, unit: str) -> str:
    number, name = shown(np.array(value), unit)
    return f"{number:.6g} {name}"


def _runs(flags: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First index of each run of True, and the index after its last."""
    edges = np.diff(np.concatenate([[0], flags.astype(np.int8), [0]]))
    return np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
