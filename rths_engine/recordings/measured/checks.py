"""Checks of a single channel: missing, constant and clipped values."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured import blocks
from rths_engine.recordings.measured.blocks import Extent
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.roles import shown

# chosen; see docs/decisions/0023
LONGEST_RUN = 10  # missing samples in a row that are interpolated; a longer run is an error
LARGEST = 1e30  # SI: computations with larger values can overflow
CLIPPED_RUN = 4  # samples at exactly the extreme
CLIPPED_SAMPLES = 8  # in all runs: fewer samples can come from a coarse resolution at one peak
ABRUPT = 4.0  # of the resolution, over two samples: a smooth peak has smaller steps near its top


def filled(values: Array, extent: Extent, times: Array, channel: str) -> tuple[Array, Extent, list[Finding]]:
    """The values with short runs of missing values interpolated, their extent, and findings about them."""
    if extent.finite:
        return values, extent, []
    bad = ~np.isfinite(values)
    if bad.all():
        return values, extent, [Finding("error", channel, "contains no values", fix="leave the channel out")]
    starts, ends = _runs(bad)
    lengths = ends - starts
    longest = int(np.argmax(lengths))
    at = float(times[starts[longest]])
    value = f"{bad.sum()} of {len(values)} samples, {lengths[longest]} in a row"
    if lengths[longest] > LONGEST_RUN:
        fix = f"cut the file with start or stop, or leave the channel out; up to {LONGEST_RUN} in a row are interpolated"
        return values, extent, [Finding("error", channel, "has missing values (NaN)", value, at, fix)]
    bridged = np.interp(times, times[~bad], values[~bad])
    warning = Finding("warning", channel, "has missing values (NaN); they were interpolated", value, at)
    return bridged, blocks.extent(bridged), [warning]


def too_large(values: Array, extent: Extent, channel: str, unit: str) -> list[Finding]:
    """Findings about values, in the SI `unit`, that are larger than any measurement."""
    largest = max(abs(extent.low), abs(extent.high)) if extent.finite else float(np.nanmax(np.abs(values), initial=0.0))
    if largest < LARGEST:
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


def shape(values: Array, extent: Extent, times: Array, channel: str, unit: str) -> list[Finding]:
    """Findings about a channel, in the SI `unit`, that is constant or clipped at its extremes."""
    if extent.high - extent.low == 0:
        fix = "leave the channel out unless it is meant to be constant"
        return [Finding("warning", channel, "is constant", f"{_text(values[0], unit)} throughout", float(times[0]), fix)]
    held = [(1.0, extent.high, extent.at_high), (-1.0, extent.low, extent.at_low)]
    found = (_clipped(values, times, channel, unit, *one[:2]) for one in held if one[2] >= CLIPPED_SAMPLES)
    return [finding for findings in found for finding in findings]


def _clipped(values: Array, times: Array, channel: str, unit: str, sign: float, level: float) -> list[Finding]:
    """Findings about runs at the extreme value that the signal reaches abruptly. Runs at the start or end can be rest."""
    starts, ends = _runs(blocks.equal(values, level))
    long = [
        (first, last)
        for first, last in zip(starts, ends, strict=True)
        if first > 0 and last < len(values) and last - first >= CLIPPED_RUN
    ]
    if sum(last - first for first, last in long) < CLIPPED_SAMPLES:
        return []
    least = ABRUPT * _resolution(values)
    inside = [(first, last) for first, last in long if sign * (level - values[max(first - 2, 0)]) > least]
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
