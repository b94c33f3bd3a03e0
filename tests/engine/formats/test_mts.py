"""MTS 793 text: blocks with names and units, joined only where their time goes on; what a block states is compared."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats.writers.mts import DAY, ENGLISH, GERMAN, MASKED, Words, block, operator, written

NAMES, UNITS = ("Running Time", "1000 kN Displacement", "1944"), ("s", "mm", "kN")
ROWS = [(10.0, 0.5, -1.25), (10.5, 0.75, 2.5), (11.0, -12.5, 3.75)]


def read(content: bytes) -> Table:
    return registry.read(Source("specimen.dat", content=content))


def refusal(content: bytes) -> str:
    with pytest.raises(FileError) as refused:
        read(content)
    return str(refused.value)


def later(rows: Sequence[Sequence[float]], seconds: float) -> list[tuple[float, ...]]:
    return [(row[0] + seconds, *row[1:]) for row in rows]


@pytest.mark.parametrize("words", [ENGLISH, GERMAN, MASKED])
def test_a_block_comes_back_with_names_units_and_what_the_operator_wrote(words: Words) -> None:
    table = read(written(words, [block(words, NAMES, UNITS, ROWS, stamp=11.25, points=3)], operator(words)))
    assert table.format == "MTS 793 text"
    assert [(one.name, one.unit) for one in table.columns] == list(zip(NAMES, UNITS, strict=True))
    assert np.array_equal(np.column_stack([one.values for one in table.columns]), ROWS)
    assert table.about == {"Date": "5/13/2024", "Mass [g]": "7985", "12": "13"}
    said = "the header does not state the decimal sign; every number has commas only"
    assert table.notes == ((said,) if words is MASKED else ())
    assert [one.what for one in table.statements] == [
        "number of samples of block line 10",
        "time at which the block was written",
    ]


def test_blocks_whose_time_goes_on_are_joined_also_with_empty_columns_at_the_end() -> None:
    blocks = [block(ENGLISH, NAMES, UNITS, later(ROWS, 1.5 * k), stamp=12.0 + 1.5 * k, end="\t\t\t") for k in range(3)]
    table = read(written(ENGLISH, blocks))
    assert table.columns[0].values.tolist() == [10.0 + 0.5 * k for k in range(9)]
    assert table.notes == ("3 blocks are read as 1: their time columns go on by the step of their samples",)


@pytest.mark.parametrize("seconds", [1.0, 2.5, 60.0, -3.0])
def test_blocks_with_a_pause_between_them_are_columns_of_their_own(seconds: float) -> None:
    blocks = [block(ENGLISH, NAMES, UNITS, rows, stamp=99.0) for rows in (ROWS, later(ROWS, seconds))]
    table = read(written(ENGLISH, blocks))
    assert [one.name for one in table.columns][::3] == ["Running Time (block at line 3)", "Running Time (block at line 10)"]
    assert [len(one.values) for one in table.columns] == [3] * 6
    assert [one.time for one in table.columns[3:]] == ["", *["Running Time (block at line 10)"] * 2]
    assert table.columns[3].values.tolist() == [row[0] + seconds for row in ROWS]


def test_blocks_of_other_columns_stay_apart() -> None:
    other = block(ENGLISH, ("Time", "Pressure"), ("s", "bar"), [(0.0, 1.0), (1.0, 2.0)], stamp=2.0)
    table = read(written(ENGLISH, [block(ENGLISH, NAMES, UNITS, ROWS, stamp=12.0), other]))
    assert [one.name for one in table.columns][3:] == ["Time (block at line 10)", "Pressure (block at line 10)"]


def test_a_block_of_extremes_is_named_and_not_read_as_a_time_history() -> None:
    extremes = block(GERMAN, NAMES[1:], UNITS[1:], [(0.75, 3.75), (-12.5, -1.25)], stamp=11.0)
    table = read(written(GERMAN, [extremes, block(GERMAN, NAMES, UNITS, ROWS, stamp=11.0)]))
    assert [one.name for one in table.columns] == list(NAMES)
    assert table.notes == ("line 3: a block of two rows without time holds the extremes of the test; it is not read",)


def test_a_block_without_a_time_column_has_no_step() -> None:
    table = read(written(ENGLISH, [block(ENGLISH, NAMES[1:], UNITS[1:], [row[1:] for row in ROWS], stamp=1.0)]))
    assert [one.dt for one in table.columns] == [None, None]


ONE = written(ENGLISH, [block(ENGLISH, NAMES, UNITS, ROWS, stamp=11.25, points=3)]).decode()


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("Points: \t3", "Points: \t4", "line 5: states a number of samples of block line 3 of 4; the data have 3"),
        ("\t11.25\t", "\t10.75\t", "line 3: states a time at which the block was written of 10.75 s; the data have 11 s"),
        ("\t0.75\t", "\t0,75\t", "line 9 = 0,75: column 1000 kN Displacement is not a number"),
        ("\t0.75\t", "\t\t", "line 9: column 1000 kN Displacement is empty"),
        ("\t0.75\t", "\t********\t", "line 9 = ********: column 1000 kN Displacement is not a number"),
        ("10.5\t0.75\t2.5", "10.5\t0.75\t2.5\t1", "line 9 = 10.5\t0.75\t2.5\t1: has 4 fields; 3 are expected"),
        ("10.5\t0.75\t2.5", "10.5\t0.75", "line 9 = 10.5\t0.75: has 2 fields; 3 are expected"),
        ("\r\n10.5\t", "\r\n\r\n10.5\t", "line 10 = 10.5\t0.75\t2.5: does not belong to a block"),
        ("\r\ns\tmm\tkN", "", "line 3 = Data Acquisition: has no row of names and of units"),
        ("s\tmm\tkN", "s\tmm\tkN\tV", "line 6: names 3 columns; the next line has 4 units"),
    ],
)
def test_what_contradicts_its_header_is_refused(old: str, new: str, told: str) -> None:
    assert old in ONE
    assert told in refusal(ONE.replace(old, new, 1).encode())


def test_a_date_column_that_contradicts_the_date_of_its_block_is_refused() -> None:
    rows = [(DAY, *row) for row in ROWS]
    head = (("Datum", *NAMES), ("d", *UNITS))
    assert read(written(GERMAN, [block(GERMAN, *head, rows, stamp=12.0)])).statements[-1].read == DAY
    rows = [(DAY - 31, *row) for row in ROWS]
    told = "states a date in days since 1899-12-30 of 45425 d; the data have 45394 d"
    assert told in refusal(written(GERMAN, [block(GERMAN, *head, rows, stamp=12.0)]))


value = st.floats(-1e6, 1e6).map(lambda one: float(f"{one:.8g}"))


@given(
    st.sampled_from([ENGLISH, GERMAN]),
    st.lists(st.text("abcXYZ 0123()", min_size=1, max_size=9).map(str.strip).filter(bool), min_size=1, max_size=4, unique=True),
    st.integers(3, 9),
    st.booleans(),
    st.data(),
)
def test_any_file_comes_back(words: Words, names: list[str], count: int, stated: bool, data: st.DataObject) -> None:
    rows = [(0.25 * k, *data.draw(st.tuples(*[value] * len(names)))) for k in range(count)]
    head = ("Time", *names), ("s", *["kN"] * len(names))
    table = read(written(words, [block(words, *head, rows, stamp=100.0, points=count if stated else None)], operator(words)))
    assert [one.name for one in table.columns] == list(head[0]) and [one.unit for one in table.columns] == list(head[1])
    assert np.array_equal(np.column_stack([one.values for one in table.columns]), rows)


@given(st.integers(1, 600), st.lists(st.tuples(st.integers(0, 10**6), st.integers(9, 126)), max_size=5))
def test_a_damaged_or_cut_file_is_read_or_refused(cut: int, changes: list[tuple[int, int]]) -> None:
    blocks = [block(ENGLISH, NAMES, UNITS, later(ROWS, 1.5 * k), stamp=99.0, points=3) for k in range(2)]
    damaged = bytearray(written(ENGLISH, blocks, operator(ENGLISH))[:cut])
    for at, byte in changes:
        damaged[at % len(damaged)] = byte
    try:
        registry.read(Source("a.dat", content=bytes(damaged)), format="mts")
    except FileError as refused:
        assert refused.issues
