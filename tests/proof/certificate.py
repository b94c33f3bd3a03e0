"""The certificate: false alarms, false discoveries and power by size, for each kind of test."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

from rths_engine.diagnosis import certificate as engine
from tests.proof.summary import CLASSES, rate

FILE = Path(engine.__file__).with_name("certificate.json")
Row = dict[str, Any]


def certificate(rows: list[Row], cases: int, seed: int) -> Row:
    """The content of certificate.json. Every rate has its count and its Wilson 95 % interval."""
    kinds = sorted({row["kind"] for row in rows})
    return {
        "command": f"rths prove --certificate --cases {cases} --seed {seed}",
        "seed": seed,
        "commit": _commit(),
        "kinds": {kind: _kind([row for row in rows if row["kind"] == kind]) for kind in kinds},
    }


def _kind(rows: list[Row]) -> Row:
    claims = [{"wrong": not claim["right"]} for row in rows for claim in row["claims"]]
    sized = [row for row in rows if row["lambda"] is not None]
    return {
        "false_alarm": rate(rows, "false_alarm"),
        "false_discovery": rate(claims, "wrong"),
        "power": {
            name: rate([row for row in sized if low <= row["lambda"] < high], "named_first")
            for name, (low, high) in CLASSES.items()
        },
    }


def write(rows: list[Row], cases: int, seed: int) -> None:
    """Write the certificate that verdicts cite."""
    FILE.write_text(json.dumps(certificate(rows, cases, seed), indent=2) + "\n", encoding="utf-8")


def _commit() -> str:
    """The commit of the checkout; empty outside a repository."""
    asked = ["git", "-C", str(Path(__file__).parent), "rev-parse", "--short=12", "HEAD"]
    try:
        return subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""
