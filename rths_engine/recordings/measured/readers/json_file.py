"""JSON: rows, records, or nested `{data, dt, units}`."""

from __future__ import annotations

import json
from typing import Any

from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.measured.readers import tree
from rths_engine.recordings.measured.table import Table


def looks_like(raw: bytes) -> bool:
    """Whether the bytes begin a JSON object or list."""
    return raw.lstrip(b"\xef\xbb\xbf \t\r\n")[:1] in (b"{", b"[")


def read(raw: bytes) -> Table:
    """Read a JSON file. Raises MeasuredError for a file that is not valid JSON."""
    try:
        data: Any = json.loads(raw.decode("utf-8-sig"))
    except (UnicodeDecodeError, ValueError, RecursionError) as error:
        problem = "is nested too deeply" if isinstance(error, RecursionError) else f"is not valid JSON: {error}"
        raise MeasuredError(Issue("file", problem, fix="export the file again, or export it as CSV")) from None
    return tree.table(data if isinstance(data, dict) else {"data": data}, "JSON")
