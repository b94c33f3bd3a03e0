"""Generated tables of the documents are those of the code."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from app.documents.markdown import table
from app.documents.regions import documents, names, renewed
from app.documents.tables import TABLES

DOCUMENTS = documents()


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_a_document_is_what_make_docs_writes(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert renewed(text) == text, f"{path.name} is stale: run `make docs`"
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


def test_a_part_is_listed_with_its_equation_and_its_fields_with_unit_and_bounds() -> None:
    rows = TABLES["specimens"]().splitlines()
    assert "| `linear` | Linear spring and dashpot | `f = k x + c v, with v the displacement increment over dt` |" in rows
    assert "| `linear.stiffness` | Stiffness | N/m | kN/m | number, >= 0, <= 1e+12 | 0 |" in rows
    assert "`shear_building.storeys[].mass`" in TABLES["structures"]()


def test_a_route_is_listed_with_query_body_and_statuses() -> None:
    rows = {line.split("|")[1].strip(): line for line in TABLES["routes"]().splitlines()}
    assert re.search(r"`plan`, `plans`, `submitted_by`.* \| 201, ", rows["`POST /api/v1/runs`"])
    assert "`state`, `q`, " in rows["`GET /api/v1/runs`"] and rows["`GET /api/v1/runs`"].endswith("| 200, 422 |")


def test_an_option_is_listed_with_its_default() -> None:
    (row,) = (line for line in TABLES["options"]().splitlines() if line.startswith("| `--seed S` |"))
    assert row.endswith("(default 0) |")


def test_a_variable_is_listed_with_its_default() -> None:
    (row,) = (line for line in TABLES["settings"]().splitlines() if line.startswith("| `RTHS_UPLOAD_LIMIT_MB` |"))
    assert row.endswith("MB | `20` |")
