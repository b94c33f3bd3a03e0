"""`make bench`: measure all times in one run, and write `results.json` and `cost_by_dof.svg` beside this file."""

from __future__ import annotations

import json
import os
import platform
import sys
from pathlib import Path
from typing import Any

from benchmarks import against_opensees, diagnoses, drawing, import_csv, scaling, whole_runs
from rths_engine.running.warm import warm
from tests.opensees import peer

FOLDER = Path(__file__).parent


def main() -> None:
    """Measure all times, print them, and write them with their chart."""
    warm()
    results: dict[str, Any] = {"machine": _machine()}
    if reason := peer.missing():
        results["opensees"] = reason
        print(f"NOT COMPARED: {reason}", file=sys.stderr)
    for part in (
        against_opensees.frame_ratios,
        whole_runs.table3,
        whole_runs.cold,
        whole_runs.two_cores,
        whole_runs.memory,
        scaling.step_by_dof,
        diagnoses.diagnoses,
        import_csv.import_csv,
    ):
        found = part()
        print(json.dumps(found, indent=2), flush=True)
        results |= found
    (FOLDER / "results.json").write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")
    (FOLDER / "cost_by_dof.svg").write_text(drawing.svg(results["step_us_by_dof"]), encoding="utf-8")


def _machine() -> dict[str, Any]:
    names = [
        line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")
    ]
    return {
        "processor": names[0] if names else platform.processor(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "load_at_start": round(os.getloadavg()[0], 2),
    }


if __name__ == "__main__":
    main()
