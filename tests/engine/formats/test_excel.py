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
from rths_engine.recordings.measured import guess, imported
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


def clocked(step: float, name: str, begin: float = 0.0) -> list[list[Any]]:
    return [["Time (s)", name], *([begin + step * k, float(f)] for k, f in enumerate(F))]


@pytest.mark.parametrize(
    "other", [clocked(0.008, "Disp (mm)"), clocked(0.004, "Disp (mm)", 0.1), clocked(0.004, "Disp (mm)")[:31]]
)
def test_each_sheet_has_its_own_time_where_their_times_differ(other: list[list[Any]]) -> None:
    table = read(xlsx.file(Sheet("daq", clocked(0.004, "Force (kN)")), Sheet("lvdt", other)))
    assert [(one.name, one.time) for one in table.columns] == [
        ("daq/Time (s)", ""),
        ("daq/Force (kN)", "daq/Time (s)"),
        ("lvdt/Time (s)", ""),
        ("lvdt/Disp (mm)", "lvdt/Time (s)"),
    ]


def test_two_times_in_a_sheet_are_those_of_the_columns_at_their_right() -> None:
    rows = [[*one, *other] for one, other in zip(clocked(0.004, "Force (kN)"), clocked(0.008, "Disp (mm)"), strict=True)]
    table = read(xlsx.file(Sheet("Data", rows)))
    assert [one.time for one in table.columns] == ["", "Time (s) (column 1)", "", "Time (s) (column 3)"]
    measured = imported(table, guess(table).mapping)
    values = {one.role: one.values for one in measured.channels}
    np.testing.assert_allclose(values["f_meas"], 1e3 * F[: len(values["f_meas"])], rtol=1e-12)
    np.testing.assert_allclose(values["x_meas"][::2], 1e-3 * F[: len(values["x_meas"][::2])], atol=1e-5)


def test_equal_times_on_two_sheets_are_one_time() -> None:
    table = read(xlsx.file(Sheet("A", clocked(0.004, "Force (kN)")), Sheet("B", clocked(0.004, "Disp (mm)"))))
    assert not any(one.time for one in table.columns)


@pytest.mark.parametrize("begin", [datetime(2020, 1, 1), timedelta(hours=7)])
@pytest.mark.parametrize("step", [0.004, 0.005, 0.002])
def test_short_steps_of_whole_milliseconds_that_stay_equal_are_read(begin: Any, step: float) -> None:
    rows: list[list[Any]] = [["Time", "Force (kN)"], *([begin + timedelta(seconds=step * k), 1.0 + k] for k in range(600))]
    time, _ = read(xlsx.file(Sheet("Data", rows))).columns
    np.testing.assert_allclose(time.values, step * np.arange(600), atol=1e-9)


@pytest.mark.parametrize("step", [1 / 1024, 1 / 256, 1 / 300])
def test_short_steps_that_milliseconds_cannot_hold_are_refused(step: float) -> None:
    rows: list[list[Any]] = [["Time", "Force (kN)"], *([timedelta(seconds=step * k), 1.0 + k] for k in range(2000))]
    with pytest.raises(FileError, match=r"cells of times are rounded to 0\.001 s"):
        read(xlsx.file(Sheet("Data", rows)))


@pytest.mark.parametrize("texts", [(0, 1), (0,), (1,)])
def test_numbers_that_are_stored_as_text_are_numbers(texts: tuple[int, ...]) -> None:
    rows = [[repr(cell) if k in texts else cell for k, cell in enumerate(row)] for row in ROWS]
    time, force = read(xlsx.file(Sheet("Data", HEAD + rows))).columns
    assert np.array_equal(time.values, T) and np.array_equal(force.values, F)


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
