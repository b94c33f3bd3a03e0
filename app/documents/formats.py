"""Tables of the formats of files that are read, and of those that are only named."""

from __future__ import annotations

from app.documents.markdown import code, table
from rths_engine.formats import recognised, registry
from rths_engine.formats.format import Format

_HEADS = [
    "format",
    "names",
    "definition",
    "read from its header",
    "compared with its data",
    "public files that agreed",
    "library",
]


def formats(of: str) -> str:
    """The formats of ground motions or of measurements."""
    listed = (*registry.FORMATS, registry.COLUMNS, registry.RECORD)
    return table(_HEADS, [_row(one) for one in listed if one.of in {of, "both"}])


def named() -> str:
    """The formats that are recognised but not read, and how to get their numbers."""
    return table(["such a file", "how to get its numbers"], recognised.rows())


def _row(one: Format) -> tuple[str, ...]:
    names = ", ".join(code(f".{extension}") for extension in one.extensions)
    public = f"{one.public}: {one.public_check}" if one.public_check else str(one.public or "none")
    return one.title, names, one.defined, one.header, one.compared or "—", public, one.library
