"""Bytes of an .xlsx workbook by zipfile and XML of ECMA-376: numbers, texts, dates, times of day, hidden sheets."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any
from xml.sax.saxutils import escape

_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_RELATIONS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_SHEET_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"
_BOOK_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"
_STYLES_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml.styles+xml"
_DAY_ZERO = datetime(1899, 12, 30)
_NUMBER, _DATE, _CLOCK = 0, 1, 2  # styles


@dataclass(frozen=True)
class Sheet:
    name: str
    rows: Sequence[Sequence[Any]]  # None: no cell
    hidden: bool = False


def file(*sheets: Sheet) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        kinds = "".join(_override(f"/xl/worksheets/sheet{k}.xml", _SHEET_TYPE) for k in range(1, len(sheets) + 1))
        kinds += _override("/xl/workbook.xml", _BOOK_TYPE) + _override("/xl/styles.xml", _STYLES_TYPE)
        xml = '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
        archive.writestr("[Content_Types].xml", f'<Types xmlns="{_PACKAGE}/content-types">{xml}{kinds}</Types>')
        archive.writestr("_rels/.rels", _links([("officeDocument", "xl/workbook.xml")]))
        targets = [("worksheet", f"worksheets/sheet{k}.xml") for k in range(1, len(sheets) + 1)]
        archive.writestr("xl/_rels/workbook.xml.rels", _links([*targets, ("styles", "styles.xml")]))
        listed = "".join(_listed(k, one) for k, one in enumerate(sheets, start=1))
        book = f'<workbook xmlns="{_MAIN}" xmlns:r="{_RELATIONS}"><sheets>{listed}</sheets></workbook>'
        archive.writestr("xl/workbook.xml", book)
        formats = '<numFmts count="1"><numFmt numFmtId="170" formatCode="hh:mm:ss.000"/></numFmts>'
        styles = "".join(f'<xf numFmtId="{one}"/>' for one in (0, 22, 170))
        sheet = f'<styleSheet xmlns="{_MAIN}">{formats}<cellXfs count="3">{styles}</cellXfs></styleSheet>'
        archive.writestr("xl/styles.xml", sheet)
        for k, one in enumerate(sheets, start=1):
            rows = "".join(_row(at, row) for at, row in enumerate(one.rows, start=1))
            sheet = f'<worksheet xmlns="{_MAIN}"><sheetData>{rows}</sheetData></worksheet>'
            archive.writestr(f"xl/worksheets/sheet{k}.xml", sheet)
    return buffer.getvalue()


def _listed(k: int, one: Sheet) -> str:
    state = ' state="hidden"' if one.hidden else ""
    return f'<sheet name="{escape(one.name)}" sheetId="{k}" r:id="r{k}"{state}/>'


def _row(at: int, cells: Sequence[Any]) -> str:
    return f'<row r="{at}">' + "".join(_cell(f"{_letters(k)}{at}", one) for k, one in enumerate(cells)) + "</row>"


def _cell(place: str, value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, str):
        return f'<c r="{place}" t="inlineStr"><is><t>{escape(value)}</t></is></c>'
    style = _NUMBER
    if isinstance(value, datetime):
        style, value = _DATE, (value - _DAY_ZERO) / timedelta(days=1)
    elif isinstance(value, timedelta):
        style, value = _CLOCK, value / timedelta(days=1)
    return f'<c r="{place}" s="{style}"><v>{float(value)!r}</v></c>'


def _letters(k: int) -> str:
    return (_letters(k // 26 - 1) if k >= 26 else "") + chr(ord("A") + k % 26)


def _override(part: str, kind: str) -> str:
    return f'<Override PartName="{part}" ContentType="{kind}"/>'


def _links(targets: Sequence[tuple[str, str]]) -> str:
    links = [f'<Relationship Id="r{k}" Type="{_RELATIONS}/{kind}" Target="{to}"/>' for k, (kind, to) in enumerate(targets, 1)]
    found = "".join(links)
    return f'<Relationships xmlns="{_PACKAGE}/relationships">{found}</Relationships>'
