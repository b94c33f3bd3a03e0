"""What a request does, in the words of the audit log: the words of its address and the name of its endpoint, `runs.cancel`."""

from __future__ import annotations

import re
from typing import Any

PREFIX = "/api/v1/"
SAFE = frozenset({"GET", "HEAD", "OPTIONS"})
CALCULATIONS = frozenset(
    {
        "/api/v1/control/{rig_id}/renew",  # every minute by an open page; it gives the control to nobody
        "/api/v1/motions/contents",
        "/api/v1/motions/preview",
        "/api/v1/plans/check",
        "/api/v1/plans/drive",
        "/api/v1/plans/identify",
        "/api/v1/plans/preflight",
        "/api/v1/plans/read",
        "/api/v1/plans/write",
        "/api/v1/recordings/preview",
        "/api/v1/sign-in/link/read",  # each time its page is opened; the link stays valid
        "/api/v1/runs/{run_id}/designsafe.zip",
        "/api/v1/runs/{run_id}/designsafe/check",
        "/api/v1/stability",
        "/api/v1/sweeps/fields",
        "/api/v1/sweeps/preview",
    }
)
"""Addresses whose POST requests change nothing that matters later. A new address is recorded until it stands here."""
UNKNOWN = "unknown address"  # of a request that leads nowhere: whatever was typed there, a secret perhaps, is not kept
LEFT_OUT = "left out"
KEY = re.compile(r"rths_[\w-]*|(?<![\w-])[\w-]{43}(?![\w-])")  # forms of the keys of app/accounts/keys.py


def without_keys(path: str) -> str:
    """An address without what has the form of a secret key."""
    return KEY.sub(LEFT_OUT, path)


def changes(method: str, route: Any) -> bool:
    """Whether a request to a route may change something, and is recorded when it succeeds."""
    return method not in SAFE and not (method == "POST" and _path(route) in CALCULATIONS)


def action(route: Any, path: str) -> str:
    """The action of a request: `runs.cancel`, `runs.annotations.add`; for an address without a route its first word."""
    name = str(getattr(route, "name", "") or "")
    if path == UNKNOWN:
        return "unknown"
    if not name:
        return area_of(path)
    words = [word for word in _path(route).removeprefix(PREFIX).strip("/").split("/") if word and "{" not in word]
    if words and words[-1].replace("-", "_") == name:
        del words[-1]
    return ".".join([*words, name])


def area_of(path: str) -> str:
    """The first word of an address below /api/v1; of a page, the first word of its address."""
    return path.removeprefix(PREFIX).lstrip("/").partition("/")[0] or "pages"


def about(parameters: dict[str, Any]) -> str:
    """What a request is about: the first parameter of its address, `run:ID`; empty without one."""
    for name, value in parameters.items():
        return f"{name.removesuffix('_id')}:{value}"
    return ""


def _path(route: Any) -> str:
    return str(getattr(route, "path", ""))
