"""Every stage of the diagnosis has tests of its own."""

from __future__ import annotations

import re
from pathlib import Path

HERE = Path(__file__).parent
STAGES = HERE.parents[2] / "rths_engine" / "diagnosis"


def test_every_module_of_the_diagnosis_is_tested_by_a_file_of_its_own() -> None:
    """tests/engine/diagnosis/test_NAME.py imports NAME or what its package shows of it. The forms of `schema` compute nothing:
    tests/engine/test_diagnosis_schema.py walks over all of them."""
    for path in sorted(STAGES.rglob("*.py")):
        if path.stem == "__init__" or path.parent.name == "schema":
            continue
        tests = HERE / f"test_{path.stem}.py"
        assert tests.exists(), f"{path.relative_to(STAGES)} needs tests/engine/diagnosis/{tests.name}"
        package = ".".join(("rths_engine.diagnosis", *path.relative_to(STAGES).parts[:-1]))
        imported = re.search(rf"from {re.escape(package)}(\.{path.stem})? import", tests.read_text())
        assert imported, f"{tests.name} does not import {package}.{path.stem}"
