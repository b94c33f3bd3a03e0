"""The places in a document where generated tables stand."""

from __future__ import annotations

import re

from app.documents.tables import TABLES

_REGION = re.compile(r"(<!-- generated: (.+?) -->\n).*?(<!-- end -->)", re.DOTALL)


def renewed(text: str) -> str:
    """The document with every generated table as it is now. Raises KeyError for a name that is not in TABLES."""
    return _REGION.sub(lambda region: f"{region[1]}{TABLES[region[2]]()}\n{region[3]}", text)


def names(text: str) -> list[str]:
    """The generated tables of a document, in their order."""
    return [region[2] for region in _REGION.finditer(text)]
