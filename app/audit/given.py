"""What the audit log keeps of the body of a request: never a secret.

Two walls: a field whose name speaks of a secret is left out everywhere, and requests outside of `OPEN` (accounts, tokens,
webhooks, and whatever is added later) keep the fields of `PLAIN` only.
"""

from __future__ import annotations

import hashlib
import json
import re
from typing import Any

from app.audit.chain import canonical

LARGEST = 50_000  # bytes of a body that is read; of a larger one the checksum is kept
LONGEST = 2000  # characters of a body that is kept; of a longer one the names of its fields and the checksum
LONGEST_TEXT = 300
MOST_FIELDS = 50
LEFT_OUT = "left out"
SECRET = re.compile("pass|secret|token|credential|cookie|authori[sz]|signature|link|code|key$|url|otp", re.IGNORECASE)
OPEN = frozenset(
    [
        "abort",
        "annotations",
        "approvals",
        "control",
        "diagnoses",
        "laboratory",
        "league",
        "library",
        "mappings",
        "motions",
        "plans",
        "queue",
        "recordings",
        "retention",
        "rigs",
        "rules",
        "runs",
        "stability",
        "sweeps",
        "table4",
    ]
)
"""First words of the addresses below /api/v1 whose requests hold no secrets."""
PLAIN = frozenset(
    [
        "by",
        "name",
        "names",
        "role",
        "roles",
        "scopes",
        "expires",
        "expires_at",
        "enabled",
        "kinds",
        "days",
        "reason",
        "disabled",
    ]
)


def kept(area: str, body: bytes) -> dict[str, Any]:
    """The part of a JSON body that an entry keeps. `area` is the first word of the address."""
    data = _read(body) if len(body) <= LARGEST else None
    if data is None:
        return _measured(body) if body and area in OPEN else {}
    shown = {name: value for name, value in data.items() if area in OPEN or name in PLAIN}
    try:
        shown = _without_secrets(shown)
        if len(canonical(shown)) <= LONGEST:
            return shown
    except RecursionError:
        pass
    return {"by": name_in(data), "fields": sorted(map(_cut, shown))[:MOST_FIELDS], **_measured(body)}


def name_in(given: dict[str, Any]) -> str:
    """The name of a person that a request gives; empty without one."""
    for field in ("by", "submitted_by", "saved_by"):
        named = given.get(field)
        if isinstance(named, str) and named.strip():
            return named.strip()
    return ""


def _read(body: bytes) -> dict[str, Any] | None:
    try:
        data = json.loads(body)
    except (ValueError, RecursionError):
        return None
    return data if isinstance(data, dict) else None


def _measured(body: bytes) -> dict[str, Any]:
    return {"bytes": len(body), "sha256": hashlib.sha256(body).hexdigest()}


def _without_secrets(data: dict[str, Any]) -> dict[str, Any]:
    return {name: LEFT_OUT if SECRET.search(name) else _shown(value) for name, value in data.items()}


def _shown(data: Any) -> Any:
    if isinstance(data, dict):
        return _without_secrets(data)
    if isinstance(data, list):
        return [_shown(one) for one in data]
    return _cut(data) if isinstance(data, str) else data


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}…"
