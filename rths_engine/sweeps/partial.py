"""The points done of a sweep that was interrupted: a text file that grows by a line for each point.

The first line has the SHA-256 of the definition and the engine's version: results of another sweep are not continued. A line
that was cut off by a crash is left out.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import IO, Any

import numpy as np

from rths_engine import __version__
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.sweeps.columns import Column
from rths_engine.sweeps.design import Design
from rths_engine.sweeps.running import Row
from rths_engine.sweeps.table import Table

SUFFIX = ".partial"


class Partial:
    """The file of the points done. `rows` are the points in it, by their number (from 0)."""

    def __init__(self, path: Path, design: Design):
        self.path = path
        text = json.dumps({**design.definition.as_dict(), "plan": design.plan.as_dict()}, sort_keys=True)
        self.header = {
            "schema": "rths-sweep-partial/1",
            "sweep": hashlib.sha256(text.encode()).hexdigest(),
            "code": __version__,
        }
        self.rows: dict[int, Row] = {}
        if path.exists():
            self._read()
        self._file: IO[str] | None = None

    def __enter__(self) -> Partial:
        new = not self.path.exists()
        self._file = self.path.open("a", encoding="utf-8")
        if new:
            self._write(self.header)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        assert self._file is not None
        self._file.close()

    def add(self, point: int, row: Row) -> None:
        self.rows[point] = row
        values = [None if math.isnan(value) else value for value in row.values]
        self._write({"point": point, "values": values, "reason": row.reason})

    def table(self, columns: Sequence[Column]) -> Table:
        """The points done, in their order."""
        points = sorted(self.rows)
        values = np.array([self.rows[point].values for point in points]).reshape(len(points), len(columns))
        reasons = {point: reason for point in points if (reason := self.rows[point].reason)}
        return Table(columns, np.array(points, dtype=int), values, reasons)

    def _write(self, line: dict[str, Any]) -> None:
        assert self._file is not None
        self._file.write(json.dumps(line) + "\n")
        self._file.flush()

    def _read(self) -> None:
        lines = self.path.read_text(encoding="utf-8").split("\n")
        if lines[0] != json.dumps(self.header):
            problem = "has the points of another sweep, or of another version of the program"
            raise RthsError(Issue("--out", problem, str(self.path), "remove this file, or choose another --out"))
        for line in lines[1:-1]:  # after the last line feed stands nothing, or a line that was cut off
            one = json.loads(line)
            values = tuple(math.nan if value is None else value for value in one["values"])
            self.rows[one["point"]] = Row(values, one["reason"])
        self.path.write_text("\n".join([*lines[:-1], ""]), encoding="utf-8")
