"""Rows of numbers read by compiled code: every number as Python's `float` reads it, and nothing that is not a row."""

from __future__ import annotations

import math
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import numeric_block
from rths_engine.formats.decimal_number import decimal_number
from rths_engine.formats.numeric_block import Layout, line_number, read_block
from rths_engine.formats.scratch import on_disk, release
from rths_engine.formats.source import Source
from rths_engine.foundation.errors import FileError

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
DIGITS = st.text("0123456789", max_size=22)
WRITTEN = st.one_of(
    FLOATS.map(repr),
    st.tuples(FLOATS, st.integers(0, 18)).map(lambda one: f"{one[0]:.{one[1]}e}"),
    st.tuples(st.floats(-1e9, 1e9), st.integers(0, 12)).map(lambda one: f"{one[0]:.{one[1]}f}"),
    st.tuples(st.integers(2**52, 2**53), st.integers(0, 10)).map(lambda one: str((2 * one[0] + 1) * 2 ** one[1])),  # ties
    st.tuples(st.sampled_from(["", "-", "+"]), DIGITS, DIGITS, st.sampled_from(["", "e-310", "E5", "e+12", "e-22"])).map(
        lambda one: f"{one[0]}{one[1]}.{one[2]}{one[3]}"
    ),
)


def bits(value: float) -> bytes:
    return struct.pack("d", value)


def is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def refuse(at: int, line: bytes) -> None:
    raise FileError(f"byte {at}: {line!r}")


def columns(text: str, layout: Layout) -> list[list[float]]:
    return [list(one) for one in read_block(Source("a.csv", content=text.encode()), 0, layout, refuse)]


@given(WRITTEN)
def test_a_converted_number_is_the_float_nearest_to_its_digits(text: str) -> None:
    value, after, exact = decimal_number(np.frombuffer(text.encode() + b"\n", np.uint8), 0, ord("."))
    if exact:
        assert bits(value) == bits(float(text))
        assert after == len(text)
    elif is_number(text):
        hard = sum(map(str.isdigit, text.partition("e")[0])) > 15 or not 1e-300 < abs(float(text)) < 1e300
        assert hard  # only numbers of many digits, or close to the limits of a float, are left to Python


def test_numbers_as_programs_print_them_are_converted_without_python() -> None:
    rng = np.random.default_rng(5)
    for text in [f"{value:.18e}" for value in rng.normal(size=3000)] + [repr(float(value)) for value in rng.normal(size=3000)]:
        value, _, exact = decimal_number(np.frombuffer(text.encode() + b"\n", np.uint8), 0, ord("."))
        assert exact
        assert bits(value) == bits(float(text))


@given(
    rows=st.lists(st.tuples(WRITTEN, WRITTEN, WRITTEN).filter(lambda row: all(map(is_number, row))), max_size=30),
    separator=st.sampled_from([",", ";", "\t", ""]),
    decimal=st.sampled_from([".", ","]),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
    blank=st.sampled_from(["", " "]),
    ending=st.booleans(),
    last=st.booleans(),
)
def test_rows_of_any_form_give_their_numbers_back(
    rows: list[tuple[str, ...]], separator: str, decimal: str, end: str, blank: str, ending: bool, last: bool
) -> None:
    if separator == decimal or not separator:
        decimal = "."
    if not separator:
        ending = False
    written = [
        f"{separator or ' '}{blank}".join(field.replace(".", decimal) for field in row) + (separator if ending else "")
        for row in rows
    ]
    text = end.join(written) + (end if last else "")
    layout = Layout(separator, decimal, (True, True, True), ending)

    def by_python(at: int, line: bytes) -> list[float] | None:
        if not line.strip():
            return None
        fields = line.decode().strip().removesuffix(separator if ending else "").split(separator or None)
        return [float(field.replace(decimal, ".")) for field in fields]

    found = read_block(Source("a.csv", content=text.encode()), 0, layout, by_python)
    wanted = [[float(row[k]) for row in rows] for k in range(3)]
    assert [list(map(bits, one)) for one in found] == [list(map(bits, one)) for one in wanted]


@pytest.mark.parametrize(
    "line",
    [
        "1,2",
        "1,2,3,4",
        "1,2,3,",
        "1.5.1,2,3",
        "1,****,3",
        "1,2,3 # late",
        "# 1,2,3",
        "1,x,3",
        "1,2e,3",
        "1,-,3",
        "1,2 2,3",
        "1,2,3;",
    ],
)
def test_a_line_that_is_not_exactly_a_row_is_handed_to_the_caller_with_its_place(line: str) -> None:
    text = f"1,2,3\r\n4,5,6\r\n{line}\r\n7,8,9\r\n"
    with pytest.raises(FileError, match=r"byte 14: "):
        columns(text, Layout(",", ".", (True, True, True)))
    assert line_number(Source("a.csv", content=text.encode()), 14) == 3


def test_empty_fields_and_nan_are_missing_values() -> None:
    first, second = columns('1,\nNaN,2\n"3", "4.5"\n', Layout(",", ".", (True, True)))
    assert [first[0], *first[2:]] == [1, 3]
    assert second[1:] == [2, 4.5]
    assert math.isnan(first[1]) and math.isnan(second[0])


def test_fields_of_text_are_skipped_and_exponents_of_fortran_read() -> None:
    assert columns("a b 1.5D+03 x\n  c d 2d0\ty\n", Layout("", ".", (False, False, True, False))) == [[1500, 2]]


def test_the_caller_can_give_the_numbers_of_a_line_or_skip_it() -> None:
    def other(at: int, line: bytes) -> list[float] | None:
        return None if b"skip" in line else [-1.0, float(at)]

    found = read_block(Source("a", content=b"1,2\nskip\nn/a,x\n3,4"), 0, Layout(",", ".", (True, True)), other)
    assert [list(one) for one in found] == [[1, -1, 3], [2, 9, 4]]


def test_a_large_file_is_read_in_pieces_and_its_columns_lie_on_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numeric_block, "PIECE", 1000)
    monkeypatch.setattr(numeric_block, "IN_MEMORY", 10_000)
    path = tmp_path / "large.csv"
    wanted = np.round(np.random.default_rng(1).normal(size=(3000, 4)), 6)
    wanted[:, 0] = np.arange(3000)
    path.write_text("\n".join(",".join(map(repr, map(float, row))) for row in wanted))
    layout = Layout(",", ".", (True, True, True, True))
    found = read_block(Source("large.csv", path=path), 0, layout, refuse)
    assert all(on_disk(one) for one in found)
    for one in found:
        release(one)
    assert np.array_equal(np.array(found).T, wanted)
    path.write_text(path.read_text().replace("\n2900.0,", "\n2900.0x,").replace("\n2990.0,", "\n2990.0x,"))
    with pytest.raises(FileError, match=r"2900\.0x"):
        read_block(Source("large.csv", path=path), 0, layout, refuse)
    monkeypatch.setattr(numeric_block, "MOST_VALUES", 5000)
    with pytest.raises(FileError, match="more than 5,000 values"):
        read_block(Source("large.csv", path=path), 0, layout, refuse)


def test_text_without_line_ends_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numeric_block, "PIECE", 100)
    with pytest.raises(FileError, match="no line end for 100 bytes"):
        read_block(Source("a", content=b"1" * 300), 0, Layout(",", ".", (True,)), refuse)


@given(st.text("ab\r\n", max_size=40))
def test_line_numbers_count_every_kind_of_line_end(text: str) -> None:
    lines = text.splitlines(keepends=True)
    for k in range(len(lines)):
        assert line_number(Source("a", content=text.encode()), len("".join(lines[:k]))) == k + 1
