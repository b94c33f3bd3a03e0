"""Truths sealed before a diagnosis: SHA-256 of a salt and every file of a sealed folder."""

from __future__ import annotations

import hashlib
import json
import secrets
from pathlib import Path

SALT, SEALS = "salt", "seals.json"


class SealBroken(Exception):
    """A truth differs from the truth that was sealed."""


def seal(sealed: Path, listed: Path) -> dict[str, str]:
    """Salt every folder of `sealed` and write the digests to `listed`, before any diagnosis."""
    digests = {}
    for folder in sorted(sealed.iterdir()):
        (folder / SALT).write_text(secrets.token_hex(16), encoding="ascii")
        digests[folder.name] = digest(folder)
    listed.write_text(json.dumps(digests, indent=1) + "\n", encoding="utf-8")
    return digests


def verify(sealed: Path, digests: dict[str, str]) -> None:
    """Verify the seals. Raises SealBroken where a truth was changed, removed or added after sealing."""
    names = {folder.name for folder in sealed.iterdir()}
    if names != set(digests):
        raise SealBroken(f"sealed were {len(digests)} cases; there are {len(names)}: {sorted(names ^ set(digests))}")
    for name, expected in digests.items():
        if digest(sealed / name) != expected:
            raise SealBroken(f"the truth of {name} is not the one that was sealed")


def digest(folder: Path) -> str:
    made = hashlib.sha256((folder / SALT).read_bytes())
    for file in sorted(one for one in folder.iterdir() if one.name != SALT):
        content = file.read_bytes()
        made.update(f"{file.name}\0{len(content)}\0".encode())
        made.update(content)
    return made.hexdigest()
