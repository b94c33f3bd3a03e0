"""Regions of a document that hold generated tables."""

from __future__ import annotations

import re
from pathlib import Path

from app.documents.tables import TABLES

_REGION = re.compile(r"(<!-- generated: (.+?) -->\n).*?(<!-- end -->)", re.DOTALL)


def documents() -> list[Path]:
    """Every document that people read: those at the top, in docs and in docs/guides. Decision records stay as written."""
    root = Path(__file__).parents[2]
    return [*sorted(root.glob("*.md")), *sorted((root / "docs").glob("*.md")), *sorted((root / "docs" / "guides").glob("*.md"))]


def renewed(text: str) -> str:
    """The document with every table generated again. Raises KeyError for a name that is not in TABLES."""
    return _REGION.sub(lambda region: f"{region[1]}{TABLES[region[2]]()}\n{region[3]}", text)


def names(text: str) -> list[str]:
    """The names of the generated tables of a document, in order."""
    return [region[2] for region in _REGION.finditer(text)]
