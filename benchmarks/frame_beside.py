"""`python -m benchmarks.frame_beside [COMMIT]`: a step of the inelastic frame in this build, a clone of COMMIT and OpenSees.

All three take turns, each in a process of its own, and their ratios are those of one round. Every time is processor time, which
does not count the waiting for a core; the times of the engine are the fastest of many runs. Writes `frame_step.json` and
`frame_step.svg` beside this file: time against the bytes that a step touches, with the time to read as many bytes.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from benchmarks.frame_drawing import svg
from benchmarks.plans import STEP, alone, frame, ground
from benchmarks.scaling import read_seconds
from rths_engine.parts.structures.moment_frame import MomentFrame
from tests.opensees import peer

CHECKOUT = Path(__file__).parents[1]
BEFORE = "562ca28"
ROUNDS = 3
PAPER = (2, 4)  # storeys and bays of the paper's frame, 122 degrees of freedom
SIZES = ((1, 3), PAPER, (4, 5), (8, 4), (10, 7))
SYSTEM = "SparseGeneral"  # OpenSees' fastest equation system for this frame (`against_opensees`)
READ_KB = (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096)
AGREE = 1e-6  # of the last displacement; both builds compute the same frame, within rounding


def main(commit: str) -> None:
    """Clone the commit, measure in turns, print the figures, and write them with their chart."""
    with tempfile.TemporaryDirectory(prefix="rths-beside-") as folder:
        clone = Path(folder) / "clone"
        subprocess.run(["git", "clone", "--quiet", "--no-checkout", str(CHECKOUT), str(clone)], check=True)
        subprocess.run(["git", "-C", str(clone), "checkout", "--quiet", commit], check=True)
        rounds = [(_ours(clone, (PAPER,))[0], _ours(CHECKOUT, (PAPER,))[0], _opensees()) for _ in range(ROUNDS)]
        before, now = _ours(clone, SIZES), _ours(CHECKOUT, SIZES)
    found = {
        "commit_before": commit,
        "paper": _paper(rounds),
        "before": before,
        "now": now,
        "read": [{"kb": kb, "us": read_seconds(kb * 1024) * 1e6} for kb in READ_KB],
        "load": round(os.getloadavg()[0], 1),
    }
    print(json.dumps(found["paper"], indent=2))
    Path(__file__).with_name("frame_step.json").write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
    Path(__file__).with_name("frame_step.svg").write_text(svg(found), encoding="utf-8")


def _ours(tree: Path, sizes: tuple[tuple[int, int], ...]) -> list[dict[str, Any]]:
    environment = {**os.environ, "PYTHONPATH": str(tree), "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, str(CHECKOUT / "benchmarks" / "one_frame.py"), json.dumps(sizes)]
    done = subprocess.run(command, env=environment, cwd=tree, capture_output=True, text=True, check=True)
    found: list[dict[str, Any]] = json.loads(done.stdout)
    return found


def _opensees() -> float | None:
    """Microseconds of a step of the paper's frame in OpenSees; None without OpenSees."""
    if peer.missing():
        return None
    plan = alone(frame(*PAPER, inelastic=True), 30.0)
    assert isinstance(plan.structure, MomentFrame)
    more = {"acceleration": ground(plan), "dt": STEP, "scheme": "alpha_os", "system": SYSTEM}
    answer = peer.ask("timing", plan.structure, inelastic=True, **more)
    return float(answer["seconds"] / answer["steps"] * 1e6)


def _paper(rounds: list[tuple[dict[str, Any], dict[str, Any], float | None]]) -> dict[str, Any]:
    """The figures of the paper's frame: medians of the rounds, and the ratios within each round."""
    for before, now, _ in rounds:
        if not np.allclose(before["last_m"], now["last_m"], rtol=AGREE):
            raise RuntimeError(f"the builds end at {before['last_m']} and {now['last_m']} m: not the same frame")
    gains = [before["step_us"] / now["step_us"] for before, now, _ in rounds]
    found = {
        "before_us": median(before["step_us"] for before, _, _ in rounds),
        "now_us": median(now["step_us"] for _, now, _ in rounds),
        "times_faster": median(gains),
        "times_faster_range": [min(gains), max(gains)],
    }
    theirs = [(us, now["step_us"]) for _, now, us in rounds if us is not None]
    if theirs:
        found["opensees_us"] = median(us for us, _ in theirs)
        found["opensees_over_now"] = median(us / now for us, now in theirs)
    else:
        found["opensees"] = peer.missing()
    return found


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else BEFORE)
