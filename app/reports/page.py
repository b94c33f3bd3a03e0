"""A page as one HTML file that needs no network: template, style, plots and plotly.js."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

_FRONTEND = Path(__file__).parents[2] / "frontend"


def render(template: str, **context: Any) -> str:
    """A report from its template, with plotly.js included."""
    text: str = _environment().get_template(template).render(plotly=plotly(), **context)
    return text


@cache
def plotly() -> str:
    """plotly.min.js of the installed wheel."""
    return (files("plotly") / "package_data" / "plotly.min.js").read_text(encoding="utf-8")


@cache
def _environment() -> Environment:
    folders = [_FRONTEND / "templates", _FRONTEND / "static"]
    return Environment(
        loader=FileSystemLoader(folders), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
