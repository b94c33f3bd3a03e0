"""`python answer.py`: a request as JSON on standard input, what OpenSees makes of it as the last line of standard output."""

from __future__ import annotations

import json
import sys
from time import process_time
from typing import Any

import openseespy.opensees as ops
from frame_in_opensees import Frame
from habits_in_opensees import habits
from materials_in_opensees import pressed, shaken


def modes(request: dict[str, Any]) -> dict[str, Any]:
    frame = Frame(request["frame"], inelastic=request["inelastic"])
    return {"omega_squared": frame.omega_squared(), "elements": len(ops.getEleTags())}


def _ready(request: dict[str, Any]) -> Frame:
    omega_squared = Frame(request["frame"], inelastic=False).omega_squared()
    frame = Frame(request["frame"], inelastic=request["inelastic"])
    frame.shake(request["acceleration"], request["dt"], omega_squared)
    frame.scheme(request["scheme"], request["system"])
    return frame


def history(request: dict[str, Any]) -> dict[str, Any]:
    """Floor displacements (m) after each step."""
    frame, floors = _ready(request), []
    for step in range(len(request["acceleration"]) - 1):
        if ops.analyze(1, request["dt"]):
            raise RuntimeError(f"OpenSees fails in step {step}")
        floors.append([ops.nodeDisp(node, 1) for node in frame.masters])
    return {"floors": floors, "equations": ops.systemSize()}


def timing(request: dict[str, Any]) -> dict[str, Any]:
    """CPU seconds of one `analyze` call over the whole record, nothing recorded."""
    frame, steps = _ready(request), len(request["acceleration"]) - 1
    start = process_time()
    failed = ops.analyze(steps, request["dt"])
    seconds = process_time() - start
    return {"seconds": seconds, "steps": steps, "failed": failed, "last": [ops.nodeDisp(node, 1) for node in frame.masters]}


if __name__ == "__main__":
    request = json.load(sys.stdin)
    tasks = {"modes": modes, "history": history, "timing": timing, "pressed": pressed, "shaken": shaken, "habits": habits}
    print(json.dumps(tasks[request["task"]](request)))
