"""t_i = t_0 + k_i h: the step of a column's time stamps, with gaps, jitter and stamps that do not increase."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured.finding import Finding

# chosen; see docs/decisions/0023
LONGEST_GAP = 10  # steps that are bridged by interpolation; longer ones refuse the file
LATEST = 1e12  # s: 30 000 years; dates in seconds are below, in milliseconds taken for seconds beyond
JITTER = 0.02  # of a step: rounding of time stamps stays below
DRIFT = 0.05  # of a step, over the whole record, by which the step is rounded
UNEVEN = 0.25  # of a step: what a step may be late before a sample counts as missing, beyond one half
IRREGULAR = 0.1  # share of steps beyond that from which samples count as irregular, not as missing


@dataclass(frozen=True, eq=False)
class Clock:
    """Time stamps (s) and their step; `uniform`: the stamps are start + k * step up to rounding."""

    times: Array
    step: float
    uniform: bool

    @property
    def start(self) -> float:
        return float(self.times[0])

    @property
    def end(self) -> float:
        return float(self.times[-1])


def of_step(step: float, count: int, start: float = 0.0) -> Clock:
    """The clock of `count` samples at equal steps (s)."""
    return Clock(start + np.arange(count) * step, step, True)


def of_stamps(times: Array, channel: str) -> tuple[Clock | None, list[Finding]]:
    """The clock of a column of time (s), and what is wrong with it; no clock where it can't be used."""
    if refused := _refused(times, channel):
        return None, [refused]
    differences = np.diff(times)
    steps = np.maximum(1, np.rint(differences / np.median(differences) - UNEVEN))
    index = np.concatenate([[0.0], np.cumsum(steps)])
    slope, start = np.polyfit(index, times, 1) if len(times) > 2 else (differences[0], times[0])
    step = _rounded(float(slope), float(index[-1]))
    if step != slope:
        start = float(np.mean(times - index * step))
    off = float(np.max(np.abs(times - start - index * step))) / step
    missing = np.flatnonzero(steps > 1)
    irregular = len(missing) > IRREGULAR * len(steps)
    findings = [] if irregular else [_gap(times, steps, int(k), channel) for k in missing]
    longest = int(np.argmax(steps))
    if irregular and steps[longest] > LONGEST_GAP:
        findings.append(_gap(times, steps, longest, channel))
    if irregular or off > JITTER:
        value = f"steps of {1e3 * differences.min():.4g} to {1e3 * differences.max():.4g} ms, {1e3 * step:.6g} ms in the middle"
        problem = "time steps vary; the channels were interpolated to equal steps"
        findings.append(Finding("warning", channel, problem, value, fix="give the rate instead where the stamps are at fault"))
    return Clock(times, step, uniform=not irregular and off <= JITTER and not len(missing)), findings


def _refused(times: Array, channel: str) -> Finding | None:
    if len(times) < 2:
        return Finding("error", channel, "needs at least two time stamps", str(len(times)))
    bad = np.flatnonzero(~np.isfinite(times))
    if len(bad):
        fix = "mend the stamps, or leave the column out and give dt or rate"
        return Finding("error", channel, f"time stamp {bad[0] + 1} is missing or no number", fix=fix)
    if np.max(np.abs(times)) > LATEST:
        return Finding("error", channel, "holds time stamps out of all measure", f"beyond {LATEST:g} s", fix="check its unit")
    back = np.flatnonzero(np.diff(times) <= 0)
    if len(back):
        k = int(back[0])
        value = f"{times[k]:.10g} s, then {times[k + 1]:.10g} s"
        problem = f"time does not increase at sample {k + 2} ({len(back)} such step{'s' if len(back) > 1 else ''})"
        fix = "sort or mend the file; where stamps are rounded, leave the column out and give dt or rate"
        return Finding("error", channel, problem, value, float(times[k]), fix)
    return None


def _gap(times: Array, steps: Array, k: int, channel: str) -> Finding:
    value = f"{times[k + 1] - times[k]:.4g} s, {int(steps[k]) - 1} samples missing"
    if steps[k] > LONGEST_GAP:
        fix = f"cut the file with start or stop; gaps up to {LONGEST_GAP} steps are bridged"
        return Finding("error", channel, "has a gap too long to bridge", value, float(times[k]), fix)
    return Finding("warning", channel, "has a gap; it was bridged by interpolation", value, float(times[k]))


def _rounded(step: float, count: float) -> float:
    """The step, or the round step or rate that can't be told from it over the record."""
    for rounded in (1 / float(f"{1 / step:.4g}"), float(f"{step:.4g}"), 1 / float(f"{1 / step:.7g}"), float(f"{step:.7g}")):
        if abs(rounded / step - 1) * count < DRIFT:
            return rounded
    return step
