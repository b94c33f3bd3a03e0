"""A report as PDF, typeset by Typst: A4, tagged for screen readers (PDF/UA-1), with the fonts that Typst carries.

The template `report.typ` reads the report as JSON, so that no text of a person is ever read as markup. Nothing is read from the
disk or from a network, except the fonts of the system for characters that those of Typst lack.
"""

from __future__ import annotations

import json
import re
import tempfile
from functools import cache
from typing import Any

from app.reports.document import Block, Document, Facts, Figures, Heading, Letterhead, Signatures, Table, Tables, Text
from app.reports.figures import Panel
from app.reports.glyphs import SAID, boxed, lacking
from app.reports.html import FRONTEND, points_for
from app.reports.svg.frame import Size
from app.reports.svg.palette import paper
from app.reports.svg.plot import plot

FONT, EM = "Libertinus Serif", 0.48
WIDE, HALF, TALL = Size(720, 185, 11, EM), Size(352, 185, 11, EM), Size(720, 300, 11, EM)  # 720 px are the width of the text
BYTES = 1_500_000  # of all lines together; a PDF compresses them to a third
_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f]")


def pdf(document: Document) -> bytes:
    """The report as a PDF file, whatever characters people wrote: system fonts help out, and a box replaces what they lack."""
    import typst

    data = _as_data(document)
    try:
        return _typeset(json.dumps(data), system_fonts=False)
    except typst.TypstError:
        found = lacking(json.dumps(data, ensure_ascii=False))
    said = json.dumps({**data, "further": [*data["further"], SAID]}, ensure_ascii=False)
    try:
        return _typeset(boxed(said, found) if found else json.dumps(data), system_fonts=True)
    except typst.TypstError:  # for example text in the logo
        return _typeset(boxed(said, found), system_fonts=True, accessible=False)


def _typeset(report: str, system_fonts: bool, accessible: bool = True) -> bytes:
    import typst

    with tempfile.TemporaryDirectory() as empty:
        compiler = typst.Compiler(_template(), root=empty, ignore_system_fonts=not system_fonts)
        made = compiler.compile(format="pdf", sys_inputs={"report": report}, pdf_standards=["ua-1"] if accessible else [])
    assert isinstance(made, bytes)
    return made


@cache
def _template() -> bytes:
    return (FRONTEND / "templates" / "report.typ").read_bytes()


def _as_data(document: Document) -> dict[str, Any]:
    points = points_for(document, BYTES)
    sections = [
        {"title": _plain(one.title), "together": one.together, "blocks": [_block(block, points) for block in one.blocks]}
        for one in document.sections
    ]
    verdict = document.verdict
    return {
        "kind": _plain(document.kind),
        "title": _plain(document.title),
        "verdict": {"lead": verdict.lead, "text": _plain(verdict.text), "tone": verdict.tone},
        "further": [_plain(one) for one in document.further],
        "facts": _pairs(document.facts),
        "sections": sections,
        "subject": document.subject,
        "made": document.made,
        "letterhead": _letterhead(document.letterhead),
    }


def _letterhead(given: Letterhead) -> dict[str, Any]:
    logo = None
    if given.logo:
        data, media_type = given.logo
        logo = {"format": "png" if media_type == "image/png" else "svg", "bytes": list(data)}
    return {"name": _plain(given.name), "address": _plain(given.address), "logo": logo}


def _block(block: Block, points: int) -> dict[str, Any]:
    match block:
        case Facts():
            return {"block": "facts", "rows": _pairs(block.rows), "long": block.long}
        case Heading():
            return {"block": "heading", "title": _plain(block.title)}
        case Table():
            return {"block": "table", **_table(block)}
        case Tables():
            return {"block": "tables", "tables": [_table(one) for one in block.tables]}
        case Text():
            return {"block": "text", "paragraphs": [_plain(one) for one in block.paragraphs], "note": block.tone == "note"}
        case Figures():
            return {"block": "figures", "panels": [_panel(one, points) for one in block.panels]}
        case Signatures():
            return {"block": "signatures", "roles": [_plain(one) for one in block.roles]}


def _table(table: Table) -> dict[str, Any]:
    heads = [{"label": _plain(one.label), "number": one.number, "share": one.share} for one in table.heads]
    rows = [[_plain(cell) for cell in row] for row in table.rows]
    return {"caption": _plain(table.caption), "heads": heads, "rows": rows, "whole": table.whole, "bare": table.bare}


def _panel(panel: Panel, points: int) -> dict[str, Any]:
    size = TALL if panel.tall else WIDE if panel.wide else HALF
    if panel.spec.get("height"):
        size = Size(WIDE.width, float(panel.spec["height"]) * 0.8, WIDE.text, EM)
    drawn = plot(panel, size, points, paper(FONT))
    return {"title": _plain(panel.title), "alt": _plain(panel.alt), "wide": size.width == WIDE.width, "svg": drawn}


def _pairs(rows: Any) -> list[list[str]]:
    return [[_plain(label), _plain(text)] for label, text in rows]


def _plain(text: str) -> str:
    """The text without control characters, which no font draws."""
    return _CONTROL.sub("\N{REPLACEMENT CHARACTER}", text)
