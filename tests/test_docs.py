"""The documents name everything there is."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest

from app.cli import parser
from app.config import Settings
from app.main import create_app

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text()
CONTRACTS = (ROOT / "docs" / "architecture.md").read_text()


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


def test_the_contracts_name_every_rest_route(tmp_path: Path) -> None:
    routes = create_app(Settings(data=tmp_path, embedded_worker=False)).openapi()["paths"]
    paths = {path.removeprefix("/api/v1").replace("{run_id}", "{id}") for path in routes}
    missing = {path for path in paths if path not in CONTRACTS and path.rsplit("/", 1)[-1] not in CONTRACTS}
    assert not missing


def test_the_licences_of_bundled_records_lie_beside_them() -> None:
    data = ROOT / "rths_engine" / "ground_motions" / "data"
    assert sorted(path.name for path in data.glob("LICENSE*"))
    for licence in data.glob("LICENSE*"):
        assert "Permission is hereby granted" in licence.read_text()
