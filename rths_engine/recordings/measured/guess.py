"""A proposed mapping: from names and units, then from relations between signals, last from magnitudes, with the reason."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import chain

import numpy as np

from rths_engine.formats.table import Column, Table
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.measured import names, relations
from rths_engine.recordings.measured.guess_units import Unit, by_hint, by_magnitude, by_partner
from rths_engine.recordings.measured.mapping import LARGEST_NUMBER, MOST_CHANNELS, ColumnMap, Mapping
from rths_engine.recordings.measured.roles import ROLES, dimension, key

# chosen; see docs/decisions/0023
_ALIKE = 0.8  # correlation from which an unnamed column counts as the derivative of another column
_DISSIPATES = 0.4  # share of dissipated energy from which a column counts as the force of a device


@dataclass(frozen=True)
class Guess:
    """A proposed mapping. `reasons` and `left_out` say why each column is used or not; `notes` lists missing statements."""

    mapping: Mapping
    reasons: dict[str, str]
    left_out: dict[str, str]
    notes: tuple[str, ...] = ()


@dataclass
class _Taken:
    role: str
    number: int | None
    unit: str
    why: str


@dataclass
class _Progress:
    table: Table
    taken: dict[str, _Taken] = field(default_factory=dict)
    left: dict[str, str] = field(default_factory=dict)
    step: float = 0.0

    def unclear(self) -> list[Column]:
        return [one for one in self.table.columns if one.name not in self.taken and one.name not in self.left]


@np.errstate(over="ignore", invalid="ignore")  # columns can contain any number
def guess(table: Table) -> Guess:
    """The proposed mapping of a table. Raises MeasuredError where no column can be a measurement."""
    progress = _Progress(table)
    for column in table.columns:
        if not np.isfinite(column.values).any():
            progress.left[column.name] = "contains no values"
    for column in progress.unclear():
        said = names.read(column.name if table.named else "", column.unit)
        if said.role:
            words = "its name" if not column.unit else f"its name and the file's unit {column.unit}"
            progress.taken[column.name] = _Taken(said.role, said.number, said.unit, f"by {words}")
    _one_time(progress)
    _asked(progress)
    _related(progress)
    _lone(progress)
    for column in progress.unclear():
        progress.left[column.name] = "its meaning is unknown"
    channels = _channels(progress)
    if all(channel.role == "t" for channel in channels):
        problem = "no column is recognised as a measurement"
        raise MeasuredError(Issue("file", problem, ", ".join(list(table.names)[:8]), "write a mapping: docs/importing.md"))
    notes = list(table.notes)
    timed = any(channel.role == "t" for channel in channels)
    if not timed and any(table.column(channel.column, "").dt is None for channel in channels):
        notes.append("the file does not state its time step: give dt or rate")
    reasons = {name: one.why for name, one in progress.taken.items() if name not in progress.left}
    return Guess(Mapping(test=_test(channels), channels=tuple(channels)), reasons, progress.left, tuple(notes))


def _one_time(progress: _Progress) -> None:
    """Choose the time column: by name, else the first column that increases by equal steps."""
    called = [name for name, one in progress.taken.items() if one.role == "t"]
    rising = [name for name in called if _rises(progress.table.names[name].values)]
    for name in called:
        if name != (rising or called)[0]:
            progress.left[name] = "a second time column"
    if not called and len(progress.table.columns) > 1:
        found = next((one for one in progress.unclear() if _rises(one.values, equally=True)), None)
        if found is not None:
            progress.taken[found.name] = _Taken("t", None, "", "increases by equal steps")
            called = [found.name]
    if called:
        times = progress.table.names[(rising or called)[0]].values
        steps = np.diff(times[np.isfinite(times)])
        progress.step = float(np.median(steps)) if len(steps) else 0.0
        for column in progress.table.columns:
            if len(column.values) != len(times) and column.dt is None and column.name not in progress.left:
                progress.left[column.name] = f"has {len(column.values)} samples, the time {len(times)}"
    else:
        progress.step = next((one.dt for one in progress.table.columns if one.dt), 0.0)


def _rises(values: Array, equally: bool = False) -> bool:
    steps = np.diff(values)
    if len(steps) < 2 or not np.isfinite(steps).all() or (steps <= 0).any():
        return False
    return not equally or float(np.ptp(steps)) < 0.5 * float(np.median(steps))


def _asked(progress: _Progress) -> None:
    """Map a command without unit that equals the drive within its limits to the drive, not to a displacement."""
    drives = [name for name, one in progress.taken.items() if one.role == "drive"]
    commands = [name for name, one in progress.taken.items() if one.role == "x_cmd" and not one.unit]
    for command, drive in ((a, b) for a in commands for b in drives):
        if relations.limited(progress.table.names[command].values, progress.table.names[drive].values):
            why = f"equals column {drive} within its limits: both are the drive"
            progress.taken[command] = _Taken("drive", None, progress.taken[drive].unit, why)
            progress.left[drive] = f"equals column {command} after its limits"
            return


def _related(progress: _Progress) -> None:
    """Map unnamed columns: a column and its derivative to displacement and velocity, then the column that is their force."""
    unclear = [one for one in progress.unclear() if np.ptp(one.values[np.isfinite(one.values)]) > 0][:12]
    if progress.step <= 0 or not all(np.isfinite(one.values).all() for one in unclear):
        return
    pairs = [(a, b) for a in unclear for b in unclear if a is not b and len(a.values) == len(b.values)]
    scored = [(relations.of_derivative(a.values, b.values, progress.step), a, b) for a, b in pairs]
    best = max(scored, key=lambda one: abs(one[0].correlation), default=None)
    if best is None or abs(best[0].correlation) < _ALIKE:
        return
    _, x, v = best
    progress.taken[x.name] = _Taken("x_meas", None, "", f"its derivative is column {v.name}")
    progress.taken[v.name] = _Taken("v_meas", None, "", f"the derivative of column {x.name}")
    others = [one for one in unclear if one.name not in progress.taken and len(one.values) == len(x.values)]
    shares = [abs(relations.dissipated(x.values, one.values)) for one in others]
    if shares and max(shares) > _DISSIPATES:
        force = others[shares.index(max(shares))]
        why = f"dissipates energy with column {x.name}, like the force of a device"
        progress.taken[force.name] = _Taken("f_meas", None, "", why)


def _lone(progress: _Progress) -> None:
    """Map the first column that changes to a displacement where no column is recognised."""
    if any(one.role != "t" for name, one in progress.taken.items() if name not in progress.left):
        return
    found = next((one for one in progress.unclear() if np.ptp(one.values[np.isfinite(one.values)]) > 0), None)
    if found is not None:
        progress.taken[found.name] = _Taken(
            "x_meas", None, "", "its meaning is unknown: assumed to be a displacement, check it"
        )


def _channels(progress: _Progress) -> list[ColumnMap]:
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
        unit = _unit(progress, column, one)
        one.why = "; ".join(part for part in (one.why, unit.why) if part)
        gain = _placeholder(one, unit.name)
        if gain:
            one.why += f"; in volts: the gain {gain} is a placeholder, give the gain of the transducer"
        channels.append(ColumnMap(column=column.name, role=one.role, number=number, unit=unit.name, gain=gain))
    return channels


def _free(one: _Taken, keys: set[str]) -> int | None:
    """The number in the name where it is free, else the next free number."""
    if not ROLES[one.role].counts:
        return None
    first = one.number or 1
    numbers = chain(range(first, LARGEST_NUMBER + 1), range(1, first))
    return next(number for number in numbers if key(one.role, number) not in keys)


def _unit(progress: _Progress, column: Column, one: _Taken) -> Unit:
    if one.unit:
        return Unit(one.unit, "")
    kind = ROLES[one.role].dimensions[0]
    x = next((name for name, other in progress.taken.items() if other.role == "x_meas"), None)
    if one.role == "v_meas" and x is not None and progress.step > 0:
        x_column = progress.table.names[x]
        said = _unit(progress, x_column, progress.taken[x])
        if not said.by_magnitude and len(x_column.values) == len(column.values):
            found = by_partner(x_column.values, said.name, column.values, progress.step)
            if found is not None:
                return found
    if one.role == "drive":
        why = "its unit is unknown: assumed to be V, as for most drives, check it"
        return by_hint("voltage", progress.table.hints) or Unit("V", why, True)
    return by_hint(kind, progress.table.hints) or by_magnitude(kind, column.values)


def _placeholder(one: _Taken, unit: str) -> str | None:
    kinds = ROLES[one.role].dimensions
    if dimension(unit) in kinds:
        return None
    result = {"length": "mm", "velocity": "mm/s", "acceleration": "g", "force": "kN", "current": "A", "temperature": "degC"}
    return f"1 {result[kinds[0]]}/{unit}"


def _test(channels: list[ColumnMap]) -> str | None:
    roles = {channel.role for channel in channels}
    stations = {role for role in roles if ROLES[role].counts == "station"}
    floors = {role for role in roles if ROLES[role].counts == "floor"} | ({"ag"} & roles)
    if floors:
        return "hybrid" if stations else "structure"
    if "f_meas" in roles:
        return "specimen"
    return "actuator" if roles & {"drive", "x_cmd", "x_comp"} else None
