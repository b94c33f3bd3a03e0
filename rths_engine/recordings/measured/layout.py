"""The layout of a file: its format and the names and units of its columns, by which a saved mapping is proposed again."""

from __future__ import annotations

import hashlib
import json

from rths_engine.formats.table import Table


def fingerprint(table: Table) -> str:
    """SHA-256 of the format, the names and the units of the columns in their order, and the quantities that the format states.

    Two files with the same fingerprint differ in their numbers only, so that one mapping means the same in both.
    """
    columns = [[column.name, column.unit, column.quantity] for column in table.columns]
    return hashlib.sha256(json.dumps([table.format, columns], ensure_ascii=True).encode()).hexdigest()
