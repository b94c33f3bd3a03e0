"""One block of data of a COSMOS section: its unit, its step, and what the headers state about it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rths_engine.formats.lines import NUMBER
from rths_engine.formats.statement import Statement, Written, count, duration, peak, peak_time
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.cosmos_header import Section
from rths_engine.formats.strong_motion.orientation import degrees, of_channel
from rths_engine.formats.strong_motion.units_written import unit_named
from rths_engine.formats.table import Column
from rths_engine.foundation.errors import FileError, Issue

# COSMOS 1.20, Tables 1 and 2: codes of integer headers 2 and 3
_QUANTITIES = {1: "acceleration", 2: "velocity", 3: "displacement"}
_UNITS = {
    2: "g", 4: "cm/s^2", 5: "cm/s", 6: "cm", 7: "in/s^2", 8: "in/s", 9: "in", 10: "cm/s^2",
    11: "mg", 12: "micro g", 25: "deg", 24: "deg/s", 23: "deg/s^2", 50: "count", 51: "V", 52: "mV", 60: "psi",
}  # fmt: skip
_MICRO_G = "micro g"
_COUNTS = "count"
_RAW, _UNCORRECTED = 0, 1  # integer header 1
_WHOLE_CIRCLE = 360  # deg, by definition
_MAXIMUM = rf"(?<!Uncor )\bMax\s*=\s*({NUMBER})\s*(\S*?)\s*,?\s*at\s+({NUMBER})\s*sec"
_UNCORRECTED_MAXIMUM = rf"\bUncor max\s*=\s*({NUMBER})\s*(\S*?)\s*,?\s*at\s+({NUMBER})\s*sec"


def block(section: Section, opening: fortran.Line, rows: list[fortran.Line], name: str) -> tuple[Column, list[Statement]]:
    """The column of a block of data, and the statements about it. Raises FileError where the headers contradict each other."""
    at, line = opening
    where = f"line {at}"
    quantity, unit = _quantity(section, line, where), _unit(section, line, where)
    columns = fortran.Columns.written(line)
    if columns is None:
        fix = "it ends in a format such as Format=(8F10.5)"
        raise FileError(Issue(where, "does not state the columns of the data", line.strip(), fix))
    found = fortran.series(rows, columns, () if unit == _COUNTS else section.unknown)
    stated = int(line.split()[0])
    statements = [count(stated, len(found.values), where, name)]
    if not len(found.values) or stated != len(found.values):
        return Column(name, found.values, unit, quantity=quantity), statements
    dt = _step(section)
    _check_azimuth(section)
    if dt is not None:
        statements += [duration(length, stated, dt, name) for length in _lengths(section)]
        if about := re.search(rf"approx\.?\s*({NUMBER})\s*sec", line, re.IGNORECASE):
            statements.append(
                Statement("duration", where, fortran.number(about[1]), stated * dt, "s", 1.0 + dt)
            )  # whole seconds
    own = _QUANTITIES.get(section.integer(2) or 0, quantity) == quantity
    if own or len(section.blocks) == 1:
        statements += _peaks(section, found, unit, dt, name)
    column = Column(name, found.values, unit, dt, quantity=quantity)
    return _scaled(section, column), statements


def _quantity(section: Section, line: str, where: str) -> str:
    words = re.match(r"^\s*\d+\s+(.*?)\s*pts", line, re.IGNORECASE)
    text = words[1].lower() if words else ""
    named = next((one for one in _QUANTITIES.values() if one[:5] in text), "")
    coded = _QUANTITIES.get(section.integer(2) or 0, "")
    if named and coded and named != coded and len(section.blocks) == 1:
        problem = f"integer header 2 states {coded}, the line before the data {named}"
        raise FileError(Issue(where, problem, fix="correct the one that is wrong"))
    return named or coded


def _unit(section: Section, line: str, where: str) -> str:
    """The unit by name and code in the line and by integer header 3. Raises FileError where they differ."""
    written = re.search(r"units\s*=\s*([^(,]*?)\s*(?:\(\s*(\d+)\s*\))?\s*(?:,|Format|$)", line, re.IGNORECASE)
    named = unit_named(written[1]) if written else ""
    code = int(written[2]) if written and written[2] else None
    coded = _UNITS.get(code, "") if code is not None else ""
    stated = section.integer(3)
    if code is not None and stated is not None and code != stated and len(section.blocks) == 1:
        problem = f"states the code of unit {code}, integer header 3 the code {stated}"
        raise FileError(Issue(where, problem, fix="correct the one that is wrong"))
    header = _UNITS.get(section.integer(3) or 0, "") if len(section.blocks) == 1 else ""
    units = {what: unit for what, unit in (("name", named), ("code", coded), ("integer header 3", header)) if unit}
    if len(set(units.values())) > 1:
        listed = ", ".join(f"{what}: {unit}" for what, unit in units.items())
        raise FileError(Issue(where, f"states several units: {listed}", fix="correct the one that is wrong"))
    return next(iter(units.values()), written[1].strip() if written else "")


def _step(section: Section) -> float | None:
    """Step (s) of the data: real header 62 in ms; of a record as it was recorded also real header 34 in s."""
    if (step := section.real(62)) is not None and step.value > 0:
        return float(f"{step.value / 1000:.12g}")
    raw = section.real(34)
    recorded = section.integer(1) in (_RAW, _UNCORRECTED)
    return raw.value if raw is not None and recorded and raw.value > 0 else None


def _lengths(section: Section) -> Iterator[Written]:
    """Durations (s): real header 63; of a record as it was recorded also real header 35 and line 10."""
    recorded = section.integer(1) in (_RAW, _UNCORRECTED)
    for number in (63, 35) if recorded else (63,):
        if (length := section.real(number)) is not None and length.value > 0:
            yield length
    if recorded and (line := section.line(rf"Raw record length\s*=\s*({NUMBER})\s*sec")) is not None:
        yield fortran.stated(line[1][1], line[0])


def _peaks(section: Section, found: fortran.Series, unit: str, dt: float | None, name: str) -> list[Statement]:
    """Peaks, their times and the mean in text and real headers; the peak of raw counts is stated without its sign."""
    statements, signed, rounding = [], unit != _COUNTS, found.rounding
    if (largest := section.real(64)) is not None:
        statements.append(peak(largest, found.values, unit, rounding, name, signed))
    if (time := section.real(65)) is not None and dt is not None and largest is not None:
        statements.append(peak_time(time, found.values, dt, of=name))
    if (mean := section.real(66)) is not None:
        read = float(np.mean(found.values))
        statements.append(Statement(f"mean of {name}", mean.where, mean.value, read, unit, mean.within + rounding))
    recorded = section.integer(1) in (_RAW, _UNCORRECTED)
    for pattern in (_MAXIMUM, _UNCORRECTED_MAXIMUM) if recorded else (_MAXIMUM,):
        line = section.line(pattern)
        without = _COUNTS if pattern == _UNCORRECTED_MAXIMUM else unit  # the unit that is meant where none is written
        if line is None or (unit_named(line[1][2]) if line[1][2] else without) != unit:
            continue
        where, match = line
        statements.append(peak(fortran.stated(match[1], where), found.values, unit, rounding, name, signed))
        if dt is not None:
            statements.append(peak_time(fortran.stated(match[3], where), found.values, dt, of=name))
    return statements


def _check_azimuth(section: Section) -> None:
    """Raises FileError where integer header 54 and the text state different azimuths; 0 and 360 are one direction."""
    coded, named = section.integer(54), degrees(of_channel([text for _, text in section.text]))
    if coded is None or named is None or not 0 <= coded <= _WHOLE_CIRCLE or coded % _WHOLE_CIRCLE == named % _WHOLE_CIRCLE:
        return
    where = f"integer header 54 (from line {section.integers_at})"
    problem = f"states an azimuth of {coded} deg; the text states {named} deg"
    raise FileError(Issue(where, problem, fix="correct the azimuth that is wrong"))


def _scaled(section: Section, column: Column) -> Column:
    """The column in a unit of the table: raw counts become g where their sensitivity is stated."""
    if column.unit == _MICRO_G:
        return replace(column, values=column.values * 1e-6, unit="g", applied="micro g x 1e-6 g")
    bit, sensor, gain = section.real(22), section.real(42), section.real(47)
    if column.unit != _COUNTS or column.quantity != "acceleration" or bit is None or sensor is None:
        return column
    times = gain.value if gain is not None else 1.0
    if min(bit.value, sensor.value, times) <= 0:
        return column
    offset = float(np.mean(column.values))
    scale = bit.value * 1e-6 / (sensor.value * times)
    applied = (
        f"(counts - {offset:.7g}) x {bit.value:g} microvolt / ({sensor.value:g} V/g x gain {times:g}); {offset:.7g} is the mean"
    )
    return replace(column, values=(column.values - offset) * scale, unit="g", applied=applied)
