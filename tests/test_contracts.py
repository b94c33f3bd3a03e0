"""The contracts of imports refuse what they say they refuse."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def broken(folder: Path, files: dict[str, str]) -> str:
    """What the import contracts say of a copy of the program with other files in it."""
    for name in ("rths_engine", "app", "tests"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__", "data", "*.h5", "*.png"))
    shutil.copy(ROOT / "pyproject.toml", folder)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    command = [sys.executable, "-c", "from importlinter.cli import lint_imports_command as lint; lint()", "--no-cache"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    return done.stdout if done.returncode else ""


ROOMS = [
    "",
    "foundation",
    "planning",
    "running",
    "results",
    "recordings",
    "recordings/measured",
    "stability",
    "table4",
    "diagnosis",
]


def test_a_module_that_no_contract_names_is_refused_in_every_room(tmp_path: Path) -> None:
    said = broken(tmp_path, {f"rths_engine/{room}/stray.py".replace("//", "/"): '"""A stray module."""\n' for room in ROOMS})
    for room in ROOMS:
        container = ".".join(["rths_engine", *filter(None, room.split("/"))])
        assert f"{container}.stray" in said or f"in {container}" in said, room


FORBIDDEN: dict[str, tuple[dict[str, str], str]] = {
    "No circle of imports": (
        {
            "rths_engine/parts/structures/one.py": "from rths_engine.parts.structures import other\n",
            "rths_engine/parts/structures/other.py": "from rths_engine.parts.structures import one\n",
        },
        "No cycles are allowed in rths_engine.parts.structures.",
    ),
    "What runs a plan knows nothing of how a diagnosis searches for effects": (
        {"rths_engine/running/stop.py": "from rths_engine.parts.physics.search import Seen\n"},
        "rths_engine.running.stop -> rths_engine.parts.physics.search",
    ),
    "Only parts, the loop and the reader of numeric text are compiled": (
        {"rths_engine/stability/margins.py": "from rths_engine.foundation.kernel import compiled\n"},
        "rths_engine.stability.margins -> rths_engine.foundation.kernel",
    ),
    "Effects of a component do not know each other": (
        {"rths_engine/parts/physics/input/low_pass.py": "from rths_engine.parts.physics.input import time_shift\n"},
        "rths_engine.parts.physics.input.low_pass -> rths_engine.parts.physics.input.time_shift",
    ),
}


@pytest.fixture(scope="module")
def said(tmp_path_factory: pytest.TempPathFactory) -> str:
    """What the contracts say of one copy with all forbidden imports: each is named under the contract that it breaks."""
    files = {name: text for given, _ in FORBIDDEN.values() for name, text in given.items()}
    return broken(tmp_path_factory.mktemp("forbidden"), files)


@pytest.mark.parametrize("contract", FORBIDDEN)
def test_what_the_rooms_forbid_is_refused(said: str, contract: str) -> None:
    assert f"{contract} BROKEN" in " ".join(said.split())
    section = said.partition("Broken contracts")[2].partition(f"\n{contract}\n---")[2].partition("\n---")[0]
    assert FORBIDDEN[contract][1] in " ".join(section.split())


def test_nothing_else_is_refused(said: str) -> None:
    assert f", {len(FORBIDDEN)} broken." in said
