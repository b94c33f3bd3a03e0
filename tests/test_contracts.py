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


@pytest.mark.parametrize(
    ("files", "contract"),
    [
        (
            {
                "rths_engine/parts/structures/one.py": "from rths_engine.parts.structures import other\n",
                "rths_engine/parts/structures/other.py": "from rths_engine.parts.structures import one\n",
            },
            "No circle of imports BROKEN",
        ),
        (
            {"rths_engine/running/stop.py": "from rths_engine.parts.physics.search import Seen\n"},
            "What runs a plan knows nothing of how a diagnosis searches for effects BROKEN",
        ),
        (
            {"rths_engine/stability/margins.py": "from rths_engine.foundation.kernel import compiled\n"},
            "Only parts, the loop and the reader of numeric text are compiled BROKEN",
        ),
        (
            {"rths_engine/parts/physics/input/low_pass.py": "from rths_engine.parts.physics.input import time_shift\n"},
            "Effects of a component do not know each other BROKEN",
        ),
    ],
    ids=["circle", "search in the loop", "compiled elsewhere", "effects"],
)
def test_what_the_rooms_forbid_is_refused(files: dict[str, str], contract: str, tmp_path: Path) -> None:
    assert contract in " ".join(broken(tmp_path, files).split())
