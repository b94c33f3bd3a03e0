"""The manifest of a backup: every file with its checksum and size, and what the rows hold. A checksum of its own guards it."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RthsError

FORMAT = "rths-backup/1"
NAME, SEAL = "manifest.json", "manifest.sha256"
DATABASE = "rths.sqlite"
SHA256 = re.compile(r"[0-9a-f]{64}")
FIX = "take another backup: this one cannot be trusted"


@dataclass(frozen=True, slots=True)
class Kept:
    """Checksum (hex SHA-256) and size (bytes) of a file of a backup."""

    sha256: str
    size: int


@dataclass(frozen=True, slots=True)
class Manifest:
    """What a backup holds. `rows` counts the rows of each table, `files` has every file by its path in the backup.

    `audit` is the head of the audit log, `damaged` names the files that were missing or damaged when the backup was made.
    """

    made_at: str
    version: str
    schema: str
    rows: dict[str, int]
    audit: dict[str, Any]
    files: dict[str, Kept]
    damaged: dict[str, str] = field(default_factory=dict)

    def write(self, folder: Path) -> None:
        """Write the manifest and its checksum, which make the backup complete."""
        path = folder / NAME
        path.write_text(json.dumps({"format": FORMAT, **asdict(self)}, indent=1, sort_keys=True), encoding="utf-8")
        files.sync(path)
        (folder / SEAL).write_text(f"{files.checksum(path)}  {NAME}\n", encoding="utf-8")
        files.sync(folder / SEAL)
        files.sync(folder)


def read(folder: Path) -> Manifest:
    """The manifest of a backup. Raises RthsError where it is missing, altered, or names files outside the backup."""
    path = folder / NAME
    try:
        stated, found = (folder / SEAL).read_text(encoding="utf-8").split(" ")[0], files.checksum(path)
        data = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        fix = "give the folder of one backup; a backup that was interrupted has no manifest"
        raise RthsError(Issue("backup", f"is not complete: it has no {Path(error.filename).name}", str(folder), fix)) from None
    except (OSError, ValueError) as error:
        raise RthsError(Issue(NAME, f"cannot be read: {error}", str(folder), FIX)) from None
    if stated != found:
        raise RthsError(Issue(NAME, f"is damaged: its SHA-256 is {found}; {SEAL} states {stated}", str(folder), FIX))
    if not isinstance(data, dict) or data.pop("format", None) != FORMAT:
        raise RthsError(Issue(NAME, f"is not of the format {FORMAT}", str(folder), "restore it with the version that made it"))
    try:
        kept = {name: Kept(**one) for name, one in data.pop("files").items()}
        manifest = Manifest(files=kept, **data)
    except (TypeError, AttributeError, KeyError):
        raise RthsError(Issue(NAME, f"is not of the format {FORMAT}", str(folder), FIX)) from None
    for name, one in kept.items():
        if not _inside(name) or not SHA256.fullmatch(one.sha256):
            raise RthsError(Issue(NAME, f"has an entry that is not a file of the backup: {name}", str(folder), FIX))
    return manifest


def check(folder: Path, manifest: Manifest) -> None:
    """Compare every file with the manifest. Raises RthsError with every file that is missing or damaged."""
    issues = []
    for name, kept in sorted(manifest.files.items()):
        path = folder / name
        if not path.is_file():
            issues.append(Issue(name, "is missing from the backup", None, FIX))
        elif path.stat().st_size != kept.size:
            issues.append(
                Issue(name, f"is damaged: it has {path.stat().st_size} bytes; the manifest states {kept.size}", None, FIX)
            )
        elif (found := files.checksum(path)) != kept.sha256:
            issues.append(Issue(name, f"is damaged: its SHA-256 is {found}; the manifest states {kept.sha256}", None, FIX))
    if issues:
        raise RthsError(issues)


def _inside(name: str) -> bool:
    path = PurePosixPath(name)
    return bool(name) and not path.is_absolute() and ".." not in path.parts and "\\" not in name
