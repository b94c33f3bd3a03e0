"""Standard acceleration file (ASA 2.0) of Mexico: UNAM, CICESE and others; labelled lines, then a column for each channel.

A label has one value for each channel: `ACEL. MAX.(Gal), C1-C6 : /25.6114/58.7394/-42.3377`. The networks removed offsets after
they wrote the header: in 297 public files one peak in twelve differs from the data, by 0.9 % in the median and by 17 % at most.
So a peak within PEAK_WITHIN is accepted with a note that names both numbers; counts under the unit Gal differ by far more.
"""

from __future__ import annotations

import re
from datetime import datetime
from itertools import pairwise

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.statement import COARSE, SAME_STEP, Statement, Written, count, duration
from rths_engine.formats.strong_motion import fortran
from rths_engine.formats.strong_motion.keyed import FIRST_LINES, MISSING, Keyed, instant, numbered, stamp
from rths_engine.formats.strong_motion.units_written import acceleration_unit
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
PEAK_WITHIN = 0.2  # of the peak
_DATA = re.compile(r"^DATOS DE ACELERACION", re.IGNORECASE)
_RULER = re.compile(r"^\s*-{3,}[-+]*\s*$")
_NAMES = re.compile(r"[A-Z]", re.IGNORECASE)
_KEY = r"^{}[^:]*:\s*(/.*)$"
_DAY, _ORIGIN = r"^FECHA DEL SISMO[^:]*:\s*(.*)$", r"^HORA EPICENTRO[^:]*:\s*(.*)$"


def looks_like(source: Source) -> bool:
    """Whether the file is a standard acceleration file."""
    return any(re.match(r"ARCHIVO EST[AÁ]NDAR DE ACELERACI", one, re.IGNORECASE) for one in source.head_lines[:FIRST_LINES])


def read(source: Source) -> Table:
    """Every channel as a column. Raises FileError with the line of what does not follow the format."""
    lines = numbered(source.lines)
    header, rows = _parts(lines)
    channels = int(header.needed(r"^NUMERO DE CANALES\s*:\s*(\d+)", "number of channels").value)
    unit = _unit(header)
    layout = fortran.Columns.written(f"({header.text(r'^FORMATO DATOS[^:]*:(.*)$')})") or fortran.Columns(channels, 10)
    if layout.per_line != channels:
        where = next(header.find(r"^FORMATO DATOS[^:]*:(.*)$"))[0]
        raise FileError(Issue(where, f"states {layout.per_line} columns; the header states {channels} channels"))
    data = fortran.series(rows, layout, MISSING)
    if len(data.values) % channels:
        raise FileError(Issue(f"line {rows[-1][0]}", f"ends without all of {channels} channels", fix="get the file again"))
    values = data.values.reshape(-1, channels)
    steps, rates = _each(header, "INTERVALO DE MUESTREO", channels), _each(header, "VEL. DE MUESTREO", channels)
    if not steps and not rates:
        raise FileError(Issue("header", "states neither an interval nor a sampling rate", fix="get the file again"))
    step = steps[0].value if steps else 1 / rates[0].value
    _check_steps(steps, rates, step)
    statements = [count(int(one.value), len(values), one.where) for one in _each(header, "NUM. TOTAL DE MUESTRAS", channels)]
    statements += [duration(one, len(values), step) for one in _each(header, "DURACION DEL REGISTRO", channels)]
    code = header.text(r"^CLAVE DE LA ESTACION\s*:\s*(\S*)")
    names = [f"{code} {name}".strip() for name in _names(header, channels)]
    said, notes = _peaks(_each(header, "ACEL. MAX.", channels), values, names, unit, data.rounding)
    columns = tuple(
        Column(name, np.ascontiguousarray(values[:, k]), unit, step, quantity="acceleration") for k, name in enumerate(names)
    )
    place = header.text(r"^NOMBRE DE LA ESTACION\s*:\s*(.*)$") or code
    event = f"{header.text(_DAY)} {header.text(_ORIGIN)}".strip()
    about = {
        "title": ", ".join(part for part in (event, place) if part),
        "event": event,
        "station": place,
        "start": stamp(_start(header)),
        "quality": next((line.strip() for _, line in _below(header, "CALIDAD DEL ACELEROGRAMA")), ""),
    }
    return Table(
        "ASA (Mexico)", distinct(columns), notes=notes, statements=(*statements, *said), header=header.shown, about=about
    )


def _parts(lines: list[fortran.Line]) -> tuple[Keyed, list[fortran.Line]]:
    """Header, and the rows below the rulers, names and directions that follow `DATOS DE ACELERACION`."""
    at = next((at for at, line in lines[:FIRST_LINES] if _DATA.match(line)), None)
    if at is None:
        raise FileError(Issue("file", "has no line 'DATOS DE ACELERACION' above its data", fix="get the file again"))
    while at < len(lines) and (not lines[at][1].strip() or _RULER.match(lines[at][1]) or _words(lines[at][1])):
        at += 1
    return Keyed(lines[:at]), lines[at:]


def _words(line: str) -> bool:
    """Whether a line names channels or directions: `CANAL-1 CANAL-2`, `V N00E N90E`, `+V S W`."""
    return any(_NAMES.search(re.sub(r"^[-+.\d]+[eEdD][-+]?\d+$", "", token)) for token in line.split())


def _below(header: Keyed, title: str) -> list[fortran.Line]:
    """The line below a title, where it has words."""
    return [below for (_, line), below in pairwise(header.lines) if line.upper().startswith(title) and below[1].strip()]


def _unit(header: Keyed) -> str:
    stated = header.text(r"^UNIDADES DE LOS DATOS\s*:\s*(.*)$")
    unit = acceleration_unit(stated.split("(")[0]) or acceleration_unit(stated)
    if not unit:
        raise FileError(Issue("header", "states no known unit of acceleration", stated, "write Gal, g or m/s/s"))
    return unit


def _each(header: Keyed, label: str, channels: int) -> list[Written]:
    """The number of each channel from a label; empty where it is not stated. Raises FileError for fewer or more numbers."""
    for where, found in header.find(_KEY.format(re.escape(label))):
        texts = [one.strip() for one in found[1].strip().strip("/").split("/")]
        if not any(texts):
            continue
        try:
            stated = [Written.of(one, where) for one in texts if one]
        except ValueError:
            raise FileError(Issue(where, "needs a number for each channel", found[1].strip(), "correct the header")) from None
        if len(stated) != channels:
            raise FileError(Issue(where, f"has {len(stated)} values; the header states {channels} channels", found[1].strip()))
        return stated
    return []


def _names(header: Keyed, channels: int) -> list[str]:
    """Directions of the channels: `V`, `N00E`."""
    written = header.text(r"^ORIENTACI[OÓ]N C1-C6[^:]*:\s*(/.*)$").strip("/").split("/")
    names = [re.sub(r"[;,]\s*\+?$", "", one.strip()).replace(";", " ").strip() for one in written]
    return names if len(names) == channels and all(names) else [f"C{k}" for k in range(1, channels + 1)]


def _check_steps(steps: list[Written], rates: list[Written], step: float) -> None:
    """Raises FileError where channels have different steps, or interval and rate differ."""
    for one in steps:
        if one.value <= 0 or abs(one.value - step) > SAME_STEP * step:
            problem = f"states a step of {one.value:g} s beside {step:g} s; all channels of a file have one step"
            raise FileError(Issue(one.where, problem, fix="correct the header"))
    rounding = steps[0].within / step if steps else 0.0
    for one in rates:
        if one.value <= 0 or abs(1 / one.value - step) > max(SAME_STEP, min(rounding, COARSE)) * step:
            problem = f"states {one.value:g} samples/s; the interval is {step:g} s, {1 / step:g} samples/s"
            raise FileError(Issue(one.where, problem, fix="correct the header"))


def _peaks(
    stated: list[Written], values: Array, names: list[str], unit: str, rounding: float
) -> tuple[list[Statement], tuple[str, ...]]:
    """The peak of each channel without its sign, and a note for each that differs by more than rounding."""
    statements, notes = [], []
    for k, one in enumerate(stated if len(values) else []):
        read = float(np.max(np.abs(values[:, k])))
        rounded = one.within + rounding + 1e-6 * read
        within = rounded + PEAK_WITHIN * read
        statement = Statement(f"peak of {names[k]}", one.where, abs(one.value), read, unit, within)
        statements.append(statement)
        if rounded < abs(statement.stated - read) <= within:
            notes.append(
                f"{names[k]}: the header states a peak of {abs(one.value):g} {unit}, the data have {read:g} {unit} "
                f"({100 * abs(abs(one.value) / read - 1):.2g} % apart); this network removes offsets after it writes the header"
            )
    return statements, tuple(notes)


def _start(header: Keyed) -> datetime | None:
    day, time = header.text(_DAY), header.text(r"^HORA DE LA PRIMERA MUESTRA[^:]*:\s*(.*)$")
    return instant(f"{day} {time}", "%Y/%m/%d %H:%M:%S", "%Y/%m/%d %H:%M:%S.%f")


FORMAT = Format(
    key="asa",
    title="ASA (UNAM and others, Mexico)",
    of="ground motion",
    extensions=("dat",),
    defined="Archivo estandar de aceleracion 2.0, Instituto de Ingenieria, UNAM",
    header="unit, step, channels, directions, station, event, start (UTC), quality",
    compared="number of samples, duration, rate and interval, channels; peaks within 20 %, with a note beyond rounding",
    looks_like=looks_like,
    read=read,
    public=295,
    public_check="number of samples and peaks in the files; eight more contradict themselves and are refused, one of "
    "them counts named Gal",
)
