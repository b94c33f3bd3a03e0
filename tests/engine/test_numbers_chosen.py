"""Numbers chosen by hand carry their source, and the record of the choices is the engine's."""

from __future__ import annotations

import ast
import importlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parents[2]
ENGINE = ROOT / "rths_engine"
RECORD = ROOT / "docs" / "decisions" / "0023-numbers-chosen-by-hand.md"
CHOSEN = "docs/decisions/0023"
SOURCE = re.compile(
    r"docs/[a-z0-9/.-]+|[A-Z][a-z]+ \(?(1[89]|20)\d\d|\bISO\b|\bAISC\b|\bCOSMOS\b|Lobatto|[Pp]laces in|by definition"
)
ROW = re.compile(r"^\| `([a-z0-9_.]+)\.(_?[A-Z][A-Z0-9_]*)` \| ([^|]*) \|")


class Constant(NamedTuple):
    """A number or a table of numbers at the top of a module, with the comments on its lines and above it in its block."""

    module: str
    name: str
    comment: str


def numeric(value: ast.expr) -> bool:
    """Whether it holds a number but the whole 0 and 1 of places and counts."""
    numbers = (one.value for one in ast.walk(value) if isinstance(one, ast.Constant) and type(one.value) in (int, float))
    return any(isinstance(one, float) or one not in (0, 1) for one in numbers) and not ast.unparse(value).startswith("range(")


def constants_of(path: Path) -> Iterator[Constant]:
    text = path.read_text()
    lines = text.splitlines()
    module = ".".join(path.relative_to(ENGINE).with_suffix("").parts)
    for node in ast.parse(text).body:
        targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
        value = node.value if isinstance(node, ast.Assign | ast.AnnAssign) else None
        names = [one.id for target in targets for one in ast.walk(target) if isinstance(one, ast.Name)]
        if isinstance(value, ast.Call) and ast.unparse(value.func) == "Format":
            continue  # the number of public files that were read, in docs/formats.md
        if value is None or not names or not all(name.lstrip("_").isupper() for name in names) or not numeric(value):
            continue
        first = node.lineno - 1
        while first > 0 and lines[first - 1].strip():
            first -= 1
        comment = "\n".join(line.partition("#")[2] for line in lines[first : node.end_lineno])
        yield from (Constant(module, name, comment) for name in names)


def constants() -> list[Constant]:
    return [one for path in sorted(ENGINE.rglob("*.py")) for one in constants_of(path)]


def recorded() -> dict[tuple[str, str], str]:
    """Value in the record, by module and name."""
    rows = (ROW.match(line) for line in RECORD.read_text().splitlines())
    return {(row[1], row[2]): row[3].strip() for row in rows if row}


def test_every_number_at_the_top_of_a_module_names_its_source() -> None:
    silent = [f"{one.module}.{one.name}" for one in constants() if not SOURCE.search(one.comment)]
    assert not silent, "name the source beside it, or 'chosen; see docs/decisions/0023' and its reason there"


def test_a_record_that_a_number_names_exists() -> None:
    named = {found for one in constants() for found in re.findall(r"docs/(?:decisions/\d{4}|[\w.-]+\.md)", one.comment)}
    assert named
    for one in named:
        assert list(ROOT.glob(f"{one}*")), one


def test_every_number_that_was_chosen_stands_in_the_record_and_no_other() -> None:
    """A block may also hold numbers with a source of their own on their line."""
    all_of_them = {(one.module, one.name): one for one in constants()}
    table = recorded()
    assert table.keys() <= all_of_them.keys(), "the record names numbers that are gone"
    own = {place for place, one in all_of_them.items() if SOURCE.search(one.comment.replace(CHOSEN, ""))}
    chosen = {place for place, one in all_of_them.items() if CHOSEN in one.comment}
    assert table.keys() <= chosen
    assert chosen - own <= table.keys(), "give the reason in the record"


@pytest.mark.parametrize("place", sorted(recorded()), ids=".".join)
def test_the_record_has_the_engines_value(place: tuple[str, str]) -> None:
    module, name = place
    written = recorded()[place]
    value = getattr(importlib.import_module(f"rths_engine.{module}"), name)
    if isinstance(value, int | float | tuple):
        numbers = ast.literal_eval(written)
        assert numbers == pytest.approx(value, rel=1e-5)  # six digits are written
