"""A report as one HTML file: light, with figures as SVG, or interactive, with Plotly."""

from __future__ import annotations

import base64
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from app.reports.document import Document
from app.reports.figures import Panel
from app.reports.svg.frame import Size
from app.reports.svg.plot import plot

FRONTEND = Path(__file__).parents[2] / "frontend"
WIDE, HALF, TALL = Size(1080, 230), Size(530, 230), Size(1080, 420)
BYTES = 600_000  # of all lines together, so that the file stays below 1 MB; see docs/decisions/0047
BYTES_A_POINT = 5.5
LEAST, MOST = 60, 1500  # points of a line


def light(document: Document) -> str:
    """The report as an HTML file below 1 MB without a script: it prints well and opens everywhere."""
    points = points_for(document, BYTES)
    drawn = {id(panel): Markup(plot(panel, size(panel), points)) for panel in document.panels}
    return _rendered(document, drawn=drawn)


def interactive(document: Document) -> str:
    """The report as an HTML file of about 5 MB, whose figures zoom and show values: it includes plotly.js."""
    return _rendered(document, plotly=plotly())


def points_for(document: Document, size: int) -> int:
    """Points of each line so that all lines together take at most `size` bytes."""
    lines = sum(len(panel.spec["traces"]) for panel in document.panels if "traces" in panel.spec)
    return int(max(LEAST, min(MOST, size / BYTES_A_POINT / max(1, lines))))


def size(panel: Panel) -> Size:
    """The size of a figure on a page."""
    if panel.tall:
        return TALL
    if panel.spec.get("height"):
        return Size(WIDE.width, float(panel.spec["height"]))
    return WIDE if panel.wide else HALF


def _rendered(document: Document, **more: Any) -> str:
    logo = document.letterhead.logo
    image = f"data:{logo[1]};base64,{base64.b64encode(logo[0]).decode('ascii')}" if logo else ""
    context = {"drawn": None, "plotly": "", **more}
    text: str = _environment().get_template("report.html").render(document=document, logo=image, **context)
    return text


@cache
def plotly() -> str:
    """plotly.min.js of the installed wheel."""
    return (files("plotly") / "package_data" / "plotly.min.js").read_text(encoding="utf-8")


@cache
def _environment() -> Environment:
    folders = [FRONTEND / "templates", FRONTEND / "static"]
    environment = Environment(
        loader=FileSystemLoader(folders), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters["block"] = lambda block: type(block).__name__
    environment.filters["key"] = id
    return environment
