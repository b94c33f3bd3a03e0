"""The clock of a time column, t_i = t_0 + k_i h: its step, and gaps, jitter and stamps that do not increase."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rths_engine.formats import few_digits
from rths_engine.formats.scratch import on_disk, release
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured.blocks import SHORT, parts
from rths_engine.recordings.measured.finding import Finding

# chosen; see docs/decisions/0023
LONGEST_GAP = 10  # steps that are interpolated; a longer gap is an error
LATEST = 1e12  # s: 30 000 years; dates in seconds are smaller, dates in milliseconds read as seconds are larger
JITTER = 0.02  # of a step: rounding of time stamps is smaller
DRIFT = 0.05  # of a step: largest change of the record's end when the step is rounded
UNEVEN = 0.25  # of a step: a larger deviation is uneven; beyond one half a sample counts as missing
IRREGULAR = 0.1  # share of uneven steps from which the sampling counts as irregular, not as missing samples


@dataclass(frozen=True, eq=False)
class Clock:
    """Time stamps (s) and their step. `uniform`: the stamps equal start + k * step except for rounding."""

    times: Array
    step: float
    uniform: bool

    @property
    def start(self) -> float:
        return float(self.times[0])

    @property
    def end(self) -> float:
        return float(self.times[-1])

    @property
    def last(self) -> float:
        """Time of the last sample: that of its step where the stamps equal start + k * step except for rounding."""
        return self.start + (len(self.times) - 1) * self.step if self.uniform else self.end


def of_step(step: float, count: int, start: float = 0.0) -> Clock:
    """The clock of `count` samples at equal steps (s)."""
    return Clock(start + np.arange(count) * step, step, True)


def shifted(clock: Clock, by: float) -> Clock:
    """The clock with its times moved by `by` (s)."""
    return replace(clock, times=clock.times + by)


def of_stamps(times: Array, channel: str) -> tuple[Clock | None, list[Finding]]:
    """The clock of a time column (s), and findings about it; None in place of a clock that cannot be used."""
    if on_disk(times) and len(times) > 2 and (even := _even(times)) is not None:
        return even, []
    if refused := _refused(times, channel):
        return _of_few_digits(times, channel) or (None, [refused])
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
    if (irregular or off > JITTER) and (recovered := _of_few_digits(times, channel)) is not None:
        return recovered
    longest = int(np.argmax(steps))
    if irregular and steps[longest] > LONGEST_GAP:
        findings.append(_gap(times, steps, longest, channel))
    if irregular or off > JITTER:
        value = f"steps of {1e3 * differences.min():.4g} to {1e3 * differences.max():.4g} ms, median {1e3 * step:.6g} ms"
        problem = "time steps vary; the channels were interpolated to equal steps"
        findings.append(Finding("warning", channel, problem, value, fix="if the time stamps are wrong, give the rate instead"))
    return Clock(times, step, uniform=not irregular and off <= JITTER and not len(missing)), findings


def _of_few_digits(times: Array, channel: str) -> tuple[Clock, list[Finding]] | None:
    """The clock of stamps whose digits do not resolve their equal steps, and a warning; None for other stamps."""
    if on_disk(times) or (found := few_digits.equal_steps(times)) is None:
        return None
    round_rate = 1 / float(f"{1 / found.step:.4g}")
    step = round_rate if found.smallest <= round_rate <= found.largest else _rounded(found.step, len(times) - 1)
    start, unit = few_digits.start(times, step), float(few_digits.last_digit(times)[-1])
    problem = f"has {few_digits.DIGITS} digits, which do not resolve its steps; equal steps were recovered"
    value = f"steps of {1e3 * step:.6g} ms ({1 / step:.6g} Hz); the last stamps are rounded to {1e3 * unit:.4g} ms"
    fix = "if the steps were not equal, write the time with more digits (OpenSees: -precision 16)"
    return of_step(step, len(times), start), [Finding("warning", channel, problem, value, fix=fix)]


def _even(times: Array) -> Clock | None:
    """The clock of stamps that all equal start + k * step except for rounding, by blocks; None for other stamps."""
    count = len(times)
    middle, centre = (count - 1) / 2, float(times[0])
    product = total = 0.0
    for part in parts(count, SHORT):
        index = np.arange(part.start, part.stop) - middle
        product += float(index @ (times[part] - centre))
        total += float(np.sum(times[part] - centre))
        release(times[part])
    slope = product / (count * (count**2 - 1) / 12)  # least squares
    if not (np.isfinite(slope) and slope > 0):
        return None
    step = _rounded(slope, count - 1)
    start = centre + total / count - middle * step
    if not abs(times[-1]) <= LATEST:
        return None
    for part in parts(count):
        off = np.abs(times[part] - start - np.arange(part.start, part.stop) * step)
        if not off.max() <= JITTER * step:
            return None
        release(times[part])
    return Clock(times, step, uniform=True)


def _refused(times: Array, channel: str) -> Finding | None:
    if len(times) < 2:
        return Finding("error", channel, "needs at least two time stamps", str(len(times)))
    bad = np.flatnonzero(~np.isfinite(times))
    if lacks := untimed_rows(times):
        return Finding("error", channel, *lacks, fix="remove these rows from the file")
    if len(bad):
        fix = "correct the stamps, or leave the column out and give dt or rate"
        return Finding("error", channel, f"time stamp {bad[0] + 1} is missing or not a number", fix=fix)
    if np.max(np.abs(times)) > LATEST:
        return Finding("error", channel, "has time stamps out of range", f"beyond {LATEST:g} s", fix="check its unit")
    back = np.flatnonzero(np.diff(times) <= 0)
    if (at := restart(times)) is not None:
        value = f"{times[at - 1]:.10g} s, then {times[at]:.10g} s"
        problem = f"time starts again at sample {at + 1}: a second block of data"
        return Finding("error", channel, problem, value, float(times[at - 1]), "give each block in a file of its own")
    if len(back):
        k = int(back[0])
        value = f"{times[k]:.10g} s, then {times[k + 1]:.10g} s"
        problem = f"time does not increase at sample {k + 2} ({len(back)} such step{'s' if len(back) > 1 else ''})"
        fix = "sort or correct the file"
        if not (np.diff(times) < 0).any():
            fix = "if the stamps are rounded, leave the column out and give dt or rate; else correct the file"
        return Finding("error", channel, problem, value, float(times[k]), fix)
    return None


def untimed_rows(times: Array) -> tuple[str, str] | None:
    """What is said of rows without time below the last stamp, a problem and its value; None where there are none."""
    bad = np.flatnonzero(~np.isfinite(times))
    if not len(bad) or len(bad) == len(times) or bad[0] != len(times) - len(bad):
        return None
    return "rows below the last time have no time: a footer, such as statistics, not samples", f"samples {bad[0] + 1} on"


def restart(times: Array) -> int | None:
    """The index at which time starts again; None where it does not, or goes back by a few steps only."""
    steps = np.diff(times)
    forward = steps[steps > 0]
    if not len(forward):
        return None
    back = np.flatnonzero(steps < -LONGEST_GAP * float(np.median(forward)))
    return int(back[0]) + 1 if len(back) else None


def _gap(times: Array, steps: Array, k: int, channel: str) -> Finding:
    value = f"{times[k + 1] - times[k]:.4g} s, {int(steps[k]) - 1} samples missing"
    if steps[k] > LONGEST_GAP:
        fix = f"cut the file with start or stop; gaps up to {LONGEST_GAP} steps are interpolated"
        return Finding("error", channel, "has a gap too long to interpolate", value, float(times[k]), fix)
    return Finding("warning", channel, "has a gap; it was interpolated", value, float(times[k]))


def _rounded(step: float, count: float) -> float:
    """The step, or a round step or rate that agrees with it over the whole record."""
    for rounded in (1 / float(f"{1 / step:.4g}"), float(f"{step:.4g}"), 1 / float(f"{1 / step:.7g}"), float(f"{step:.7g}")):
        if abs(rounded / step - 1) * count < DRIFT:
            return rounded
    return step
