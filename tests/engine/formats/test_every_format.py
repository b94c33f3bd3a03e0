"""Every format of the registry has a whole declaration and is tested by name."""

from __future__ import annotations

from pathlib import Path

import pytest

from rths_engine.formats import registry
from rths_engine.formats.format import Format

FOLDER = Path(__file__).parent
LISTED = (*registry.FORMATS, registry.COLUMNS, registry.RECORD)
FILES = [*FOLDER.glob("test_*.py"), FOLDER.parent / "test_measured_readers.py"]
TESTS = [path.read_text(encoding="utf-8") for path in FILES if path.name != Path(__file__).name]


@pytest.mark.parametrize("one", LISTED, ids=lambda one: one.key)
def test_a_format_is_declared_whole_and_tested_by_name(one: Format) -> None:
    assert one.title and one.defined and one.header and one.extensions
    assert (one.public > 0) <= bool(one.public_check), "say what the public files were compared with"
    module = one.read.__module__.rpartition(".")[2]
    names = (module, f'"{one.key}"', one.title)
    assert any(name in text for text in TESTS for name in names), f"no test names {one.key}"


def test_keys_are_distinct() -> None:
    assert len({one.key for one in LISTED}) == len(LISTED)
