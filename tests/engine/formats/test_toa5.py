"""Campbell TOA5: names and units of their rows, dates as time, values out of range as missing."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats.writers.toa5 import written

NAMES, UNITS = ("Disp(1)", "Force"), ("mm", "kN")
ROWS = [(0.5 * k, -0.25 * k) for k in range(40)]


def read(content: bytes) -> Table:
    return registry.read(Source("Fast.dat", content=content))


def test_columns_come_back_with_units_and_time_over_midnight() -> None:
    table = read(written(NAMES, UNITS, ROWS))
    assert table.format == "Campbell TOA5" and table.notes == ()
    assert [(one.name, one.unit) for one in table.columns] == [("TIMESTAMP", "s"), ("Disp(1)", "mm"), ("Force", "kN")]
    np.testing.assert_allclose(table.columns[0].values, 0.05 * np.arange(40), atol=1e-9)
    assert np.array_equal(np.column_stack([one.values for one in table.columns[1:]]), ROWS)
    assert table.about["station"] == "Bridge" and table.about["table"] == "Fast"


def test_values_out_of_range_are_missing_and_named() -> None:
    rows: list[tuple[float | str, ...]] = [(1.0, "NAN"), (2.0, -7999.0), (3.0, 1.5)]
    table = read(written(NAMES, UNITS, rows))
    assert np.isnan(table.columns[2].values).tolist() == [True, True, False]
    assert table.notes == ("Force is out of range in 2 rows, first in line 5: missing values",)


def test_times_of_extremes_and_lost_records_are_named() -> None:
    content = written(("Max", "At"), ("mm", ""), [(1.0, "2024-02-28 12:00:00"), (2.0, "2024-02-28 13:00:00")])
    content = content.replace(b'"Smp","Smp"', b'"Max","TMx"').replace(b'",1,2,', b'",5,2,')
    assert read(content).notes == (
        "line 6: RECORD goes from 0 to 5 (1 such steps): records are missing, or the logger was started again",
        "At holds times; it is not read",
    )


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('"mm","kN"', '"mm"', "line 3 = TS,RN,mm: has 3 fields; line 2 names 4"),
        (",3,1.5,-0.75", ",3,1.5", "line 8 = 2024-02-28 23:59:59.15,3,1.5: has 3 fields; line 2 names 4"),
        (",3,1.5,-0.75", ",3,1.5,****", "line 8 = ****: column Force is not a number"),
        (",3,1.5,-0.75", ",3,1.5,-0.7.5", "line 8 = -0.7.5: column Force is not a number"),
        ("23:59:59.15", "23:59", "line 8 = 2024-02-28 23:59: is not a date and a time"),
    ],
)
def test_a_line_that_does_not_follow_the_header_is_refused(old: str, new: str, told: str) -> None:
    text = written(NAMES, UNITS, ROWS).decode()
    assert old in text
    with pytest.raises(FileError) as refused:
        read(text.replace(old, new, 1).encode())
    assert told in str(refused.value)


@given(
    st.lists(st.text("abcXYZ_()12", min_size=1, max_size=8), min_size=1, max_size=4, unique=True),
    st.lists(st.floats(-5e3, 5e3).map(lambda one: float(f"{one:.7g}")), min_size=1, max_size=20),
    st.sampled_from([0.005, 0.05, 1.0, 900.0]),
)
def test_any_file_comes_back(names: list[str], values: list[float], step: float) -> None:
    table = read(written(names, ["mm"] * len(names), [[one] * len(names) for one in values], step))
    assert [one.name for one in table.columns[1:]] == names
    np.testing.assert_allclose(table.columns[0].values, step * np.arange(len(values)), atol=1e-9)
    assert all(one.values.tolist() == values and one.unit == "mm" for one in table.columns[1:])


@given(st.integers(1, 700), st.lists(st.tuples(st.integers(0, 10**6), st.integers(9, 126)), max_size=5))
def test_a_damaged_or_cut_file_is_read_or_refused(cut: int, changes: list[tuple[int, int]]) -> None:
    damaged = bytearray(written(NAMES, UNITS, ROWS[:12])[:cut])
    for at, byte in changes:
        damaged[at % len(damaged)] = byte
    try:
        registry.read(Source("a.dat", content=bytes(damaged)), format="toa5")
    except FileError as refused:
        assert refused.issues
