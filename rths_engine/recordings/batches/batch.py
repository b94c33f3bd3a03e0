"""Read, check and compare many files by one mapping. A file that is refused does not stop the others."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from math import inf
from pathlib import PurePosixPath

from rths_engine.formats.table import Table
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.batches import comparison, facts
from rths_engine.recordings.batches.difference import Difference
from rths_engine.recordings.batches.facts import Facts
from rths_engine.recordings.measured import importing, stated
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.mapping import Mapping
from rths_engine.recordings.measured.recording import Measured


@dataclass(frozen=True)
class Item:
    """A file of a batch: its name, size (bytes) and SHA-256, and how to read it. `refused`: why it is not there to be read."""

    name: str
    size: int = 0
    sha256: str = ""
    read: Callable[[], Table] | None = None
    refused: tuple[Issue, ...] = ()


@dataclass(frozen=True)
class Row:
    """The outcome of one file: imported where there are no `reasons` against it. `facts`: None where it cannot be read."""

    name: str
    size: int
    sha256: str
    reasons: tuple[Issue, ...]
    differences: tuple[Difference, ...] = ()
    warnings: tuple[Finding, ...] = ()
    facts: Facts | None = None

    @property
    def imported(self) -> bool:
        return not self.reasons


@dataclass(frozen=True)
class Batch:
    """The outcome of all files, in their order. `reference`: name of the file that stands for the layout of most files."""

    rows: tuple[Row, ...]
    reference: str

    @property
    def imported(self) -> int:
        """Number of imported files."""
        return sum(row.imported for row in self.rows)


def run(
    items: Iterable[Item],
    mapping: Mapping,
    keep: Callable[[int, Item, Measured], None],
    trust_mapping: bool = False,
    seconds: float = inf,
) -> Batch:
    """Read each file, one at a time, by `mapping`, and compare them.

    `keep` stores the recording of file `index`; the caller removes it again where the row of the file is not imported. Where a
    file states another unit or step than the mapping, it is refused; with `trust_mapping`, only if it differs from most files.
    Files that are not read within `seconds` are refused.
    """
    end = time.monotonic() + seconds
    rows: list[Row] = []
    for index, item in enumerate(items):
        if time.monotonic() > end:
            problem = f"was not read: the time of {seconds:g} s for one batch was over"
            rows.append(_refused(item, [Issue("file", problem, fix="import this file in another batch")]))
        else:
            rows.append(_read(index, item, mapping, keep, trust_mapping))
    known = [row.facts for row in rows]
    usable = [row.imported for row in rows]
    at = comparison.reference(known, usable)
    found = comparison.compared(known, usable, mapping)
    same = _same_content(rows)
    finished = [_compared(row, [*each, *same.get(k, ())]) for k, (row, each) in enumerate(zip(rows, found, strict=True))]
    return Batch(tuple(finished), rows[at].name if at is not None else "")


def title(mapping: Mapping, name: str) -> str:
    """The name of the recording of a file: the title of the mapping and the name of the file without folder and extension."""
    stem = PurePosixPath(name).stem
    return f"{mapping.title}, {stem}" if mapping.title else stem


def _read(index: int, item: Item, mapping: Mapping, keep: Callable[[int, Item, Measured], None], trust_mapping: bool) -> Row:
    if item.read is None:
        return _refused(item, item.refused)
    try:
        table = item.read()
    except MeasuredError as error:
        return _refused(item, error.issues)
    known = facts.of(table, mapping)
    try:
        examined = importing.examine(table, mapping, item.name, item.sha256)
    except MeasuredError as error:
        return _refused(item, error.issues, known)
    reasons = [one.issue for one in examined.errors]
    if not trust_mapping:
        reasons += [one.issue for one in stated.contradicting(table, mapping)]
    warnings = tuple(one for one in examined.findings if one.severity == "warning")
    measured = examined.measured
    if measured is not None:
        known = replace(known, recording=facts.of_recording(measured))
        if not reasons:
            keep(index, item, replace(measured, title=title(mapping, item.name)))
    return Row(item.name, item.size, item.sha256, tuple(reasons), (), warnings, known)


def _refused(item: Item, reasons: Iterable[Issue], known: Facts | None = None) -> Row:
    return Row(item.name, item.size, item.sha256, tuple(reasons), facts=known)


def _compared(row: Row, differences: list[Difference]) -> Row:
    """The row with its differences, which refuse it where they would change the meaning of the numbers."""
    reasons = row.reasons or tuple(one.issue for one in differences if one.severity == "error")
    return replace(row, differences=tuple(differences), reasons=reasons)


def _same_content(rows: list[Row]) -> dict[int, list[Difference]]:
    """A warning for each file with the content of an earlier file."""
    first: dict[str, str] = {}
    found = {}
    for at, row in enumerate(rows):
        if row.sha256 and first.setdefault(row.sha256, row.name) != row.name:
            found[at] = [Difference("warning", "content", "", f"the same as {first[row.sha256]}", "different")]
    return found
