"""Licences, advisories and the list of parts: what is installed passes, and what must not pass is refused."""

from __future__ import annotations

import json
import subprocess
import tomllib
from dataclasses import replace
from email.message import Message
from pathlib import Path
from typing import Any

import pytest

from app.supply_chain import advisories, licences, sbom
from app.supply_chain.__main__ import told
from app.supply_chain.parts import EXTRAS, ROOT, Part, licence_of, locked, parts

FOUND = parts()
HTTPX = Part("pypi", "httpx", "0.28.1", "BSD-3-Clause", "product")
NEVER: dict[str, licences.Reason] = {}


def test_every_installed_part_has_an_allowed_licence_or_a_reason() -> None:
    assert licences.problems(FOUND) == []


def test_the_optional_extras_are_those_of_the_project() -> None:
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    assert f"rths-control-room[{','.join(EXTRAS)}]" in extras["test"]


@pytest.mark.parametrize(
    ("licence", "wrong"),
    [
        ("MIT", False),
        ("MPL-2.0 OR MIT", False),
        ("MPL-2.0 AND MIT", True),
        ("GPL-3.0-only", True),
        ("Apache-2.0 WITH LLVM-exception", False),
        ("GPL-2.0-only WITH Classpath-exception-2.0", True),
        ("unknown", True),
        ("our own words", True),
        ("", True),
    ],
)
def test_a_licence_without_an_allowed_choice_is_refused(licence: str, wrong: bool) -> None:
    assert licences.refused(licence) is wrong
    assert len(licences.problems([replace(HTTPX, licence=licence)], NEVER)) == wrong


def test_a_reason_holds_for_one_licence_in_one_place_and_only_while_it_is_needed() -> None:
    reasons = {"httpx": licences.Reason("MPL-2.0", "tests", "A reason.")}
    assert licences.problems([replace(HTTPX, licence="MPL-2.0", use="tests")], reasons) == []
    for part in (replace(HTTPX, licence="MPL-2.0"), replace(HTTPX, licence="GPL-3.0-only", use="tests"), HTTPX):
        assert len(licences.problems([part], reasons)) == 1
    assert licences.problems([], reasons) == ["httpx has a line in REASONS, but is not installed."]


@pytest.mark.parametrize(
    ("fields", "licence"),
    [
        ([("License-Expression", "MIT OR Apache-2.0"), ("License", "BSD")], "MIT OR Apache-2.0"),
        ([("License", "BSD")], "BSD-3-Clause"),
        ([("License", "UNKNOWN"), ("Classifier", "License :: OSI Approved :: MIT License")], "MIT"),
        (
            [("License", "Copyright. " * 9), ("Classifier", "License :: OSI Approved :: BSD License")],
            "BSD-3-Clause",
        ),
        ([("Classifier", "Topic :: Testing")], "unknown"),
    ],
)
def test_a_licence_is_read_from_the_expression_the_field_or_the_classifiers(
    fields: list[tuple[str, str]], licence: str
) -> None:
    metadata = Message()
    for key, value in fields:
        metadata[key] = value
    assert licence_of(metadata) == licence


def test_the_list_of_parts_is_valid_and_names_every_part_with_the_checksums_of_the_lock_files() -> None:
    document = json.loads(sbom.document(FOUND))  # which checks it against the schema of CycloneDX
    listed = {one["bom-ref"]: one for one in document["components"]}
    assert set(listed) == {f"{one.kind}:{one.name}" for one in FOUND}
    assert {"pypi:numpy", "pypi:fastapi", "npm:uplot", "npm:@picocss/pico"} <= set(listed)
    scopes = {name: listed[name]["scope"] for name in ("pypi:fastapi", "pypi:asammdf", "pypi:pytest", "npm:typescript")}
    assert list(scopes.values()) == ["required", "optional", "excluded", "excluded"]
    sums = locked((ROOT / "requirements.lock").read_text())["numpy"]
    (files,) = listed["pypi:numpy"]["externalReferences"]
    assert {one["content"] for one in files["hashes"]} == {digest for _, digest in sums}
    assert all(one["externalReferences"] for one in listed.values())
    needs = {one["ref"]: one.get("dependsOn", []) for one in document["dependencies"]}
    assert "pypi:starlette" in needs["pypi:fastapi"]


def test_a_list_of_parts_that_its_schema_does_not_allow_is_not_written() -> None:
    with pytest.raises(ValueError, match="not valid by the schema"):
        sbom.document([replace(HTTPX, checksums=(("sha256", "no digest"),))])


def answering(output: Any) -> advisories.Run:
    """Stands for pip-audit or npm: prints an answer of its service."""

    def run(command: list[str], **_: Any) -> subprocess.CompletedProcess[str]:
        if output is None:
            raise subprocess.TimeoutExpired(command, 1)
        return subprocess.CompletedProcess(command, 0, stdout=output if isinstance(output, str) else json.dumps(output))

    return run


KNOWN = {"name": "httpx", "version": "0.1", "vulns": [{"id": "PYSEC-2000-1", "fix_versions": ["0.2"]}]}
CLEAN = {"name": "h11", "version": "0.16", "vulns": []}
SKIPPED = {"name": "numpy", "skip_reason": "not found"}
LOCK = Path("requirements.lock")


@pytest.mark.parametrize(
    ("output", "code", "words"),
    [
        ({"dependencies": [CLEAN]}, 0, "1 packages checked, 0 vulnerabilities"),
        ({"dependencies": [CLEAN, SKIPPED]}, 3, "NOT CHECKED: 1 packages"),
        ({"dependencies": [KNOWN, SKIPPED]}, 1, "1 vulnerabilities found"),
        ("Traceback: no such host", 3, "NOT CHECKED: all packages (the service cannot be reached)"),
        (None, 3, "NOT CHECKED: all packages"),
    ],
)
def test_a_known_vulnerability_of_a_python_package_is_told_apart_from_packages_that_were_not_checked(
    output: Any, code: int, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert told([advisories.python(LOCK, answering(output))]) == code
    printed = capsys.readouterr().out
    assert words in printed and ("PYSEC-2000-1, fixed by 0.2" in printed) == (code == 1)


@pytest.mark.parametrize(
    ("output", "code", "words"),
    [
        ({"vulnerabilities": {}, "metadata": {"dependencies": {"total": 27}}}, 0, "27 packages checked, 0 vulnerabilities"),
        (
            {
                "vulnerabilities": {"uplot": {"severity": "high", "fixAvailable": True}},
                "metadata": {"dependencies": {"total": 27}},
            },
            1,
            "uplot: high",
        ),
        ({"message": "405 Method Not Allowed", "statusCode": 405}, 3, "NOT CHECKED: all packages"),
    ],
)
def test_npm_packages_likewise(output: Any, code: int, words: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert told([advisories.npm(answering(output))]) == code
    assert words in capsys.readouterr().out


@pytest.mark.parametrize(("code", "ends", "warned"), [(0, 0, False), (3, 0, True), (1, 1, False), (2, 2, False)])
def test_ci_goes_on_with_a_warning_only_where_packages_were_not_checked(
    code: int, ends: int, warned: bool, tmp_path: Path
) -> None:
    """With stand-ins for make and Python."""
    for name, body in ((".venv/bin/python", f'[ "$3" != advisories ] || exit {code}'), ("bin/make", 'echo "made $*"')):
        program = tmp_path / name
        program.parent.mkdir(parents=True)
        program.write_text(f"#!/bin/sh\n{body}\n")
        program.chmod(0o755)
    script = tmp_path / ".ci" / "run"
    script.parent.mkdir()
    script.write_text((ROOT / ".ci" / "run").read_text())
    path = f"{tmp_path / 'bin'}:/usr/bin:/bin"
    done = subprocess.run(["bash", script], env={"PATH": path}, capture_output=True, text=True, check=False)
    assert done.returncode == ends and ("NOT CHECKED" in done.stderr) == warned
    assert done.stdout.splitlines() == ["made test", *(["made sbom"] if not ends else [])]
