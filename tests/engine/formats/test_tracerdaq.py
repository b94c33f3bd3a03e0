"""TracerDAQ text: the step is the stated interval, never the sample number; the dates of the rows are compared with it."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats.writers.tracerdaq import written

NAMES = ("CHANNEL0", "CHANNEL1")
ROWS = [(round(0.005 * k, 6), round(-0.25 * k, 6)) for k in range(300)]


def read(content: bytes) -> Table:
    return registry.read(Source("tracer.txt", content=content))


def test_channels_come_back_with_the_stated_interval_also_over_midnight() -> None:
    table = read(written(NAMES, ROWS, more=("Sampling Rate:, 250", "Sample Count: 300")))
    assert table.format == "TracerDAQ text"
    assert [(one.name, one.unit, one.dt) for one in table.columns] == [("CHANNEL0", "", 0.004), ("CHANNEL1", "", 0.004)]
    assert np.array_equal(np.column_stack([one.values for one in table.columns]), ROWS)
    assert table.about == {"start": "01/02/2003 11:59:59.500 PM"} and table.notes == ()


def test_without_a_stated_interval_the_step_is_that_of_the_dates() -> None:
    assert read(written(NAMES, ROWS, header=False)).columns[0].dt == pytest.approx(0.004, rel=1e-4)


def test_events_are_named_and_dates_that_go_back_leave_the_stated_interval() -> None:
    text = written(NAMES, ROWS).decode().replace("-0.250000\n", "-0.250000, pump on\n", 1)
    assert read(text.encode()).notes == ("line 5: 1 events are not read",)
    back = re.sub(r"01/03/2003 12:00:00(\.\d+) AM", r"01/02/2003 11:59:59\1 PM", text)
    assert "the time of day goes back by 0.996 s; the stated interval is used" in read(back.encode()).notes[1]
    with pytest.raises(FileError, match=r"by the dates of the rows of 0.005 s; the data have 0.004 s"):
        read(back.encode().replace(b"Interval:  0.004", b"Interval:  0.005"))


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("Header Size:  3", "Header Size:  4", "line 1: states a number of lines before the data of 4; the data have 3"),
        ("Interval:  0.004", "Interval:  0.04", "by the dates of the rows of 0.04 s; the data have 0.004 s"),
        ("Interval:  0.004", "Interval:  0.005", "by the dates of the rows of 0.005 s; the data have 0.004 s"),
        ("Interval:  0.004", "Interval:  0.0045", "by the dates of the rows of 0.0045 s; the data have 0.004 s"),
        ("Sampling Interval:  0.004", "Sampling Rate:  240", "rows of 0.004166667 s; the data have 0.004 s"),
        ("       3,", "       4,", "line 6: has the sample number 4 after 2"),
        ("59.508 PM", "59.908 PM", "line 6: is 0.404 s after the row before; the step is 0.004 s"),
        ("-0.500000", "-0,500000", "line 6: has one number more than the heading has channels"),
        ("-0.500000", "", "line 6: column CHANNEL1 is empty"),
        ("-0.500000", "********", "line 6 = ********: column CHANNEL1 is not a number"),
        ("01/02/2003 11:59:59.508", "yesterday 11:59:59.508", "line 6 = yesterday 11:59:59.508 PM: is not a date and a time"),
    ],
)  # fmt: skip
def test_what_contradicts_its_header_is_refused(old: str, new: str, told: str) -> None:
    text = written(NAMES, ROWS).decode()
    assert old in text
    with pytest.raises(FileError) as refused:
        read(text.replace(old, new, 1).encode())
    assert told in str(refused.value)


def test_an_interval_in_ms_is_not_seconds() -> None:
    content = written(NAMES, ROWS).replace(b"Interval:  0.004", b"Interval:  4 ms")
    assert read(content).columns[0].dt == 0.004


def test_stated_count_and_rate_are_compared() -> None:
    for more, told in (
        ("Sample Count: 301", "of 301; the data have 300"),
        ("Sampling Rate: 200", "of 0.004 s; the data have 0.005 s"),
    ):
        with pytest.raises(FileError) as refused:
            read(written(NAMES, ROWS, more=(more,)))
        assert told in str(refused.value)


@given(
    st.lists(st.text("ABC 019()", min_size=1, max_size=8).map(str.strip).filter(bool), min_size=1, max_size=4, unique=True),
    st.lists(st.floats(-1e4, 1e4).map(lambda one: round(one, 6)), min_size=2, max_size=30),
    st.sampled_from([0.001, 0.004, 0.1, 2.0]),
)
def test_any_file_comes_back(names: list[str], values: list[float], interval: float) -> None:
    table = read(written(names, [[one] * len(names) for one in values], interval))
    assert [one.name for one in table.columns] == names
    assert all(one.values.tolist() == values and one.dt == interval for one in table.columns)


@given(st.integers(1, 900), st.lists(st.tuples(st.integers(0, 10**6), st.integers(9, 126)), max_size=5))
def test_a_damaged_or_cut_file_is_read_or_refused(cut: int, changes: list[tuple[int, int]]) -> None:
    damaged = bytearray(written(NAMES, ROWS[:12])[:cut])
    for at, byte in changes:
        damaged[at % len(damaged)] = byte
    try:
        registry.read(Source("a.txt", content=bytes(damaged)), format="tracerdaq")
    except FileError as refused:
        assert refused.issues
