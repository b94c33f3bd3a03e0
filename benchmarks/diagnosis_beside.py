"""`python -m benchmarks.diagnosis_beside [COMMIT] [CASE ...]`: diagnoses of this build and of a clone of COMMIT, in turns.

The clone is made from the repository of this checkout, into a folder of its own. Each diagnosis runs in a process of its own;
its processor time does not count the waiting for a core. With OPENBLAS_NUM_THREADS=1 both builds compute linear algebra in one
thread; without it, only builds that limit these threads themselves. Prints a table for docs/benchmarks.md.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks import one_diagnosis

CHECKOUT = Path(__file__).parents[1]
BEFORE = "8847707"
ROUNDS = 3


def main(commit: str, names: Iterable[str]) -> None:
    """Clone the commit, diagnose every recording in turns with both builds, and print the table."""
    with tempfile.TemporaryDirectory(prefix="rths-beside-") as folder:
        clone = Path(folder) / "clone"
        subprocess.run(["git", "clone", "--quiet", "--no-checkout", str(CHECKOUT), str(clone)], check=True)
        subprocess.run(["git", "-C", str(clone), "checkout", "--quiet", commit], check=True)
        print(f"| recording | {commit}: processor time | this build | ratio | peak memory before | now |")
        print("|---|---|---|---|---|---|")
        for name in names:
            print(_row(name, clone), flush=True)


def _row(name: str, clone: Path) -> str:
    rounds = [(_measured(name, clone), _measured(name, CHECKOUT)) for _ in range(ROUNDS)]
    before, now = (median(pair[which]["cpu_s"] for pair in rounds) for which in (0, 1))
    memory = [max(pair[which]["peak_mb"] for pair in rounds) for which in (0, 1)]
    for then, ours in rounds[:1]:
        same = "the same effects" if then["effects"] == ours["effects"] else f"{then['effects']} before, {ours['effects']} now"
        print(f"{name}: {same}; held-out error {then['heldout_nrmse']:.3g}, now {ours['heldout_nrmse']:.3g}", file=sys.stderr)
    return f"| {name} | {before:.1f} s | {now:.1f} s | {before / now:.1f} | {memory[0]} MB | {memory[1]} MB |"


def _measured(name: str, tree: Path) -> dict[str, Any]:
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    command = [sys.executable, str(CHECKOUT / "benchmarks" / "one_diagnosis.py"), name]
    done = subprocess.run(command, env=environment, cwd=tree, capture_output=True, text=True, check=True)
    found: dict[str, Any] = json.loads(done.stdout)
    return found


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else BEFORE, sys.argv[2:] or one_diagnosis.CASES)
