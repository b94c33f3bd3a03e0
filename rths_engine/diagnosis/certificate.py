"""The certificate's line for a kind of test. `rths prove --certificate` writes certificate.json."""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import Any

from rths_engine.diagnosis.schema import Certificate

CLEAR = ">=100"  # the class of λ whose power a verdict cites


@cache
def _table() -> dict[str, Any]:
    found: dict[str, Any] = json.loads((files(__package__) / "certificate.json").read_text(encoding="utf-8"))
    return found


def line(kind: str) -> Certificate | None:
    """The measured error rates for a kind of test; None where the certificate has no such kind."""
    table = _table()
    rates = table["kinds"].get(kind)
    if rates is None:
        return None
    return Certificate.read(
        {
            "kind": kind,
            "false_alarm": rates["false_alarm"],
            "false_discovery": rates["false_discovery"],
            "power": rates["power"][CLEAR],
            "seed": table["seed"],
            "commit": table["commit"],
        }
    )
