"""The documents name everything there is."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import Any

import pytest

from app.cli.main import parser
from app.config import VARIABLES, Settings
from app.main import create_app
from rths_engine.parts import integrators
from rths_engine.planning.reading import plan_from_yaml
from rths_engine.planning.shapes import SHAPES
from rths_engine.running.run import simulate

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text()
REST = (ROOT / "docs" / "rest.md").read_text()


def commands() -> dict[str, argparse.ArgumentParser]:
    (found,) = [action for action in parser()._actions if isinstance(action, argparse._SubParsersAction)]
    return dict(found.choices)


@pytest.mark.parametrize("name", commands())
def test_the_readme_names_every_command_and_option(name: str) -> None:
    row = next((line for line in README.splitlines() if line.startswith(f"| `rths {name}")), "")
    assert row, f"no row for rths {name}"
    for action in commands()[name]._actions:
        for option in action.option_strings:
            assert option in row or option in {"-h", "--help"}


@pytest.mark.parametrize("variable", [one.key for one in VARIABLES.values()])
def test_the_readme_names_every_variable(variable: str) -> None:
    assert f"| `{variable}` |" in README


def test_the_rest_page_names_every_route_and_no_other(tmp_path: Path) -> None:
    routes = create_app(Settings(data=tmp_path, embedded_worker=False)).openapi()["paths"]
    served = {f"{method.upper()} {path}" for path, methods in routes.items() for method in methods}
    assert set(re.findall(r"^\| `([A-Z]+ [^`]+)` \|", REST, re.MULTILINE)) == served


@pytest.mark.parametrize("text", re.findall(r"^```yaml\n(.*?)^```", (ROOT / "docs" / "tests.md").read_text(), re.M | re.S))
def test_every_example_of_a_kind_of_test_runs_to_its_end(text: str) -> None:
    assert simulate(plan_from_yaml(text)).status == "completed"


def test_the_example_of_the_engine_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (text,) = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs" / "architecture.md").read_text(), re.MULTILINE | re.DOTALL)
    exec(text, {})
    (shape, period), (largest, mte) = (line.rsplit(" ", 1) for line in capsys.readouterr().out.splitlines())
    assert shape == "(2, 2)" and float(period) == pytest.approx(1.48, rel=1e-9)  # the published period of the structure
    assert float(largest) > 0 and float(mte) > 0


@pytest.mark.parametrize("kinds", [SHAPES, integrators.KINDS], ids=["shapes", "integrators"])
def test_the_page_of_tests_names_every_kind(kinds: tuple[type[Any], ...]) -> None:
    page = (ROOT / "docs" / "tests.md").read_text()
    missing = [kind.model_fields["kind"].default for kind in kinds if f"| `{kind.model_fields['kind'].default}` |" not in page]
    assert missing == []


def test_the_licences_of_bundled_records_lie_beside_them() -> None:
    data = ROOT / "rths_engine" / "parts" / "ground_motions" / "data"
    assert sorted(path.name for path in data.glob("LICENSE*"))
    for licence in data.glob("LICENSE*"):
        assert "Permission is hereby granted" in licence.read_text()
