"""Generated tables of the documents are those of the code."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.markdown import table
from app.documents.regions import names, renewed
from app.documents.tables import TABLES

DOCUMENTS = sorted((Path(__file__).parent.parent / "docs").glob("*.md"))


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_a_document_is_what_make_docs_writes(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert renewed(text) == text, f"docs/{path.name} is stale: run `make docs`"
    assert text.count("<!-- generated:") == text.count("<!-- end -->") == len(names(text))


def test_every_table_stands_in_a_document() -> None:
    assert set(TABLES) == {name for path in DOCUMENTS for name in names(path.read_text(encoding="utf-8"))}


def test_a_stale_table_is_written_anew_and_the_rest_is_left_alone() -> None:
    text = "before\n<!-- generated: channels -->\nold\n<!-- end -->\nafter\n"
    assert renewed(text) == f"before\n<!-- generated: channels -->\n{TABLES['channels']()}\n<!-- end -->\nafter\n"


def test_a_bar_in_a_cell_does_not_end_it() -> None:
    assert table(["a"], [["x | y\nz"]]) == "| a |\n| --- |\n| x \\| y z |"


def test_the_fields_of_a_verdict_are_listed_with_type_and_unit() -> None:
    rows = {line.split("|")[1].strip(): line for line in TABLES["fields of a verdict"]().splitlines()}
    assert "| [number, number] | stated in `unit` |" in rows["`effects[].parameters[].ci90`"]
    assert "| list of [number, number] | s |" in rows["`where.times_s`"]
    assert "| list of lists of texts |  |" in rows["`indistinguishable`"]
    assert "| object or null |  |" in rows["`next_test`"] and "`next_test.signal`" in rows
    assert "list of numbers, some null" in TABLES["fields of the plots"]()
