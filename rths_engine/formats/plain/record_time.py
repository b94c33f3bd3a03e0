"""The step of a ground motion in text: of its time column, in s or ms, held against the step in the header."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rths_engine.formats.plain.arranged import off_the_steps
from rths_engine.formats.plain.header_facts import Facts
from rths_engine.formats.plain.headings import name_and_unit
from rths_engine.formats.statement import Statement
from rths_engine.formats.table import Column
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
SHORTEST_STEP, LONGEST_STEP = 0.0005, 0.1  # s: steps of ground motions


@dataclass(frozen=True)
class Step:
    """The step and the time of the first sample (s); None where the file does not state it with certainty."""

    dt: float | None
    start: float = 0.0
    statements: list[Statement] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def step_of(times: Array | None, facts: Facts, line: Callable[[int], int], count: int, column: Column | None = None) -> Step:
    """The step of the samples. Raises FileError for times that are not uniform, and where no unit fits the stated step."""
    if times is None:
        return Step(facts.dt)
    dt = _uniform(times, line)
    written = unit_names.read(column.unit or name_and_unit(column.name)[1]) if column else unit_names.read("")
    if written.dimension == "time":
        factor = written.scale * units.factor(written.unit)
        return Step(_short(dt * factor), _short(times[0] * factor), facts.step_statements(dt * factor))
    if written.problem:
        return Step(facts.dt, notes=[f"the unit of time '{written.text}' is not known"])
    if not column and dt == 1 and times[0] in (0, 1):
        return Step(facts.dt, notes=["the first column counts the samples: it is not time"])
    fitting = [unit for unit in ("s", "ms") if SHORTEST_STEP <= dt * units.factor(unit) <= LONGEST_STEP * (1 + 1e-9)]
    if facts.dt is not None:
        near = min(("s", "ms", "us"), key=lambda unit: abs(np.log(dt * units.factor(unit) / (facts.dt or 1.0))))
        step = dt * units.factor(near)
        stated = facts.step_statements(step if abs(step / facts.dt - 1) < 1 else dt)
        return Step(_short(step), _short(times[0] * units.factor(near)), stated)
    if len(fitting) != 1 or dt == 1:
        return Step(None, notes=[f"the time column increases by {dt:g} in a unit that the file does not state: give the step"])
    factor = units.factor(fitting[0])
    within = f"the only unit within {SHORTEST_STEP:g} to {LONGEST_STEP:g} s"
    note = f"the unit of time is not stated: in {fitting[0]} the step is {dt * factor:g} s, {within}"
    return Step(_short(dt * factor), _short(times[0] * factor), notes=[note])


def _short(value: float) -> float:
    return float(f"{value:.9g}")


def _uniform(times: Array, line: Callable[[int], int]) -> float:
    bad = np.flatnonzero(~np.isfinite(times))
    if len(bad):
        raise FileError(Issue(f"line {line(int(bad[0]))}", "time needs a finite number", str(times[bad[0]])))
    dt = float(f"{np.median(np.diff(times)):.9g}") if len(times) > 1 else 0.0
    if dt > 0:
        dt = float(f"{(times[-1] - times[0]) / round((times[-1] - times[0]) / dt):.9g}")
    off = off_the_steps(times, dt) if dt > 0 else np.zeros(1, dtype=int)
    if len(off):
        at = int(off[0])
        fix = "resample the record to a uniform step; for acceleration only, write one value on each line"
        problem = f"the first column is not a time with a uniform step (about {dt:g} s)"
        raise FileError(Issue(f"line {line(at)}", problem, f"{times[at]:g}", fix))
    return dt
