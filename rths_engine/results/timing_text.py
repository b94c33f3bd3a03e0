"""The timing of a test in real time as text, from its JSON form (`Timing.summary`)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from rths_engine.results.timing import EDGES_US

Timed = Mapping[str, Any]
HEADS = ("Median", "99 %", "99.9 %", "Largest")


def sentence(timing: Timed) -> str:
    """How many steps missed their deadline, at which rate."""
    steps = "1 controller step" if timing["steps"] == 1 else f"{timing['steps']} controller steps"
    period, rate = digits(timing["period_us"]), digits(timing["rate_hz"])
    return f"{timing['missed']} of {steps} missed the deadline of {period} µs ({rate} Hz)."


def worst(timing: Timed) -> str:
    """The step that came closest to its deadline, or overran it the most."""
    step = timing["worst"]
    if step is None:
        return "No controller step was measured."
    began = f"It began {digits(step['delay_us'])} µs after its due time and took {digits(step['length_us'])} µs"
    share = f"{digits(100 * step['share'])} % of its period"
    return f"Worst step: {step['step']}, at {step['time_s']:.3f} s of the test. {began}: {share}."


def late(timing: Timed) -> str:
    """How many steps began late."""
    return f"{timing['late']} began more than a tenth of a period late."


def percentiles(timing: Timed) -> list[tuple[str, list[str]]]:
    """A row for the delay and a row for the length of steps, µs, in the order of HEADS."""
    named = (("Begin after the due time, µs", "delay_us"), ("Length of the work, µs", "length_us"))
    return [(label, [digits(one) for one in timing[key].values()]) for label, key in named]


def verdicts(timing: Timed) -> list[tuple[str, str]]:
    """A row for each rate: whether every step of this test would have met it."""
    return [(f"{one['rate_hz']:g} Hz", _verdict(one, timing["steps"])) for one in timing["verdicts"]]


def buckets(timing: Timed) -> list[tuple[str, int, int]]:
    """The filled part of the histogram: the range of each bucket (µs), and its number of delays and of lengths."""
    counts = list(zip(timing["histogram"]["delay"], timing["histogram"]["length"], strict=True))
    filled = [place for place, pair in enumerate(counts) if any(pair)]
    if not filled:
        return []
    return [(_range(place), *counts[place]) for place in range(filled[0], filled[-1] + 1)]


def rights(timing: Timed) -> list[str]:
    """What the operating system granted and refused, in sentences."""
    granted = timing["granted"]
    said = []
    if granted["priority"] is not None:
        memory = ", with its memory locked" if granted["memory_locked"] else ""
        said.append(f"The loop ran at real-time priority {granted['priority']} (SCHED_FIFO){memory}.")
    if granted["core"] is not None:
        said.append(f"The loop was pinned to core {granted['core']}.")
    if granted["priority_asked"] is None and granted["core_asked"] is None:
        said.append("The loop ran at ordinary priority on any core.")
    return [*said, *granted["refused"]]


def digits(value: float | None) -> str:
    """A number with three significant digits; whole numbers above 1000 keep theirs."""
    if value is None:
        return "–"
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.3g}"


def lines(timing: Timed) -> Iterator[str]:
    """Everything as lines for a terminal."""
    yield f"{sentence(timing)} {late(timing)}"
    yield worst(timing)
    yield f"{'':30}" + "".join(f"{head:>10}" for head in HEADS)
    for label, values in percentiles(timing):
        yield f"{label:30}" + "".join(f"{one:>10}" for one in values)
    yield f"Would have met: {', '.join(f'{rate} {verdict}' for rate, verdict in verdicts(timing))}."
    yield "These counts take each step's own delay alone; the count above also has steps delayed by a missed step before them."
    yield from rights(timing)


def _verdict(one: Mapping[str, Any], steps: int) -> str:
    if not steps:
        return "not measured"
    return "yes" if one["met"] else f"no ({one['missed']} missed)"


def _range(place: int) -> str:
    if place == 0:
        return f"below {EDGES_US[0]}"
    return f"from {EDGES_US[-1]}" if place == len(EDGES_US) else f"{EDGES_US[place - 1]} to {EDGES_US[place]}"
