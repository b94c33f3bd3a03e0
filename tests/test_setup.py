"""`make setup`: what it installs is pinned, what is up to date is left alone, what failed is done again."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tomllib
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from ruamel.yaml import YAML

from app import npm_parts

ROOT = Path(__file__).parent.parent
LOCK = re.split(r"\n(?=\S)", re.sub(r"^#.*\n", "", (ROOT / "requirements.lock").read_text(), flags=re.MULTILINE).strip())
PINS = {canonicalize_name(one.partition("==")[0]): one.partition("==")[2].split()[0] for one in LOCK}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
PACKAGE = json.loads((ROOT / "frontend" / "package.json").read_text())
NPM = PACKAGE["dependencies"]
NPM_LOCK = json.loads((ROOT / "frontend" / "package-lock.json").read_text())["packages"]
MADE_FROM = ["Makefile", "requirements.lock", "pyproject.toml", "app/npm_parts.py", "rths_engine/foundation/kernel.py"]
MADE_FROM += [f"frontend/{name}" for name in ("package.json", "package-lock.json", ".npmrc")]

# stands for Python: makes environments whose own Python notes what it is asked, and fails while a file 'broken' is there
PYTHON = """#!/bin/sh
[ "$1 $2" = "-m venv" ] || exit 0
mkdir -p $3/bin
printf '#!/bin/sh\\necho "$*" >> asked; [ ! -e broken ]\\n' > $3/bin/python
chmod +x $3/bin/python
"""


def test_every_python_package_is_pinned_to_one_version_and_to_the_checksums_of_its_files() -> None:
    """Where this fails, `make lock` writes the file; pip refuses a package without a checksum."""
    pin, files = r"[A-Za-z0-9._-]+==[A-Za-z0-9.]+( ; [^\\]+)?", r"( \\\n    --hash=sha256:[0-9a-f]{64})+"
    assert all(re.fullmatch(pin + files, one) for one in LOCK)
    assert len(PINS) == len(LOCK)


def test_the_lock_is_installed_by_checksum() -> None:
    recipe = (ROOT / "Makefile").read_text()
    assert "install --no-deps --require-hashes -r requirements.lock" in recipe


EXTRAS = PROJECT["optional-dependencies"]
WANTED = [*PROJECT["dependencies"], *EXTRAS["formats"], *(one for one in EXTRAS["test"] if not one.startswith(PROJECT["name"]))]


@pytest.mark.parametrize("wanted", WANTED)
def test_what_the_project_needs_is_in_the_lock(wanted: str) -> None:
    requirement = Requirement(wanted)
    assert requirement.specifier.contains(PINS[canonicalize_name(requirement.name)])


@pytest.mark.parametrize("name", ["numpy", "scipy", "numba", "fastapi", "dbos", "pydantic", "sqlalchemy"])
def test_the_tests_run_on_the_pinned_versions(name: str) -> None:
    assert version(name) == PINS[canonicalize_name(name)]


def test_every_browser_part_is_pinned_and_checked_without_an_address() -> None:
    pinned = {**NPM, **PACKAGE["devDependencies"]}
    assert all(re.fullmatch(r"[\d.]+", pin) for pin in pinned.values())
    for path, package in NPM_LOCK.items():
        if path:
            assert package["integrity"].startswith("sha512-") and "resolved" not in package
    for name, pin in pinned.items():
        assert NPM_LOCK[f"node_modules/{name}"]["version"] == pin


@pytest.mark.parametrize("name", NPM)
def test_a_browser_part_comes_with_its_licence(name: str) -> None:
    assert any(source.startswith(f"{name}/LICENSE") for source in npm_parts.PARTS)


def test_parts_are_copied_where_pages_load_them(tmp_path: Path) -> None:
    for source in npm_parts.PARTS:
        (tmp_path / "modules" / source).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "modules" / source).write_text(source)
    npm_parts.copy(tmp_path / "modules", tmp_path / "vendor")
    for source, target in npm_parts.PARTS.items():
        assert (tmp_path / "vendor" / target).read_text() == source


def test_every_part_a_page_loads_is_copied() -> None:
    pages = [*(ROOT / "frontend" / "templates").rglob("*.html"), *(ROOT / "frontend" / "static" / "js").rglob("*.js")]
    loaded = {found for page in pages for found in re.findall(r"/static/vendor/([\w./-]+)", page.read_text())}
    assert loaded and loaded <= set(npm_parts.PARTS.values())


@pytest.mark.parametrize(("found", "answer"), [("10.9.0", "machine"), ("6.14.18", "wheel"), ("", "wheel"), (None, "wheel")])
def test_npm_is_the_machines_or_else_of_the_pinned_wheel(
    found: str | None, answer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[list[str]] = []

    def run(command: list[str], **_: object) -> subprocess.CompletedProcess[str]:
        asked.append(command)
        return subprocess.CompletedProcess(command, 0, stdout=found or "")

    monkeypatch.setattr("sys.executable", str(tmp_path / "python"))
    monkeypatch.setattr(shutil, "which", lambda name: None if found is None else f"/usr/bin/{name}")
    monkeypatch.setattr(subprocess, "run", run)
    assert npm_parts.npm() == ("/usr/bin/npm" if answer == "machine" else str(tmp_path / "npm"))
    installed = [command[-1] for command in asked if "install" in command]
    assert installed == ([] if answer == "machine" else [npm_parts.NODE_WHEEL])


@pytest.mark.parametrize(
    ("there", "installs"), [(None, True), ("0.0.1", True), (PACKAGE["devDependencies"]["typescript"], False)]
)
def test_the_checker_of_the_scripts_is_installed_where_its_pinned_version_is_missing(
    there: str | None, installs: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copy(ROOT / "frontend" / "package.json", tmp_path)
    if there:
        (tmp_path / "node_modules" / "typescript").mkdir(parents=True)
        (tmp_path / "node_modules" / "typescript" / "package.json").write_text(json.dumps({"version": there}))
    asked: list[str] = []

    def run(command: list[str], **_: object) -> subprocess.CompletedProcess[str]:
        asked.append(command[1])
        return subprocess.CompletedProcess(command, 2 if command[1] == "run" else 0)

    monkeypatch.setattr(npm_parts, "FRONTEND", tmp_path)
    monkeypatch.setattr(npm_parts, "npm", lambda: "npm")
    monkeypatch.setattr(subprocess, "run", run)
    assert npm_parts.main(["check"]) == 2  # as the checker answers where types are wrong
    assert asked == (["ci", "run"] if installs else ["run"])


def test_hooks_before_a_commit_and_the_hosted_workflow_run_what_make_runs() -> None:
    yaml = YAML(typ="safe")
    hooks = [hook for repo in yaml.load(ROOT / ".pre-commit-config.yaml")["repos"] for hook in repo["hooks"]]
    recipe = (ROOT / "Makefile").read_text().partition("\ncheck: setup\n")[2].partition("\n\n")[0]
    checks = re.findall(r"\$\(BIN\)/(.*)", recipe)
    asked = {re.sub(r" --(force-exclude|check)", "", command).removesuffix(" .") for command in checks}
    assert {re.sub(r" --force-exclude", "", hook["entry"]).removeprefix(".venv/bin/") for hook in hooks} == asked
    job = yaml.load(ROOT / ".github" / "workflows" / "ci.yml")["jobs"]["run"]
    oldest = PROJECT["requires-python"].removeprefix(">=")
    assert job["container"].startswith(f"python:{oldest}-") and job["steps"][-1]["run"] == ".ci/run"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """What set-up is made from, and a stand-in for Python; only the Makefile is real."""
    for name in MADE_FROM:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    (tmp_path / "frontend" / "static" / "vendor").mkdir(parents=True)
    (tmp_path / "python").write_text(PYTHON)
    (tmp_path / "python").chmod(0o755)
    return tmp_path


@pytest.fixture
def asked(project: Path) -> Callable[[], list[str]]:
    """What `make setup` asked of the environment's Python since the last look: packages, package, parts, compiled."""
    steps = {
        "-r requirements.lock": "packages",
        "-e .": "package",
        "app.npm_parts": "parts",
        "rths_engine.running.warm": "compiled",
    }

    def since() -> list[str]:
        file = project / "asked"
        lines = file.read_text().splitlines() if file.exists() else []
        file.unlink(missing_ok=True)
        return [step for line in lines for words, step in steps.items() if line.endswith(words)]

    return since


def setup(project: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """`make setup`, as from a terminal: what a make above it says in the environment is left out."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS", "PYTHON"))}
    environment = {**clean, "PYTHON": "./python", **environment}
    return subprocess.run(["make", "setup"], cwd=project, env=environment, capture_output=True, text=True, check=False)


def later(path: Path) -> None:
    """Change a file: its time becomes later than that of everything made so far."""
    newest = max(file.stat().st_mtime_ns for file in path.parent.parent.rglob("*"))
    os.utime(path, ns=(newest + 10**9, newest + 10**9))


def test_set_up_twice_installs_once(project: Path, asked: Callable[[], list[str]]) -> None:
    assert setup(project).returncode == 0
    assert sorted(asked()) == ["compiled", "package", "packages", "parts"]
    assert setup(project).returncode == 0
    assert not asked()


@pytest.mark.parametrize(
    ("changed", "again"),
    [
        ("frontend/package-lock.json", ["parts"]),
        ("rths_engine/foundation/kernel.py", ["compiled"]),
        ("app/npm_parts.py", ["parts"]),
    ],
)
def test_what_changed_is_done_again_and_nothing_else(
    changed: str, again: list[str], project: Path, asked: Callable[[], list[str]]
) -> None:
    setup(project)
    asked()
    later(project / changed)
    assert setup(project).returncode == 0
    assert asked() == again


def test_a_step_that_failed_is_done_again(project: Path, asked: Callable[[], list[str]]) -> None:
    (project / "broken").touch()
    assert setup(project).returncode != 0
    assert asked() == ["packages"]
    assert not (project / ".venv" / "stamps" / "dependencies").exists()
    (project / "broken").unlink()
    assert setup(project).returncode == 0
    assert sorted(asked()) == ["compiled", "package", "packages", "parts"]


def test_without_a_python_that_is_new_enough_set_up_says_what_to_install(project: Path, tmp_path: Path) -> None:
    tools = tmp_path / "tools"
    tools.mkdir()
    for tool in ("make", "sh", "find", "mkdir", "touch"):
        (tools / tool).symlink_to(shutil.which(tool) or tool)
    (tools / "python3").write_text("#!/bin/sh\nexit 1\n")
    (tools / "python3").chmod(0o755)
    made = setup(project, PATH=str(tools), PYTHON="")
    assert made.returncode != 0 and not (project / ".venv").exists()
    assert "no Python 3.11 or newer" in made.stderr and "make setup PYTHON=" in made.stderr
