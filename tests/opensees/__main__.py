"""`make prove-opensees`: diagnose recordings that conceal material laws of OpenSees, and print a table of the verdicts."""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from rths_engine.diagnosis.schema import Verdict
from tests.opensees.concealed import Case, cases
from tests.opensees.judged import REACHED, judged
from tests.opensees.peer import missing

LIMIT = 300  # s of processor time for one diagnosis; beyond it there is no verdict
CHECKOUT = Path(__file__).parents[2]


def diagnosed(case: Case, folder: Path) -> dict[str, Any]:
    """The row of a case whose files are in `folder`, by the public command in a process of its own."""
    out = folder / "verdict.json"
    files = [str(folder / name) for name in ("plan.yaml", "fit.h5", "heldout1.h5", "heldout2.h5")]
    command = [sys.executable, "-m", "app.cli", "diagnose", *files[:2], "--holdout", *files[2:], "--json", str(out)]
    limited = ["sh", "-c", f'ulimit -t {LIMIT}; exec "$@"', "sh", *command]
    with (folder / "said.txt").open("w") as said:
        process = subprocess.Popen(limited, cwd=CHECKOUT, stdout=said, stderr=said)
        _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    found = Verdict.read(json.loads(out.read_text(encoding="utf-8"))) if out.exists() else None
    row = judged(case.kind, case.truth, found)
    return {
        "case": case.name,
        "kind": case.kind,
        "law": case.truth.title,
        "noise": case.noise,
        **row,
        "seconds": used.ru_utime + used.ru_stime,
    }


def proved(case: Case, root: Path) -> dict[str, Any]:
    folder = root / case.name
    case.write(folder)
    row = diagnosed(case, folder)
    print(f"{case.name}: {row['outcome']}, {row['seconds']:.0f} s", file=sys.stderr, flush=True)
    return row


def line(row: dict[str, Any]) -> str:
    """A row of the table in Markdown."""
    claims = ", ".join(
        f"{one['name'].partition('/')[2]} {one['probability']:.2f}{' (part of it)' if one['part_of_it'] else ''}"
        for one in row["claims"]
    )
    before, after = ("-" if one is None else f"{100 * one:.3g} %" for one in row["heldout"])
    share = "-" if row["remaining"] is None else f"{100 * row['remaining']:.0f} %"
    cells = [
        row["kind"],
        row["law"],
        row["noise"],
        row["outcome"],
        claims or "-",
        f"{before} → {after}",
        share,
        f"{row['seconds']:.0f}",
    ]
    return f"| {' | '.join(cells)} |"


def table(rows: list[dict[str, Any]]) -> str:
    """Every case, and below the counts of the outcomes."""
    head = ["test", "law", "noise", "outcome", "named effects with probability", "held-out error", "remaining", "s"]
    lines = [f"| {' | '.join(head)} |", f"|{'---|' * len(head)}", *(line(row) for row in rows)]
    counts = Counter(row["outcome"] for row in rows)
    reached = sum(counts[one] for one in REACHED)
    shares = ", ".join(f"{name} {count}" for name, count in counts.most_common())
    return "\n".join([*lines, "", f"{reached} of {len(rows)} named, near, honestly unknown or in agreement ({shares})"])


def main() -> None:
    asked = argparse.ArgumentParser(prog="python -m tests.opensees", description=__doc__)
    asked.add_argument("--seed", type=int, default=0, help="seed of the cases (default %(default)s)")
    asked.add_argument("--only", default="", metavar="TEXT", help="only cases whose names contain the text: specimen-gap, low")
    asked.add_argument("--workers", type=int, default=2, metavar="N", help="diagnoses at the same time (default %(default)s)")
    asked.add_argument("--keep", type=Path, metavar="DIR", help="folder to store plans, recordings and verdicts in")
    asked.add_argument("--json", type=Path, metavar="OUT", help="write the rows as JSON")
    given = asked.parse_args()
    if reason := missing():
        asked.exit(2, reason + "\n")
    chosen = cases(given.seed, given.only)
    with tempfile.TemporaryDirectory(prefix="rths-opensees-") as passing, ThreadPoolExecutor(given.workers) as pool:
        root = given.keep or Path(passing)
        rows = list(pool.map(lambda case: proved(case, root), chosen))
    if given.json:
        given.json.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    print(table(rows))


if __name__ == "__main__":
    main()
