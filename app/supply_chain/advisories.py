"""Ask the advisory services of PyPI and npm for known vulnerabilities of the pinned packages.

pip-audit reads requirements.lock, npm reads package-lock.json; neither installs anything. A service that cannot be reached, or
that does not know a package, is no proof of safety: such packages are counted and reported as not checked. pip-audit itself
calls a package that its service does not know "skipped" and still ends with "No known vulnerabilities found".
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app import npm_parts
from app.supply_chain.parts import ROOT

PATIENCE_S = 300
SERVICE_TIMEOUT_S = 10
AUDIT = ["-m", "pip_audit", "--require-hashes", "--disable-pip", "--progress-spinner", "off", "--format", "json"]

Run = Callable[..., "subprocess.CompletedProcess[str]"]


@dataclass(frozen=True)
class Answer:
    """What a service says: vulnerabilities found, one sentence each, and how many packages were and were not checked."""

    service: str
    found: tuple[str, ...] = ()
    checked: int = 0
    unchecked: int = 0
    why: str = ""

    @property
    def complete(self) -> bool:
        """Whether every package was checked."""
        return self.checked > 0 and not self.unchecked

    @property
    def text(self) -> str:
        """The answer in one line."""
        if not self.complete:
            number = str(self.unchecked) if self.unchecked else "all"
            rest = f"{self.checked} checked, {len(self.found)} vulnerabilities found"
            return f"{self.service}: NOT CHECKED: {number} packages ({self.why}); {rest}"
        return f"{self.service}: {self.checked} packages checked, {len(self.found)} vulnerabilities found"


def python(lock: Path = ROOT / "requirements.lock", run: Run = subprocess.run) -> Answer:
    """Known vulnerabilities of the packages in requirements.lock."""
    command = [sys.executable, *AUDIT, "--timeout", str(SERVICE_TIMEOUT_S), "--requirement", str(lock)]
    told = _told(run, command, ROOT)
    if not told or "dependencies" not in told:
        return Answer("Python (PyPI)", why="the service cannot be reached")
    known = [one for one in told["dependencies"] if "skip_reason" not in one]
    found = tuple(f"{one['name']} {one['version']}: {_python_advisory(each)}" for one in known for each in one["vulns"])
    skipped = len(told["dependencies"]) - len(known)
    return Answer("Python (PyPI)", found, len(known), skipped, "the service does not know them" if skipped else "")


def npm(run: Run = subprocess.run) -> Answer:
    """Known vulnerabilities of the packages in package-lock.json."""
    told = _told(run, [npm_parts.npm(), "audit", "--json"], npm_parts.FRONTEND)
    if not told or "vulnerabilities" not in told:
        return Answer("npm", why="the service cannot be reached")
    found = tuple(f"{name}: {one['severity']}, fixed by {one['fixAvailable']}" for name, one in told["vulnerabilities"].items())
    return Answer("npm", found, told["metadata"]["dependencies"]["total"])


def _told(run: Run, command: list[str], folder: Path) -> dict[str, Any] | None:
    """The JSON object that a command prints, or None."""
    try:
        ended = run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
        told = json.loads(ended.stdout)
    except (OSError, ValueError, subprocess.TimeoutExpired):
        return None
    return told if isinstance(told, dict) else None


def _python_advisory(one: dict[str, Any]) -> str:
    fixed = ", ".join(one.get("fix_versions", [])) or "no release yet"
    return f"{one['id']}, fixed by {fixed}"
