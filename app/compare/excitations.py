"""Whether the items have the same excitation: by their plans, and by the recorded signals where an item has no plan."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from app.compare.items import Item
from app.reports.digits import short
from rths_engine.foundation.arrays import Array
from rths_engine.planning.differences import FieldDifference
from rths_engine.results.channels import CHANNELS, key

OF_PLAN = ("motion", "forces", "start", "drive", "motion_physics")  # fields of a plan that excite the test
SAME = 0.05  # RMS of the difference of two recorded excitations over that of the first: as in recordings.excitation.same
MOVED = ("x_cmd", "x_meas")  # of a test without structure, in this order
NAMED = 3  # items of the largest group that a sentence names
MOST = 200_000  # samples of a signal whose frequency is looked for


def by_plan(rows: Sequence[FieldDifference], labels: Sequence[str]) -> Iterator[str]:
    """The differences of the excitations in the plans: `Drive: Shape: Frequency is 0.25 Hz in Run 1, 0.5 Hz in Run 2`."""
    for row in rows:
        if row.path.split(".")[0] in OF_PLAN:
            yield f"{row.title} is {grouped(row.texts, labels, row.unit)}"


def grouped(texts: Sequence[str], labels: Sequence[str], unit: str = "") -> str:
    """Each text once, with the labels of the items that have it."""
    found: dict[str, list[str]] = {}
    for text, label in zip(texts, labels, strict=True):
        found.setdefault(text, []).append(label)
    most = max(found, key=lambda text: len(found[text]))
    if len(found) > 1 and len(found[most]) > NAMED:
        found[most] = [f"the other {len(found.pop(most))} items"]  # the largest group comes last
    return ", ".join(f"{text} {unit}".rstrip() + f" in {joined(some)}" for text, some in found.items())


def lower(label: str) -> str:
    """A label inside a sentence."""
    return label[:1].lower() + label[1:]


def joined(words: Sequence[str]) -> str:
    """`Run 1, Run 2 and Run 3`."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def by_signals(reference: Item, others: Sequence[Item]) -> Iterator[str]:
    """The differences of recorded excitations to that of the reference, for each pair in which an item has no plan."""
    for other in others:
        if reference.plan is None or other.plan is None:
            yield from _pair(reference, other)


def _pair(first: Item, second: Item) -> Iterator[str]:
    name = _source(first, second)
    if name is None:
        lacking = first if first.plan is None and _exciting(first) is None else second
        yield f"the excitation of {lacking.label} is not known, so it cannot be compared with that of {first.label}"
        return
    what = lower(CHANNELS[name.partition(".")[0]].label)
    time, ours = _samples(first, name)
    other_time, theirs = _samples(second, name)
    common = (time >= other_time[0]) & (time <= other_time[-1]) if len(other_time) else np.zeros(len(time), bool)
    if np.count_nonzero(common) < 2:
        yield f"the samples of {first.label} and {second.label} have no time in common"
        return
    moved = np.interp(time[common], other_time, theirs)
    power = float(np.sqrt(np.mean(ours[common] ** 2)))
    apart = float(np.sqrt(np.mean((ours[common] - moved) ** 2)))
    if apart > SAME * power:
        size = f"by {short(100 * apart / power, 3)} % (RMS of the difference over RMS)" if power else "throughout"
        yield f"the {what} of {second.label} differs from that of {first.label} {size}; {_frequencies(first, second, name)}"


def _source(first: Item, second: Item) -> str | None:
    """The channel that shows the excitation of both: ground acceleration, or the motion of a test without structure."""
    if first.recording.has("ag") and second.recording.has("ag"):
        return "ag"
    if {"hybrid", "structure"} & {first.row.test, second.row.test}:
        return None
    names = (key(role, 1) for role in MOVED)
    return next((name for name in names if first.recording.has(name) and second.recording.has(name)), None)


def _exciting(item: Item) -> str | None:
    names = ("ag",) if item.row.test in ("hybrid", "structure") else ("ag", *(key(role, 1) for role in MOVED))
    return next((name for name in names if item.recording.has(name)), None)


def _samples(item: Item, name: str) -> tuple[Array, Array]:
    values = item.recording.read([name])[name]
    return item.recording.start + np.arange(len(values)) * item.recording.dt, values


def _frequencies(first: Item, second: Item, name: str) -> str:
    ours, theirs = (short(_dominant(_samples(one, name)[1], one.recording.dt), 3) for one in (first, second))
    if ours == theirs:
        return f"the strongest frequency of both is {ours} Hz"
    return f"its strongest frequency is {theirs} Hz, that of {first.label} {ours} Hz"


def _dominant(values: Array, dt: float) -> float:
    """The frequency (Hz) of the largest amplitude."""
    some = values[:MOST] - np.mean(values[:MOST])
    size = np.abs(np.fft.rfft(some))
    return float(np.argmax(size) / (len(some) * dt)) if len(some) > 1 else 0.0
