"""A refusal that names a line of a file shows that line with its neighbours."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.surroundings import around, shown
from rths_engine.foundation.errors import FileError, Issue, Line

ROWS = ["t (s),disp (mm)", *(f"{k / 100},{k % 7}" for k in range(20))]


def test_a_line_of_text_among_the_numbers_is_shown_with_two_lines_before_and_after() -> None:
    rows = [*ROWS[:9], "cable loose", *ROWS[9:]]
    with pytest.raises(FileError) as refused:
        registry.read(Source("rows.csv", content="\n".join(rows).encode()))
    (issue,) = refused.value.issues
    assert issue.where == "line 10"
    assert [(line.number, line.text) for line in issue.lines] == list(zip(range(8, 13), rows[7:12], strict=True))
    assert issue.as_dict()["lines"][2] == {"number": 10, "text": "cable loose"}


def test_an_error_without_a_line_has_no_lines() -> None:
    assert shown([Issue("file", "is damaged")], Source("a", content=b"1\n2\n")) == (Issue("file", "is damaged"),)
    assert "lines" not in Issue("file", "is damaged").as_dict()


@given(st.integers(1, 12), st.integers(1, 12), st.sampled_from(["\n", "\r\n", "\r"]))
def test_lines_are_counted_alike_with_every_line_end(count: int, number: int, end: str) -> None:
    rows = [f"row {k} é" for k in range(1, count + 1)]
    found = around(Source("a", content=end.join(rows).encode()), number)
    wanted = range(max(1, number - 2), min(count, number + 2) + 1)
    assert found == tuple(Line(k, f"row {k} é") for k in wanted)


def test_a_long_line_is_cut_and_control_characters_are_replaced(tmp_path: Path) -> None:
    path = tmp_path / "long.txt"
    path.write_bytes(b"x" * 5000 + b"\n\x07bell\n")
    cut, bell = around(Source("long.txt", path=path), 1)
    assert len(cut.text) == 240 and cut.text.endswith("…")
    assert bell.text == "\N{REPLACEMENT CHARACTER}bell"
