"""Workbooks come back as an independent writer wrote them: names, units, dates, several sheets; forms are left out by name."""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.plain import excel as reader
from rths_engine.formats.plain.markers import MARKERS
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats import binaries
from tests.engine.formats.writers import xlsx
from tests.engine.formats.writers.xlsx import Sheet

T, F = np.arange(40) / 250, 11.4 * np.sin(np.arange(40) / 9)
HEAD: list[list[Any]] = [["Specimen", "TP-1"], ["Time", "Force"], ["s", "kN"]]
ROWS: list[list[Any]] = [[float(t), float(f)] for t, f in zip(T, F, strict=True)]
NOTES = Sheet("Notes", [["operator", "Ana"], ["rig", "2"]])


def read(raw: bytes) -> Table:
    return binaries.read(raw, "a.xlsx", "excel")


def test_a_sheet_with_a_row_of_units_and_a_sheet_of_notes() -> None:
    table = read(xlsx.file(NOTES, Sheet("Data", HEAD + ROWS)))
    time, force = table.columns
    np.testing.assert_array_equal(time.values, T)
    np.testing.assert_array_equal(force.values, F)
    assert [(one.name, one.unit) for one in table.columns] == [("Time", "s"), ("Force", "kN")]
    assert "sheet Notes contains no rows of numbers" in table.notes


def test_several_sheets_and_a_hidden_one() -> None:
    table = read(xlsx.file(Sheet("A", HEAD + ROWS), Sheet("B", HEAD + ROWS), Sheet("C", HEAD + ROWS, hidden=True)))
    assert list(table.names) == ["A/Time", "A/Force", "B/Time", "B/Force"]
    assert table.notes[0] == "sheet C is hidden: left out"


@pytest.mark.parametrize("begin", [datetime(2024, 5, 6, 7, 8, 9), timedelta(hours=7)])
def test_dates_and_times_of_day_become_seconds_from_the_first(begin: Any) -> None:
    rows = [["Time", "Force (kN)"], *([begin + timedelta(seconds=0.25 * k), float(f)] for k, f in enumerate(F))]
    time, force = read(xlsx.file(Sheet("Data", rows))).columns
    np.testing.assert_allclose(time.values, 0.25 * np.arange(40), atol=1e-6)
    assert (time.unit, time.quantity, force.unit) == ("s", "time", "kN") and len(force.values) == 40


def test_cells_of_times_that_are_too_close_are_refused() -> None:
    rows: list[list[Any]] = [["Time", "Force"], *([timedelta(seconds=k / 1024), float(f)] for k, f in enumerate(F))]
    with pytest.raises(FileError, match=r"sheet Data: has times in steps of 0\.001 s; cells of times are rounded to 0\.001 s"):
        read(xlsx.file(Sheet("Data", rows)))


def test_shorter_columns_end_where_their_cells_end_and_a_gap_is_a_missing_value() -> None:
    rows = [[*row, float(k)] if k < 25 else row for k, row in enumerate(ROWS)]
    rows[7] = [rows[7][0], None, *rows[7][2:]]
    table = read(xlsx.file(Sheet("Data", [["Time (s)", "Force (kN)", "Disp (mm)"], *rows])))
    assert [len(one.values) for one in table.columns] == [40, 40, 25]
    assert np.flatnonzero(np.isnan(table.columns[1].values)).tolist() == [7]


def test_text_among_the_numbers_is_refused_with_sheet_and_row() -> None:
    rows = [list(row) for row in ROWS]
    rows[10][1] = "overload"
    with pytest.raises(FileError, match=r"sheet Data, row 14"):
        read(xlsx.file(Sheet("Data", HEAD + rows)))


def test_other_documents_are_no_workbooks() -> None:
    with pytest.raises(FileError, match="is a ZIP archive"):
        registry.read(Source("a.zip", content=b"PK\x03\x04" + bytes(60)))
    with pytest.raises(FileError, match="old Office document"):
        registry.read(Source("a.doc", content=b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600)))


CELLS = st.floats(-1e9, 1e9, allow_nan=False).filter(lambda value: abs(value) not in MARKERS)  # marks of missing values


@settings(max_examples=30)
@given(st.integers(2, 4).flatmap(lambda n: st.lists(st.lists(CELLS, min_size=n, max_size=n), min_size=3, max_size=30)))
def test_any_written_sheet_gives_its_values_back(rows: list[list[float]]) -> None:
    names = [f"channel {chr(ord('a') + k)} (kN)" for k in range(len(rows[0]))]
    table = read(xlsx.file(Sheet("Data", [names, *rows])))
    np.testing.assert_array_equal(np.stack([one.values for one in table.columns], axis=1), rows)


RAW = xlsx.file(Sheet("Data", HEAD + ROWS))


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(4, 10**9), st.integers(0, 255)), max_size=4), st.integers(0, 10**9))
def test_a_damaged_file_is_read_or_refused(changes: list[tuple[int, int]], cut: int) -> None:
    binaries.read_or_refused(reader.read, binaries.damaged(RAW, changes, cut), "a.xlsx")
