"""A proposed mapping: from names and units, then from relations between signals, with the reason and the doubt of each column.

A unit that the file does not state is left empty and asked for, with the unit that would fit. Nothing is taken from magnitudes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from rths_engine.formats.scratch import on_disk
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.measured import guess_roles, guess_time
from rths_engine.recordings.measured.guess_progress import MARK, Progress, Taken
from rths_engine.recordings.measured.guess_units import by_hint, derivative_unit, fitting
from rths_engine.recordings.measured.mapping import LARGEST_NUMBER, MOST_CHANNELS, ColumnMap, Mapping
from rths_engine.recordings.measured.roles import RAW, ROLES, dimension, key

EXCERPT = 1 << 18  # samples by which a large file is guessed; chosen, see docs/decisions/0023
_VOLTS = ("drive", "coil_voltage")  # roles that are volts as they are, without a gain
_WEIGHT = {"kg": "kgf", "t": "tf"}  # the force that a unit of mass stands for on a load cell


@dataclass(frozen=True)
class Guess:
    """A proposed mapping. `reasons` and `left_out` say why each column is used or not; `notes` lists missing statements."""

    mapping: Mapping
    reasons: dict[str, str]
    left_out: dict[str, str]
    notes: tuple[str, ...] = ()

    @property
    def doubtful(self) -> tuple[str, ...]:
        """The columns whose role is a guess from a name or a relation alone: neither a unit nor the format confirms it."""
        return tuple(name for name, why in self.reasons.items() if why.startswith(MARK))


@np.errstate(over="ignore", invalid="ignore")  # columns can contain any number
def guess(table: Table) -> Guess:
    """The proposed mapping of a table. Raises MeasuredError where no column can be a measurement."""
    progress = Progress(_excerpt(table))
    for column in table.columns:
        if not np.isfinite(column.values).any():
            progress.left[column.name] = "contains no values"
    guess_roles.by_name(progress)
    guess_time.choose(progress)
    guess_roles.of_recorders(progress)
    guess_roles.calibrated(progress)
    guess_roles.of_drive(progress)
    guess_roles.related(progress)
    guess_roles.lone(progress)
    guess_roles.lone_numbers(progress)
    for column in progress.unclear():
        problem = progress.said[column.name].written.problem
        progress.left[column.name] = "; ".join(part for part in ("its meaning is unknown", problem) if part)
    channels = _channels(progress)
    if all(channel.role == "t" for channel in channels):
        problem = "no column is recognised as a measurement"
        raise MeasuredError(Issue("file", problem, ", ".join(list(table.names)[:8]), "write a mapping: docs/importing.md"))
    notes = [*table.notes, *progress.notes]
    timed = any(channel.role == "t" for channel in channels)
    asked = any(why == guess_time.SEVERAL for why in progress.left.values())
    if (
        not timed
        and not asked
        and any(not (one.dt or one.time) for one in (table.column(channel.column, "") for channel in channels))
    ):
        notes.append("the file does not state its time step: give dt or rate")
    reasons = {name: one.why for name, one in progress.taken.items() if name not in progress.left}
    return Guess(Mapping(test=_test(channels), channels=tuple(channels)), reasons, progress.left, tuple(notes))


def _excerpt(table: Table) -> Table:
    """The table with the middle of the columns that lie on disk: enough for a guess, however long the file is."""
    return replace(table, columns=tuple(replace(one, values=_middle(one.values)) for one in table.columns))


def _middle(values: Array) -> Array:
    first = len(values) // 2 - EXCERPT // 2
    if not on_disk(values) or first <= 0:
        return values
    middle = np.array(values[first : first + EXCERPT])
    return middle if np.isfinite(middle).any() else values


def _channels(progress: Progress) -> list[ColumnMap]:
    keys: set[str] = set()
    channels: list[ColumnMap] = []
    for column in progress.table.columns:
        one = progress.taken.get(column.name)
        if one is None or column.name in progress.left:
            continue
        if len(channels) == MOST_CHANNELS:
            progress.left[column.name] = f"a recording has at most {MOST_CHANNELS} channels"
            continue
        number = _free(one, keys)
        if number is None and ROLES[one.role].counts == "" and one.role in keys:
            progress.left[column.name] = f"another column is {one.role} already"
            continue
        keys.add(key(one.role, number))
        one.why = "; ".join(part for part in (one.why, _unit(progress, column, one)) if part)
        gain = f"{one.scale:.12g}" if one.scale != 1.0 and one.unit else None
        channels.append(ColumnMap(column=column.name, role=one.role, number=number, unit=one.unit, gain=gain))
    return channels


def _free(one: Taken, keys: set[str]) -> int | None:
    """The number in the name where it is free, else the next free number."""
    if not ROLES[one.role].counts:
        return None
    first = one.number or 1
    numbers = chain(range(first, LARGEST_NUMBER + 1), range(1, first))
    return next(number for number in numbers if key(one.role, number) not in keys)


def _unit(progress: Progress, column: Column, one: Taken) -> str:
    """Complete the unit of a column from the file's other statements, and say what is missing."""
    kind = ROLES[one.role].dimensions[0]
    if one.unit:
        raw = dimension(one.unit) in RAW and one.role not in _VOLTS
        return f"in {one.unit}: give the gain of the transducer, with its units" if raw else ""
    if one.written.problem:
        return f"{one.written.problem}: choose the unit"
    if one.written.dimension == "mass":
        return f"{one.written.unit} is a unit of mass: choose the unit of force, such as {_WEIGHT[one.written.unit]}"
    if one.role == "t":
        return ""  # guess_time has said it
    one.unit, why = by_hint("voltage" if one.role in _VOLTS else kind, progress.table.hints)
    if not one.unit:
        fits = "V would fit, as for most drives" if one.role == "drive" else _derived(progress, column, one)
        fits = fits or fitting(kind, column.values)
        why = f"{why or 'the file states no unit'}: choose it{fits and f'; {fits}'}"
    return why


def _derived(progress: Progress, column: Column, one: Taken) -> str:
    x = next(iter(progress.of("x_meas")), None)
    if one.role != "v_meas" or x is None or progress.seconds <= 0:
        return ""
    unit, values = progress.taken[x].unit, progress.table.names[x].values
    if not unit or dimension(unit) != "length" or len(values) != len(column.values):
        return ""
    found = derivative_unit(values * progress.taken[x].scale, unit, column.values, progress.seconds)
    return f"{found} would fit: it is then the derivative of column {x}" if found else ""


def _test(channels: list[ColumnMap]) -> str | None:
    roles = {channel.role for channel in channels}
    stations = {role for role in roles if ROLES[role].counts == "station"}
    floors = {role for role in roles if ROLES[role].counts == "floor"} | ({"ag"} & roles)
    if floors:
        return "hybrid" if stations else "structure"
    if "f_meas" in roles:
        return "specimen"
    return "actuator" if roles & {"drive", "x_cmd", "x_comp"} else None
