"""The table of a batch: a row for each file, as JSON or CSV takes it."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from typing import Any

from rths_engine.foundation.errors import Issue
from rths_engine.recordings.batches.batch import Row

FIELDS = (
    "file", "result", "recording", "reasons", "differences", "warnings", "format", "columns",
    "samples", "rate_hz", "start_s", "duration_s", "size", "sha256",
)  # fmt: skip
_FORMULA = ("=", "+", "-", "@", "\t", "\r")  # a spreadsheet computes text that begins with one of these


def as_dict(row: Row) -> dict[str, Any]:
    """A row with its reasons, differences and warnings, as JSON takes it."""
    known, recording = row.facts, row.facts.recording if row.facts else None
    clock = ("samples", "rate_hz", "start_s", "duration_s")
    return {
        "file": row.name,
        "size": row.size,
        "sha256": row.sha256,
        "imported": row.imported,
        "recording": None,
        "reasons": [one.as_dict() for one in row.reasons],
        "differences": [one.as_dict() for one in row.differences],
        "warnings": [one.as_dict() for one in row.warnings],
        "format": known.format if known else None,
        "columns": len(known.columns) if known else None,
        **{name: getattr(recording, name) if recording else None for name in clock},
    }


def sentence(reason: dict[str, Any]) -> str:
    """A reason as a sentence: where, value, problem and remedy."""
    return str(Issue(reason["where"], reason["problem"], reason["value"] or None, reason["fix"] or None))


def to_csv(rows: Iterable[dict[str, Any]]) -> str:
    """The rows of a table as CSV; several reasons, differences or warnings of a file are separated by a semicolon."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(FIELDS)
    for row in rows:
        shown = {
            **row,
            "result": "imported" if row["imported"] else "refused",
            "reasons": "; ".join(sentence(one) for one in row["reasons"]),
            "differences": "; ".join(one["text"] for one in row["differences"]),
            "warnings": "; ".join(sentence(one) for one in row["warnings"]),
        }
        writer.writerow([_cell(shown[name]) for name in FIELDS])
    return text.getvalue()


def _cell(value: Any) -> Any:
    if value is None:
        return ""
    return f"'{value}" if isinstance(value, str) and value.startswith(_FORMULA) else value
