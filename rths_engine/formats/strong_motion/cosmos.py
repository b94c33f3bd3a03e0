"""COSMOS 1.20, volumes 0, 1 and 2: sections of one channel each, with text, integer, real and comment headers.

The data open with `4096 acceleration pts, approx 41 secs, units=cm/sec2(04),Format=(8F10.5)`. The step of the data is real
header 62 (ms); real header 34 is the step of the raw record. Line 13 of the text states which values mean "unknown".
"""

from __future__ import annotations

from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement
from rths_engine.formats.strong_motion import cosmos_data
from rths_engine.formats.strong_motion.cosmos_header import DATA, FIRST, sections
from rths_engine.formats.strong_motion.orientation import named_once, of_channel, oriented
from rths_engine.formats.table import Column, Table


def looks_like(source: Source) -> bool:
    """Whether the file is a COSMOS file."""
    lines = source.head_lines
    return any(FIRST.search(line) for line in lines[:1]) or any(DATA.match(line) and "units" in line.lower() for line in lines)


def read(source: Source) -> Table:
    """Every block of data as a column. Raises FileError with the line of what does not follow the format."""
    lines = source.lines
    found = sections(lines)
    columns: list[Column] = []
    statements: list[Statement] = []
    for section in found:
        code, _ = section.station
        name = f"{code} {oriented(of_channel([text for _, text in section.text]))}".strip()
        for opening, rows in section.blocks:
            column, said = cosmos_data.block(section, opening, rows, name)
            columns.append(column)
            statements += said
    first = found[0]
    event = " ".join(first.text[1][1].split())[:80] if len(first.text) > 1 else ""
    station = first.station[1]
    about = {"title": ", ".join(part for part in (event, station) if part), "event": event, "station": station}
    header = "\n".join(lines[: first.blocks[0][0][0]])
    return Table("COSMOS", named_once(columns), statements=tuple(statements), header=header, about=about)


FORMAT = Format(
    key="cosmos",
    title="COSMOS V0, V1 and V2",
    of="ground motion",
    extensions=("v0", "v1", "v2", "v0c", "v1c", "v2c"),
    defined="COSMOS Strong Motion Data Format, version 1.20 (2001)",
    header="quantity, unit, step, channel, azimuth, station, event; sensitivity of raw counts",
    compared="number of samples, step, duration, peak, time of the peak, mean, unit, quantity, azimuth",
    looks_like=looks_like,
    read=read,
    public=20,
    public_check="count, step, peak, its time and mean in the files; an independent parse by fixed columns",
)
