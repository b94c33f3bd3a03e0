"""Every part that the project installs: packages of Python and of npm, with version, licence, use and checksums.

Python packages are those that `pyproject.toml` leads to and that are installed. Their checksums are those of requirements.lock.
npm packages are those of package-lock.json.
"""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.metadata import Distribution, PackageNotFoundError, distribution, requires
from pathlib import Path
from typing import Any

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parent.parent.parent
PROJECT = "rths-control-room"
PRODUCT, TESTS = "product", "tests"
"""Uses of a part. A part of an optional extra has the name of the extra."""
OURSELVES = (PROJECT, "pip")  # pip comes with Python
EXTRAS = ("formats", "epics", "fmi", "s3")
UNKNOWN = "unknown"
SPDX = {  # how packages write their licence where they do not write an SPDX expression
    "MIT License": "MIT",
    "MIT license": "MIT",
    "ISC License (ISCL)": "ISC",
    "Apache 2.0": "Apache-2.0",
    "Apache License 2.0": "Apache-2.0",
    "BSD": "BSD-3-Clause",
    "BSD License": "BSD-3-Clause",
    "BSD 2-Clause License": "BSD-2-Clause",
    "BSD-0-Clause": "0BSD",
    "LGPLv3+": "LGPL-3.0-or-later",
    "Mozilla Public License 2.0 (MPL 2.0)": "MPL-2.0",
    "Python Software Foundation License": "PSF-2.0",
    "PSFL": "PSF-2.0",
    "Apache Software License": "Apache-2.0",
    "GNU Lesser General Public License v3 or later (LGPLv3+)": "LGPL-3.0-or-later",
}
SILENT = {"axe-playwright-python": "MIT", "fmpy": "BSD-2-Clause"}
"""Licences of packages whose metadata name none: read in the file LICENSE that comes with them."""
LONGEST_EXPRESSION = 80  # a longer entry is the text of the licence


@dataclass(frozen=True)
class Part:
    """A package. `licence` is an SPDX expression or `unknown`; `checksums` are (algorithm, hexadecimal digest)."""

    kind: str  # pypi | npm
    name: str
    version: str
    licence: str
    use: str
    needs: tuple[str, ...] = ()
    checksums: tuple[tuple[str, str], ...] = ()


def parts() -> list[Part]:
    """All parts, Python first, each kind in the order of names."""
    return [*python_parts(), *npm_parts()]


def python_parts() -> list[Part]:
    """The installed Python packages that the project leads to."""
    uses: dict[str, str] = {}
    for use, extras in ((PRODUCT, ("",)), *((extra, (extra,)) for extra in EXTRAS), (TESTS, ("test",))):
        for name in _reached(requires(PROJECT) or [], extras):
            uses.setdefault(name, use)
    uses.setdefault("setuptools", TESTS)  # builds the package
    sums = locked((ROOT / "requirements.lock").read_text())
    return [_python_part(name, use, sums.get(name, ())) for name, use in sorted(uses.items()) if name not in OURSELVES]


def npm_parts() -> list[Part]:
    """The npm packages of the lock file, but not the builds of TypeScript for other machines."""
    found = json.loads((ROOT / "frontend" / "package-lock.json").read_text())["packages"]
    return [_npm_part(path, one) for path, one in found.items() if path and not one.get("optional")]


def locked(text: str) -> dict[str, tuple[tuple[str, str], ...]]:
    """The checksums of each package in a requirements file with hashes."""
    found: dict[str, tuple[tuple[str, str], ...]] = {}
    for block in re.split(r"\n(?=\S)", text):
        head = re.match(r"([A-Za-z0-9._-]+)==", block)
        if head:
            found[canonicalize_name(head[1])] = tuple(re.findall(r"--hash=(sha\d+):([0-9a-f]+)", block))
    return found


def licence_of(metadata: Any) -> str:
    """The SPDX expression of a package's metadata: its expression, or else its field, or else its classifiers."""
    if expression := metadata.get("License-Expression"):
        return str(expression)
    classified = [one.split(" :: ")[-1] for one in metadata.get_all("Classifier") or [] if one.startswith("License ::")]
    field = (metadata.get("License") or "").strip()
    short = field.upper() not in ("", "UNKNOWN") and len(field) <= LONGEST_EXPRESSION and "\n" not in field
    candidates = [field] if short else []
    named = [SPDX.get(one, one) for one in candidates or classified]
    return " OR ".join(dict.fromkeys(named)) or UNKNOWN


def _reached(wanted: Iterable[str], extras: Iterable[str]) -> set[str]:
    """The names of installed packages that the requirements `wanted` lead to, with these extras of the project."""
    reached: set[tuple[str, str]] = set()
    waiting = list(_applying(wanted, extras))
    while waiting:
        requirement = waiting.pop()
        name = canonicalize_name(requirement.name)
        for extra in ("", *requirement.extras):
            if (name, extra) not in reached and (found := _installed(name)):
                reached.add((name, extra))
                waiting += _applying(found.requires or [], (extra,))
    return {name for name, _ in reached}


def _applying(wanted: Iterable[str], extras: Iterable[str]) -> Iterator[Requirement]:
    """Requirements whose marker holds here with one of `extras`."""
    for text in wanted:
        requirement = Requirement(text)
        if requirement.marker is None or any(requirement.marker.evaluate({"extra": extra}) for extra in extras):
            yield requirement


def _installed(name: str) -> Distribution | None:
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None


def _python_part(name: str, use: str, sums: tuple[tuple[str, str], ...]) -> Part:
    found = distribution(name)
    needs = {canonicalize_name(one.name) for one in _applying(found.requires or [], ("",))}
    licence = licence_of(found.metadata)
    stated = SILENT.get(name, UNKNOWN) if licence == UNKNOWN else licence
    return Part("pypi", name, found.version, stated, use, tuple(sorted(needs)), sums)


def _npm_part(path: str, one: dict[str, Any]) -> Part:
    name = path.removeprefix("node_modules/")
    algorithm, _, digest = one["integrity"].partition("-")
    sums = ((algorithm, base64.b64decode(digest).hex()),)
    licence = SPDX.get(one["license"], one["license"])
    needs = tuple(sorted(one.get("dependencies", {})))
    return Part("npm", name, one["version"], licence, TESTS if one.get("dev") else PRODUCT, needs, sums)
