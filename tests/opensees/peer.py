"""OpenSees as an independent solver, in a process of its own: its licence keeps it out of the product."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.structures.moment_frame import LEAN_AREA, LEAN_INERTIA, MomentFrame
from rths_engine.parts.structures.sections import SECTIONS

PYTHON = os.environ.get("RTHS_OPENSEES_PYTHON") or sys.executable
INSTALL = "pip install '.[opensees]' and Debian's libblas3 and liblapack3, or RTHS_OPENSEES_PYTHON=a Python that has it"


@cache
def missing() -> str | None:
    """Why OpenSees can't be asked, or None."""
    tried = subprocess.run([PYTHON, "-c", "import openseespy.opensees"], capture_output=True, text=True)
    if tried.returncode == 0:
        return None
    reason = next((line for line in reversed(tried.stderr.splitlines()) if "Error" in line), "it does not start")
    return f"OpenSees is left out: {reason.strip()} ({INSTALL})"


def describe(frame: MomentFrame) -> dict[str, Any]:
    """The frame as plain numbers, SI, with everything OpenSees has to know."""
    used = {name for storey in frame.storeys for name in (storey.column, storey.beam)}
    return {
        **frame.model_dump(mode="json"),
        "sections": {name: list(SECTIONS[name]) for name in sorted(used)},
        "lean_on": [LEAN_AREA, LEAN_INERTIA],
        "gravity": STANDARD_GRAVITY,
    }


def ask(task: str, frame: MomentFrame, **more: Any) -> dict[str, Any]:
    """The answer to one request about a frame."""
    return answered({"task": task, "frame": describe(frame), **more})


def answered(request: dict[str, Any]) -> dict[str, Any]:
    """The answer to one request. Raises RuntimeError with OpenSees' own words."""
    script = Path(__file__).with_name("answer.py")
    done = subprocess.run([PYTHON, str(script)], input=json.dumps(request), capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr[-2000:])
    answer: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return answer
