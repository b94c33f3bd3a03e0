"""How the numbers of a block are arranged: one record in lines of several values, columns, or pairs of time and value."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rths_engine.formats.plain.header_facts import Facts
from rths_engine.formats.plain.refusals import other_width
from rths_engine.formats.plain.transposed import even
from rths_engine.foundation.arrays import Array

_MOSTLY = 0.5  # share of equal steps from which a first column is time; chosen, see docs/decisions/0023
_RISING = 16  # steps, all of them positive: no signal of a motion does that; chosen, see docs/decisions/0023
_ALWAYS = 20  # steps: no acceleration increases as often in a row; chosen, see docs/decisions/0023
_UNIFORM = 0.05  # of a step: time stamps often have few digits; chosen, see docs/decisions/0023
_ROWS = 40  # rows of which the steps are compared; chosen, see docs/decisions/0023
_ALIKE = 2.0  # of the mean squares of the steps of one record in order; chosen, see docs/decisions/0023
_MORE = 3.0  # times these is the mean square of a step over a whole row; chosen, see docs/decisions/0023

Row = tuple[int, list[float]]


@dataclass(frozen=True, eq=False)
class Arranged:
    """The signals of a block by name, their times (None: no time column), and the line of a sample.

    `named`: the names are from the file. `note`: what is not clear about the arrangement.
    """

    signals: dict[str, Array]
    times: Array | None
    line: Callable[[int], int]
    named: bool = False
    note: str = ""


def arranged(rows: Sequence[Row], texts: Sequence[str], facts: Facts, single: bool = False) -> Arranged:
    """The signals in the rows; `single`: the header says that they are one signal.

    Where neither header nor numbers decide, every possible arrangement is a signal to choose from.

    Raises FileError for a row with another count of numbers than the others; the last row of a record can be shorter.
    """
    width = Counter(len(row) for _, row in rows[:-1] or rows).most_common(1)[0][0]
    for (at, row), text in zip(rows, texts, strict=True):
        if len(row) != width and (at != rows[-1][0] or len(row) > width):
            raise other_width(at, text, len(row), width, "numbers")
    flat = np.array([number for _, row in rows for number in row])
    in_order = Arranged({"acceleration": flat}, None, lambda k: rows[k // width][0])
    if width == 1:
        return in_order
    if width % 2 == 0 and width > 2 and len(flat) % 2 == 0 and even(flat[::2]):
        return Arranged(
            {"acceleration": flat[1::2]}, flat[::2], lambda k: rows[2 * k // width][0], note="pairs of time and value"
        )
    if len(flat) != width * len(rows):
        return in_order
    table = flat.reshape(-1, width)
    beside = {name: np.ascontiguousarray(table[:, k]) for k, name in enumerate(_names(facts, width) or _numbers(width))}
    few = len(rows) < _RISING and len(flat) in {round(one.value) for one in facts.counts}  # three equal steps can be samples
    if is_time(table[:, 0]) and not few:
        names = _names(facts, width - 1) or _numbers(width)[1:]
        signals = {name: np.ascontiguousarray(table[:, k]) for k, name in enumerate(names, start=1)}
        return Arranged(signals, table[:, 0], lambda k: rows[k][0], bool(_names(facts, width - 1)))
    counts = {round(one.value) for one in facts.counts}
    if facts.dt is not None:
        counts |= {round(one.value / facts.dt) + more for one, _ in facts.durations for more in (0, 1)}
    if len(flat) in counts or facts.width or single:
        return in_order
    if len(rows) in counts or _names(facts, width):
        return Arranged(beside, None, lambda k: rows[k][0], bool(_names(facts, width)))
    if continues(table):
        note = f"one record of {width} values a line: it goes on from line to line as it does within a line"
        return replace(in_order, note=note)
    note = (
        f"the file does not state whether its lines are {width} values of one record in order or {width} columns: "
        "choose the channel, or state the number of samples in the header"
    )
    return Arranged(
        {f"one record, {width} values a line": flat, **beside}, None, lambda k: rows[min(k, len(rows) - 1)][0], note=note
    )


def continues(table: Array) -> bool:
    """Whether the rows are one record in order: steps are alike within and between rows, and its columns change more.

    In columns of signals that resemble one another the steps within a row are other steps than those from row to row.
    """
    if len(table) < _ROWS:
        return False
    within = np.mean(np.diff(table, axis=1) ** 2, axis=0)
    steps = np.append(within, np.mean((table[1:, 0] - table[:-1, -1]) ** 2))
    down = np.mean(np.diff(table, axis=0) ** 2, axis=0)
    return bool(np.max(steps) < _ALIKE * np.min(steps) and np.min(down) > _MORE * np.max(steps))


def off_the_steps(times: Array, dt: float) -> np.ndarray:
    """Indices of the stamps that are not where steps of `dt` put them."""
    return np.flatnonzero(~(np.abs(times - times[0] - np.arange(len(times)) * dt) <= _UNIFORM * abs(dt)))


def _numbers(width: int) -> list[str]:
    return [f"column {k}" for k in range(1, width + 1)]


def _names(facts: Facts, width: int) -> list[str]:
    """Names of components that the header lists, or states the peaks of."""
    listed = [list(facts.components), [one.component for one in facts.peaks if one.component]]
    return next((names for names in listed if len(names) == width == len(set(names))), [])


def is_time(column: Array) -> bool:
    """Whether most steps of a first column are equal and positive, or all are positive: it is time, maybe with a fault."""
    steps = np.diff(column)
    if len(steps) < 2:
        return False
    if len(steps) >= _ALWAYS and (steps > 0).all():
        return True
    if len(steps) >= _RISING and (steps > 0).all():
        return True
    step = float(np.nanmedian(steps)) if np.isfinite(steps).any() else 0.0
    return step > 0 and float(np.mean(np.abs(steps - step) <= _UNIFORM * step + 1e-12 * np.nanmax(np.abs(column)))) > _MOSTLY
