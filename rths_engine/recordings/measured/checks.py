"""What is wrong with one channel on its own: values that are missing, constant or clipped."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.roles import shown

# chosen; see docs/decisions/0023
LONGEST_RUN = 10  # samples that are bridged by interpolation; longer runs refuse the file
LARGEST = 1e30  # SI: beyond it, what is computed from values soon overflows
CLIPPED_RUN = 4  # samples at exactly the extreme
CLIPPED_SAMPLES = 8  # in all runs: fewer may be a coarse reading at one peak
ABRUPT = 4.0  # of the resolution, over two samples: a smooth peak reaches its top in smaller steps


def filled(values: Array, times: Array, channel: str) -> tuple[Array, list[Finding]]:
    """The values with short runs of missing ones bridged, and what was missing."""
    bad = ~np.isfinite(values)
    if not bad.any():
        return values, []
    if bad.all():
        return values, [Finding("error", channel, "holds no value", fix="leave the channel out")]
    starts, ends = _runs(bad)
    lengths = ends - starts
    longest = int(np.argmax(lengths))
    at = float(times[starts[longest]])
    value = f"{bad.sum()} of {len(values)} samples, {lengths[longest]} in a row"
    if lengths[longest] > LONGEST_RUN:
        fix = f"cut the file with start or stop, or leave the channel out; up to {LONGEST_RUN} in a row are bridged"
        return values, [Finding("error", channel, "has missing values (NaN)", value, at, fix)]
    bridged = np.interp(times, times[~bad], values[~bad])
    return bridged, [Finding("warning", channel, "has missing values (NaN); they were bridged by interpolation", value, at)]


def too_large(values: Array, channel: str, unit: str) -> list[Finding]:
    """Whether values, in the SI `unit`, are larger than any measurement."""
    if float(np.nanmax(np.abs(values), initial=0.0)) < LARGEST:
        return []
    return [
        Finding(
            "error",
            channel,
            "comes out larger than any measurement",
            f"above {LARGEST:g} {unit}",
            fix="check its gain and unit",
        )
    ]


def shape(values: Array, times: Array, channel: str, unit: str) -> list[Finding]:
    """Whether the channel, in the SI `unit`, never changes or is cut off at its extremes."""
    if np.ptp(values) == 0:
        fix = "leave the channel out unless it is meant to be constant"
        return [Finding("warning", channel, "is constant", f"{_told(values[0], unit)} throughout", float(times[0]), fix)]
    return [*_clipped(values, times, channel, unit, 1.0), *_clipped(values, times, channel, unit, -1.0)]


def _clipped(values: Array, times: Array, channel: str, unit: str, sign: float) -> list[Finding]:
    """Runs at the very extreme that the signal meets abruptly; those that begin or end the record may be rest."""
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
    value = f"{samples} samples in {len(inside)} run{'s' if len(inside) > 1 else ''} at exactly {_told(level, unit)}"
    problem = f"stays at its {word} value: clipped, saturated, or a held command"
    return [
        Finding("warning", channel, problem, value, float(times[inside[0][0]]), "check the range of the sensor or the drive")
    ]


def _resolution(values: Array) -> float:
    """The smallest difference between two values, rounding left aside."""
    steps = np.diff(np.unique(values))
    told = steps[steps > 1e-9 * np.ptp(values)]
    return float(told.min()) if len(told) else 0.0


def _told(value: float, unit: str) -> str:
    number, name = shown(np.array(value), unit)
    return f"{number:.6g} {name}"


def _runs(flags: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First index of each run of True, and the one after its last."""
    edges = np.diff(np.concatenate([[0], flags.astype(np.int8), [0]]))
    return np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
