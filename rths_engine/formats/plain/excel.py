"""Spreadsheets (Excel, OpenDocument): each sheet is read by the rules of text in columns; the errors name sheet and row."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Sequence
from dataclasses import replace
from datetime import date, datetime, time, timedelta
from typing import Any

import numpy as np

from rths_engine.formats import damage
from rths_engine.formats.expansion import Expansion
from rths_engine.formats.format import Format
from rths_engine.formats.plain import columns
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table, distinct, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_OLE, _ZIP = b"\xd0\xcf\x11\xe0", b"PK\x03\x04"
_BOOK = "Workbook".encode("utf-16-le")
_PARTS = {"xl/workbook.xml", "xl/workbook.bin"}
_OPEN_DOCUMENT = b"application/vnd.oasis.opendocument.spreadsheet"
# chosen; see docs/decisions/0023
_SHORTEST = 0.01  # s
_SURE = 1.0  # s: steps that stay equal for so long, to the millisecond, are right within 0.1 %
_EQUAL = 1e-4  # s
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def looks_like(source: Source) -> bool:
    """Whether the content is a workbook; an archive or an Office document of another kind is none."""
    if source.head.startswith(_OLE):
        return source.extension == "xls" or _BOOK in source.bytes()
    if not source.head.startswith(_ZIP):
        return False
    try:
        with zipfile.ZipFile(io.BytesIO(source.bytes())) as archive:
            return not _PARTS.isdisjoint(archive.namelist()) or _OPEN_DOCUMENT in source.head
    except zipfile.BadZipFile:
        return source.extension in ("xlsx", "xlsm", "xlsb", "ods")


def read(source: Source) -> Table:
    """Read the sheets that contain rows of numbers. Raises FileError with sheet and row where none of them can be read."""
    from python_calamine import CalamineWorkbook, SheetVisibleEnum

    found: list[tuple[str, Table]] = []
    notes: list[str] = []
    refused: list[Issue] = []
    with damage.refused("a spreadsheet", "save it again as .xlsx, or as CSV"):
        _refuse_expansion(source.bytes())
        book = CalamineWorkbook.from_filelike(io.BytesIO(source.bytes()))
        for about in book.sheets_metadata:
            sheet = book.get_sheet_by_name(about.name)
            refuse_many(sheet.height * sheet.width)
            if about.visible != SheetVisibleEnum.Visible:
                notes.append(f"sheet {about.name} is hidden: left out")
                continue
            rows = sheet.to_python(skip_empty_area=False)
            if not _has_numbers(rows):
                notes.append(f"sheet {about.name} contains no rows of numbers")
                continue
            try:
                found.append((about.name, _table(about.name, rows)))
            except FileError as refusal:
                refused += refusal.issues
    if not found:
        raise FileError(
            refused or [Issue("file", "contains no sheet with rows of numbers", fix="export the signals as columns")]
        )
    notes += [f"left out: {issue.where} {issue.problem}" for issue in refused]
    several = len(found) > 1
    named = distinct(
        [replace(one, name=f"{sheet}/{one.name}" if several else one.name) for sheet, table in found for one in table.columns]
    )
    notes += [f"sheet {sheet}: {note}" if several else note for sheet, table in found for note in table.notes]
    statements = tuple(one for _, table in found for one in table.statements)
    header = "\n\n".join(f"{sheet}\n{table.header}" for sheet, table in found)
    return Table(
        "spreadsheet",
        _timed(named, [table for _, table in found]),
        all(table.named for _, table in found),
        {},
        tuple(notes),
        statements,
        header,
    )


def _refuse_expansion(raw: bytes) -> None:
    """Raise FileError for a packed workbook whose parts declare too much."""
    if raw.startswith(_ZIP):
        expansion = Expansion(len(raw))
        with zipfile.ZipFile(io.BytesIO(raw)) as archive:
            for part in archive.infolist():
                expansion.node()
                expansion.add(part.file_size)


def _timed(named: Sequence[Column], sheets: Sequence[Table]) -> tuple[Column, ...]:
    """The columns, each with the time of its sheet where the file has several different times: the nearest to its left."""
    clocks = [one.values for table in sheets for one in table.columns if one.quantity == "time"]
    if all(np.array_equal(clocks[0], one) for one in clocks[1:]):
        return tuple(replace(one, time="") for one in named)
    result: list[Column] = []
    for table in sheets:
        own = named[len(result) : len(result) + len(table.columns)]
        times = [k for k, one in enumerate(table.columns) if one.quantity == "time"]
        names = [one.name for one in table.columns]
        for k, column in enumerate(own):
            given = table.columns[k].time
            nearest = names.index(given) if given else max((at for at in times if at < k), default=times[0] if times else k)
            result.append(replace(column, time="" if k in times or not times else own[nearest].name))
    return tuple(result)


def _table(sheet: str, rows: Sequence[Sequence[Any]]) -> Table:
    clocks = [_seconds(sheet, cells) for cells in zip(*rows, strict=True)]
    lines = ["\t".join(_text(cell, clocks[k], at) for k, cell in enumerate(row)) for at, row in enumerate(rows)]
    try:
        table = columns.read(Source(f"{sheet}.tsv", content="\n".join(lines).encode()))
    except FileError as refusal:
        raise FileError([replace(one, where=_where(sheet, one.where)) for one in refusal.issues]) from None
    stamps = [np.array(list(clock.values())) for clock in clocks if clock]
    return replace(table, columns=tuple(_shown(one, stamps) for one in table.columns))


def _shown(column: Column, stamps: Sequence[Array]) -> Column:
    """The column without the empty cells below its last number; a column of times of day or dates with its unit."""
    filled = np.flatnonzero(~np.isnan(column.values))
    values = column.values[: int(filled[-1]) + 1] if len(filled) else column.values
    if any(np.array_equal(values, one) for one in stamps):
        return replace(column, values=values, unit="s", quantity="time")
    return replace(column, values=values)


def _seconds(sheet: str, cells: Sequence[Any]) -> dict[int, float]:
    """Seconds from the first time or date of a column, by row. Raises FileError for steps that a cell cannot hold."""
    moments = {at: moment for at, cell in enumerate(cells) if (moment := _moment(cell)) is not None}
    if len(moments) < 2:
        return {}
    first = min(moments.values())
    found = {at: (moment - first) / timedelta(seconds=1) for at, moment in moments.items()}
    steps = np.diff(list(found.values()))
    step = float(np.median(steps))
    if 0 <= step < _SHORTEST and (sum(steps) < _SURE or float(np.ptp(steps)) > _EQUAL):
        problem = f"has times in steps of {step:g} s; cells of times are rounded to 0.001 s"
        raise FileError(
            Issue(f"sheet {sheet}", problem, fix="save the time as numbers in s, or leave it out and give the rate")
        )
    return found


def _moment(cell: Any) -> timedelta | None:
    if isinstance(cell, datetime):
        return cell - datetime(1900, 1, 1)
    if isinstance(cell, date):
        return datetime.combine(cell, time()) - datetime(1900, 1, 1)
    if isinstance(cell, time):
        return timedelta(hours=cell.hour, minutes=cell.minute, seconds=cell.second, microseconds=cell.microsecond)
    return cell if isinstance(cell, timedelta) else None


def _has_numbers(rows: Sequence[Sequence[Any]]) -> bool:
    """Whether two rows contain a number, or most rows contain only numbers that are stored as text."""
    if sum(any(_is_number(cell) for cell in row) for row in rows) >= 2:
        return True
    filled = [[str(cell).strip() for cell in row if cell != ""] for row in rows]
    return 2 * sum(bool(row) and all(_NUMBER.fullmatch(cell) for cell in row) for row in filled) > len(rows)


def _text(cell: Any, clock: dict[int, float], at: int) -> str:
    if at in clock:
        return repr(clock[at])
    if _is_number(cell):
        return repr(cell)
    return re.sub(r"\s+", " ", str(cell)).strip()


def _is_number(cell: Any) -> bool:
    return isinstance(cell, int | float) and not isinstance(cell, bool)


def _where(sheet: str, where: str) -> str:
    return f"sheet {sheet}, row {where.removeprefix('line ')}" if where.startswith("line ") else f"sheet {sheet}"


FORMAT = Format(
    key="excel",
    title="Spreadsheet (Excel, OpenDocument)",
    of="measurement",
    extensions=("xlsx", "xlsm", "xlsb", "xls", "ods"),
    defined="Office Open XML, ECMA-376; OpenDocument 1.3; [MS-XLS]",
    header="names, a row of units, the lines above them, of each sheet",
    compared="as in columns of text",
    looks_like=looks_like,
    read=read,
    public=4,
    public_check="xlrd 2.0; two more have gaps that the check does not compare; 26 contain forms and are refused",
    library="python-calamine",
    apart=True,
)
