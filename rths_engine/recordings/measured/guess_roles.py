"""Roles of columns: from names and units, then from relations between columns."""

from __future__ import annotations

import numpy as np

from rths_engine.formats.table import Column
from rths_engine.recordings.measured import names, relations, words
from rths_engine.recordings.measured.guess_progress import MARK, Progress
from rths_engine.recordings.measured.names import Named
from rths_engine.recordings.measured.roles import RAW, ROLES

# chosen; see docs/decisions/0023
_ALIKE = 0.8  # correlation from which an unnamed column counts as the derivative of another column
_DISSIPATES = 0.4  # share of dissipated energy from which a column counts as the force of a device
_EXACT = 0.999999  # correlation from which columns with different names are one signal
_LINEAR = 0.99  # correlation from which a column of volts is the reading of a calibrated column
_RECORDERS = {"um", "udot", "pr"}  # names beside U in the recorders of OpenFresco and OpenSees


def by_name(progress: Progress) -> None:
    """Take or leave each column by its name, its unit, and the quantity that the format states."""
    for column in progress.unclear():
        said = names.read(column.name if progress.table.named else "", column.unit, column.quantity)
        progress.said[column.name] = said
        if said.aside:
            progress.left[column.name] = said.aside
        elif said.role:
            progress.take(column.name, said.role, _why(said, column))


def of_recorders(progress: Progress) -> None:
    """Take the column U beside Udot, Pr or Um for the command or the displacement of a recorder."""
    spoken = {name: names.bare(name)[0].rpartition(" ")[2] for name in progress.taken}
    beside = _RECORDERS & set(spoken.values())
    for name, word in spoken.items():
        if word == "u" and beside and progress.said[name].written.dimension in ("", "length"):
            role = "x_cmd" if "um" in beside else "x_meas"
            listed = ", ".join(sorted(beside))
            progress.take(name, role, f"{MARK} by its name alone: U beside {listed}, as OpenSees and OpenFresco write it")


def calibrated(progress: Progress) -> None:
    """Leave out a column of volts or counts where a column of the same name holds the calibrated measurement."""
    raw = [name for name, one in progress.taken.items() if progress.said[name].written.dimension in RAW]
    for name in (name for name in raw if progress.taken[name].role != "t"):
        spoken = _without_reading(name)
        for other, one in progress.taken.items():
            written = progress.said[other].written
            same = other != name and ((spoken[0] and _without_reading(other) == spoken) or _reads(progress, name, other))
            if same and written.dimension in ROLES[one.role].dimensions and written.dimension not in RAW:
                progress.left[name] = _reading(progress, name, other)


def _without_reading(name: str) -> tuple[str, int | None]:
    """Words and number of a name, without words such as `raw` and `calibrated`."""
    spoken, number = names.bare(names.stated_unit(name)[1])
    return " ".join(words.OF_READING.sub(" ", spoken).split()), number


def _reads(progress: Progress, name: str, other: str) -> bool:
    """Whether a column of one role is another column of it except for gain, offset and rounding."""
    if progress.taken[name].role != progress.taken[other].role:
        return False
    raw, kept = progress.table.names[name].values, progress.table.names[other].values
    if len(raw) != len(kept) or not (np.isfinite(raw).all() and np.isfinite(kept).all()):
        return False
    return abs(relations.between(raw, kept).correlation) > _EXACT


def lone_numbers(progress: Progress) -> None:
    """Take no number of two digits or more for a station where only one column has it: `LVDT 50` is rather a range."""
    used = [one for name, one in progress.taken.items() if name not in progress.left]
    stations = [one for one in used if ROLES[one.role].counts == "station"]
    for one in stations:
        others = [each for each in stations if each is not one]
        alone = all(each.number is None or (each.role != one.role and each.number != one.number) for each in others)
        if one.number is not None and one.number > names.MOST_COUNTED and alone:
            one.number = None


def of_drive(progress: Progress) -> None:
    """Map a command without unit that equals the drive within its limits to the drive, not to a displacement."""
    commands = [name for name in progress.of("x_cmd") if not progress.taken[name].unit]
    for command, drive in ((a, b) for a in commands for b in progress.of("drive")):
        if relations.limited(progress.table.names[command].values, progress.table.names[drive].values):
            drives = progress.taken[drive]
            progress.take(command, "drive", f"{MARK}: equals column {drive} within its limits: both are the drive")
            progress.taken[command].unit, progress.taken[command].scale = drives.unit, drives.scale
            progress.left[drive] = f"equals column {command} after its limits"
            return


def related(progress: Progress) -> None:
    """Map unnamed columns: a column and its derivative to displacement and velocity, then the column that is their force."""
    unclear = [one for one in progress.unclear() if _changes(one)][:12]
    if progress.step <= 0 or not all(np.isfinite(one.values).all() for one in unclear):
        return
    pairs = [(a, b) for a in unclear for b in unclear if a is not b and len(a.values) == len(b.values)]
    scored = [(relations.of_derivative(a.values, b.values, progress.step), a, b) for a, b in pairs]
    best = max(scored, key=lambda one: abs(one[0].correlation), default=None)
    if best is None or abs(best[0].correlation) < _ALIKE:
        return
    _, x, v = best
    progress.take(x.name, "x_meas", f"{MARK}: its derivative is column {v.name}")
    progress.take(v.name, "v_meas", f"{MARK}: the derivative of column {x.name}")
    others = [one for one in unclear if one.name not in progress.taken and len(one.values) == len(x.values)]
    shares = [abs(relations.dissipated(x.values, one.values)) for one in others]
    if shares and max(shares) > _DISSIPATES:
        force = others[shares.index(max(shares))]
        progress.take(force.name, "f_meas", f"{MARK}: dissipates energy with column {x.name}, like the force of a device")


def lone(progress: Progress) -> None:
    """Map the only column that changes to a displacement where no column is recognised."""
    if any(one.role != "t" for name, one in progress.taken.items() if name not in progress.left):
        return
    changing = [one for one in progress.unclear() if _changes(one)]
    if len(changing) == 1:
        progress.take(changing[0].name, "x_meas", f"{MARK}: its meaning is unknown; proposed as a displacement, check it")


def _why(said: Named, column: Column) -> str:
    unit = said.written.text if said.written.unit else ""
    stated = f"the file's unit {unit}" if column.unit and unit else f"its unit {unit}" if unit else ""
    if said.by_name:
        return f"by its name and {stated}" if stated else f"{MARK} by its name alone"
    return f"by {stated} alone" if stated else f"by its quantity in the format, {column.quantity}"


def _reading(progress: Progress, name: str, other: str) -> str:
    raw, kept = progress.table.names[name].values, progress.table.names[other].values
    unit, own = progress.said[other].written.unit, progress.said[name].written.unit
    if len(raw) == len(kept) and np.isfinite(raw).all() and np.isfinite(kept).all():
        relation = relations.between(raw, kept)
        if abs(relation.correlation) > _LINEAR:
            return f"is the reading in {own} of column {other} (gain {relation.factor:.4g} {unit}/{own}), which is calibrated"
    return f"is in {own}; column {other} of the same name is calibrated in {unit}"


def _changes(column: Column) -> bool:
    return float(np.ptp(column.values[np.isfinite(column.values)])) > 0
