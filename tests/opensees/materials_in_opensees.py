"""Material laws of OpenSees on a test rig and in a storey (N, m, kg, s). Runs where openseespy is, without the engine."""

from __future__ import annotations

from typing import Any

import openseespy.opensees as ops

FIXED, MOVED, DUMMY = 1, 2, 3


def pressed(request: dict[str, Any]) -> dict[str, Any]:
    """Forces (N) of parallel materials whose end follows `displacement` (m) and `velocity` (m/s)."""
    elements = _between(request["materials"])
    ops.node(DUMMY, 0.0)  # the analysis needs a degree of freedom of its own
    tag = elements[-1] + 1
    ops.uniaxialMaterial("Elastic", tag, 1.0)
    ops.element("zeroLength", tag, FIXED, DUMMY, "-mat", tag, "-dir", 1)
    ops.mass(DUMMY, 1.0)
    for series, values in ((1, request["displacement"]), (2, request["velocity"])):
        _series(series, request["dt"], values)
    ops.pattern("MultipleSupport", 1)
    ops.groundMotion(1, "Plain", "-disp", 1, "-vel", 2)
    ops.imposedMotion(MOVED, 1, 1)
    _analysis()
    forces = [0.0]
    for step in range(len(request["displacement"]) - 1):
        _step(step, request["dt"])
        forces.append(sum(ops.basicForce(element)[0] for element in elements))
    return {"force": forces}


def shaken(request: dict[str, Any]) -> dict[str, Any]:
    """Displacement (m) relative to the ground of a mass on parallel materials, shaken by `acceleration` (m/s^2)."""
    _between(request["materials"])
    ops.mass(MOVED, request["mass"])
    _series(1, request["dt"], request["acceleration"])
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    _analysis()
    moved = [0.0]
    for step in range(len(request["acceleration"]) - 1):
        _step(step, request["dt"])
        moved.append(ops.nodeDisp(MOVED, 1))
    return {"displacement": moved}


def _between(materials: list[list[Any]]) -> list[int]:
    """One element for each material, from the fixed to the moved node."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for node in (FIXED, MOVED):
        ops.node(node, 0.0)
    ops.fix(FIXED, 1)
    for tag, (name, *arguments) in enumerate(materials, start=1):
        ops.uniaxialMaterial(name, tag, *arguments)
        ops.element("zeroLength", tag, FIXED, MOVED, "-mat", tag, "-dir", 1)
    return list(range(1, len(materials) + 1))


def _series(tag: int, dt: float, values: list[float]) -> None:
    """A path that holds its last value: rounding of the time may pass the end."""
    ops.timeSeries("Path", tag, "-dt", dt, "-values", *values, values[-1])


def _analysis() -> None:
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-11, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def _step(step: int, dt: float) -> None:
    if ops.analyze(1, dt):
        raise RuntimeError(f"OpenSees fails in step {step}")
