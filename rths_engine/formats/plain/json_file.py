"""JSON: rows, records, or nested `{data, dt, units}`."""

from __future__ import annotations

import json
import re
from typing import Any

from rths_engine.formats import tree
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError, Issue

_START = re.compile(rb"\{|\[\s*(?:[\[\]{\"\d-]|true\b|false\b|null\b|NaN\b|Infinity\b|$)")


def looks_like(source: Source) -> bool:
    """Whether the content begins with a JSON object or list; `[s],[kN]` is a row of units."""
    return _START.match(source.head.lstrip(b"\xef\xbb\xbf \t\r\n")) is not None


def read(source: Source) -> Table:
    """Read a JSON file. Raises FileError for a file that is not valid JSON."""
    raw = source.bytes()
    try:
        data: Any = json.loads(raw.decode("utf-8-sig"))
    except (UnicodeDecodeError, ValueError, RecursionError) as error:
        problem = "is nested too deeply" if isinstance(error, RecursionError) else f"is not valid JSON: {error}"
        raise FileError(Issue("file", problem, fix="export the file again, or export it as CSV")) from None
    return tree.table(data if isinstance(data, dict) else {"data": data}, "JSON")


FORMAT = Format(
    key="json",
    title="JSON",
    of="measurement",
    extensions=("json",),
    defined="RFC 8259",
    header="names, units, time step or rate, start, scale and marks of missing values of each object",
    compared="number of samples, duration, time step, peak, where they are stated",
    looks_like=looks_like,
    read=read,
)
