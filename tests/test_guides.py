"""The guides are true: their code is applied to a copy of the project, and their commands give what they say.

A path in bold before a block of code is the file of the block: Python, YAML and HTML are whole new files, a `diff` changes one.
A block of `text` after a block of `sh` holds lines that the commands print.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
GUIDES = ROOT / "docs" / "guides"
NAMES = sorted(path.stem for path in GUIDES.glob("*.md"))
PART = re.compile(r"^\*\*([\w./]+)\*\*[^\n]*$|^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LONG_S = 900  # for one block of commands, on a busy machine


@dataclass
class Step:
    """A block of commands with the lines that it prints, or a block of code with its file."""

    kind: str
    text: str
    file: str = ""
    prints: list[str] = field(default_factory=list)


def steps(guide: str) -> list[Step]:
    found: list[Step] = []
    file = ""
    for named, kind, text in PART.findall((GUIDES / f"{guide}.md").read_text(encoding="utf-8")):
        if named:
            file = named
        elif kind == "text":
            found[-1].prints += text.splitlines()
        else:
            found.append(Step(kind, text, "" if kind == "sh" else file))
    return found


def applied(step: Step, tree: Path) -> None:
    """Write a new file, or change one where its text before stands exactly once."""
    path = tree / step.file
    if step.kind != "diff":
        assert not path.exists(), f"{step.file} exists already"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(step.text, encoding="utf-8")
        return
    lines = step.text.splitlines(keepends=True)
    before = "".join(line[1:] for line in lines if line[0] in " -")
    after = "".join(line[1:] for line in lines if line[0] in " +")
    text = path.read_text(encoding="utf-8")
    assert text.count(before) == 1, f"{step.file} holds this {text.count(before)} times, not once:\n{before}"
    path.write_text(text.replace(before, after), encoding="utf-8")


def commands(text: str) -> str:
    """The commands of a block; of `make TARGET` the recipe, for make would set the copy up first."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for line in re.findall(r"^make .*$", text, re.MULTILINE):
        target, _, variables = line.removeprefix("make ").partition(" ")
        wanted = re.search(rf"^{target}:.*\n((?:\t.*\n)+)", makefile, re.MULTILINE)
        assert wanted, f"no target {target} in the Makefile"
        recipe = re.sub(r"^\t@?", "", wanted[1], flags=re.MULTILINE).replace("$(BIN)", ".venv/bin")
        for name, value in re.findall(r"(\w+)=\"([^\"]*)\"", variables):
            recipe = recipe.replace(f"$({name})", value)
        text = text.replace(line + "\n", recipe)
    return text


def copied(folder: Path) -> Path:
    """The project as it is now, with the Python and the browser parts of this one."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        check=True,
        capture_output=True,
        text=True,
    )
    for name in filter(None, listed.stdout.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    (folder / ".venv").symlink_to(sys.prefix)
    (folder / "frontend" / "static" / "vendor").symlink_to(ROOT / "frontend" / "static" / "vendor")
    return folder


def run(command: str, tree: Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(tree), "RTHS_CACHE": str(tree.parent / "cache")}
    return subprocess.run(
        ["bash", "-e", "-c", command], cwd=tree, env=environment, capture_output=True, text=True, timeout=LONG_S
    )


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy in which the code of every guide is applied."""
    folder = copied(tmp_path_factory.mktemp("followed") / "project")
    for name in NAMES:
        for step in steps(name):
            if step.kind != "sh":
                applied(step, folder)
    return folder


def test_the_code_of_the_guides_passes_the_linter_and_its_formatter(tree: Path) -> None:
    done = run(".venv/bin/ruff check . && .venv/bin/ruff format --check .", tree)
    assert done.returncode == 0, done.stdout


def test_what_the_guides_add_is_in_the_schema_the_documents_and_the_pages(tree: Path) -> None:
    code = """
import json
from pathlib import Path
from app.config import Settings
from app.documents.tables import TABLES
from app.main import create_app
from rths_engine.parts import physics, specimens
from rths_engine.results.measures import MEASURES
print(json.dumps({
    "specimens": [one.model_fields["kind"].default for one in specimens.KINDS],
    "effects": [one.model_fields["kind"].default for one in physics.SPECIMEN],
    "measures": [one.key for one in MEASURES],
    "documents": [TABLES[name]() for name in ("specimens", "effects of a specimen", "further measures")],
    "page": str(create_app(Settings(data=Path("data"), embedded_worker=False)).url_path_for("motions")),
}))
"""
    done = run(f".venv/bin/python -c '{code}'", tree)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["specimens"][-1] == "fluid_viscous" and "`fluid_viscous.exponent`" in found["documents"][0]
    assert found["effects"][-1] == "quadratic_damping" and "`quadratic_damping.coefficient`" in found["documents"][1]
    assert "rms_force_kN" in found["measures"] and "`rms_force_kN`" in found["documents"][2]
    assert found["page"] == "/motions"


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_a_guide_followed_to_the_letter_ends_as_it_says(name: str, tmp_path: Path) -> None:
    tree = copied(tmp_path / "project")
    for step in steps(name):
        if step.kind != "sh":
            applied(step, tree)
            continue
        done = run(commands(step.text), tree)
        said = done.stdout + done.stderr
        code = int((re.search(r"# exit code (\d)", step.text) or [0, 0])[1])
        assert done.returncode == code, f"{step.text}\n{said}"
        assert [line for line in step.prints if line not in said] == [], f"{step.text}\n{said}"
