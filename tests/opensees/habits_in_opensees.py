"""What OpenSees does that an engineer may not expect: many small models, each answer a few numbers. Without the engine."""

from __future__ import annotations

import math
import os
import sys
import tempfile
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import openseespy.opensees as ops

OMEGA = 2.0 * math.pi
RATIO = 0.05  # of critical damping
BASE, MASS, OTHER = 1, 2, 3
MODULUS, AREA, INERTIA, LENGTH = 2e11, 1e-2, 1e-5, 2.0


def oscillator(stiffness: float = OMEGA**2) -> None:
    """A mass of 1 kg on a spring, with a natural frequency of 1 Hz."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(BASE, 0.0)
    ops.node(MASS, 0.0)
    ops.fix(BASE, 1)
    ops.mass(MASS, 1.0)
    ops.uniaxialMaterial("Elastic", 1, stiffness)
    ops.element("zeroLength", 1, BASE, MASS, "-mat", 1, "-dir", 1)


def loaded(*series: Any) -> None:
    ops.timeSeries(*series)
    ops.pattern("Plain", 1, 1)
    ops.load(MASS, OMEGA**2)


def analysis(*integrator: Any, kind: str = "Transient", constraints: str = "Plain", algorithm: str = "Linear") -> None:
    ops.constraints(constraints)
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-10, 10)
    ops.algorithm(algorithm)
    ops.integrator(*integrator)
    ops.analysis(kind)


def stepped(steps: int, dt: float, read: Callable[[], Any]) -> list[Any]:
    path = []
    for step in range(steps):
        if ops.analyze(1, dt):
            raise RuntimeError(f"OpenSees fails in step {step}")
        path.append(read())
    return path


def displacement() -> float:
    return float(ops.nodeDisp(MASS, 1))


def path_end(*more: Any) -> list[float]:
    """Factors of a Path of three ones, 0.5 s apart, at 0.5, 1 and 1.5 s."""
    oscillator()
    loaded("Path", 1, *more)
    analysis("LoadControl", 0.5, kind="Static")
    return [(ops.analyze(1), ops.getLoadFactor(1))[1] for _ in range(3)]


def step_load(integrator: list[Any], dt: float, seconds: float = 2.0) -> list[float]:
    """Displacement of the mass under a load of its stiffness that begins at full size at time zero."""
    oscillator()
    loaded("Constant", 1)
    analysis(*integrator)
    return stepped(round(seconds / dt), dt, displacement)


def release(integrator: list[Any], dt: float, acceleration: float | None, seconds: float = 5.0) -> dict[str, list[float]]:
    """Displacement and reported acceleration after a release from 1 m."""
    oscillator()
    ops.setNodeDisp(MASS, 1, 1.0, "-commit")
    if acceleration is not None:
        ops.setNodeAccel(MASS, 1, acceleration, "-commit")
    analysis(*integrator)
    rows = stepped(round(seconds / dt), dt, lambda: (displacement(), float(ops.nodeAccel(MASS, 1))))
    return {"x": [row[0] for row in rows], "a": [row[1] for row in rows]}


def decay(name: str, *more: Any) -> float:
    """Largest displacement of the tenth period over that of the first, of a mass on an element with Rayleigh damping."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(BASE, 0.0, 0.0)
    ops.node(MASS, 0.0 if name.startswith("zeroLength") else LENGTH, 0.0)
    ops.fix(BASE, 1, 1, 1)
    ops.fix(MASS, 0, 1, 1)
    stiffness = MODULUS * AREA / LENGTH
    ops.geomTransf("Linear", 1)
    ops.uniaxialMaterial("Elastic", 1, stiffness)
    ops.uniaxialMaterial("Elastic", 2, MODULUS)
    ops.section("Elastic", 1, MODULUS, AREA / LENGTH if name == "zeroLengthSection" else AREA, INERTIA)
    ops.beamIntegration("Lobatto", 1, 1, 3)
    told: dict[str, list[Any]] = {
        "elasticBeamColumn": [AREA, MODULUS, INERTIA, 1],
        "forceBeamColumn": [1, 1],
        "dispBeamColumn": [1, 1],
        "zeroLengthSection": [1],
        "truss": [AREA, 2],
        "corotTruss": [AREA, 2],
    }
    ops.element(name, 1, BASE, MASS, *told.get(name, ["-mat", 1, "-dir", 1]), *more)
    ops.mass(MASS, *[stiffness / OMEGA**2] * 3)
    ops.rayleigh(0.0, 2.0 * RATIO / OMEGA, 0.0, 0.0)
    ops.setNodeVel(MASS, 1, 1e-3, "-commit")
    analysis("Newmark", 0.5, 0.25)
    moved = [abs(one) for one in stepped(1000, 0.01, displacement)]
    return float(max(moved[-100:]) / max(moved[:100]))


def recorded(folder: str, dt: float, steps: int, *more: Any, start: float = 0.0) -> list[list[str]]:
    """Rows of a recorder of time and displacement, as they stand in its file."""
    oscillator()
    loaded("Trig", 1, 0.0, 1e6, 1.3)
    ops.setTime(start)
    name = Path(folder) / "recorded.out"
    ops.recorder("Node", "-file", str(name), "-time", *more, "-node", MASS, "-dof", 1, "disp")
    analysis("Newmark", 0.5, 0.25)
    stepped(steps, dt, displacement)
    ops.remove("recorders")
    return [line.split() for line in name.read_text().splitlines()]


def imposed(constraints: str, kind: str, dt: float, seconds: float) -> dict[str, Any]:
    """Displacement of a node whose motion 0.01 (1 - cos 2.3 t) is imposed by `kind`, and what OpenSees wrote on stderr."""
    omega, steps = 2.3, round(seconds / dt)
    wave = [0.01 * (1.0 - math.cos(omega * k * dt)) for k in range(steps + 1)]
    motion = {"-disp": wave, "-accel": [0.01 * omega**2 * math.cos(omega * k * dt) for k in range(steps + 1)]}
    oscillator()
    ops.node(OTHER, 0.0)  # the analysis needs a degree of freedom of its own
    ops.element("zeroLength", 2, BASE, OTHER, "-mat", 1, "-dir", 1)
    ops.mass(OTHER, 1.0)
    ops.timeSeries("Path", 1, "-dt", dt, "-values", *motion[kind], "-useLast")
    ops.pattern("MultipleSupport", 1)
    ops.groundMotion(1, "Plain", kind, 1)
    ops.imposedMotion(MASS, 1, 1)
    analysis("Newmark", 0.5, 0.25, constraints=constraints, algorithm="Newton")
    with tempfile.TemporaryFile() as said:
        kept = os.dup(2)
        sys.stderr.flush()
        os.dup2(said.fileno(), 2)
        moved = stepped(steps, dt, displacement)
        os.dup2(kept, 2)
        os.close(kept)
        said.seek(0)
        return {"moved": moved, "wanted": wave[1:], "said": said.read().decode()}


def damped_eigenvalue(name: str, coefficient: float, stiffness: float = 3.0 * OMEGA**2) -> float:
    """Eigenvalue of the oscillator with a damper whose spring has three times its stiffness."""
    oscillator()
    ops.uniaxialMaterial(name, 2, stiffness, coefficient, 1.0, *([1.0] if name == "Maxwell" else []))
    ops.element("zeroLength", 2, BASE, MASS, "-mat", 2, "-dir", 1)
    return float(ops.eigen("-fullGenLapack", 1)[0])


def massless(count: int, every: int, asked: int, *solver: str) -> list[float] | None:
    """Eigenvalues of a chain of springs of which each `every`-th of `count` nodes has mass; None where OpenSees fails."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(0, 0.0)
    ops.fix(0, 1)
    ops.uniaxialMaterial("Elastic", 1, 1000.0)
    for node in range(1, count + 1):
        ops.node(node, 0.0)
        ops.element("zeroLength", node, node - 1, node, "-mat", 1, "-dir", 1)
        if node % every == 0:
            ops.mass(node, 1.0)
    try:
        return [float(one) for one in ops.eigen(*solver, asked)]
    except Exception:  # OpenSeesError, which the module does not export
        return None


ELEMENTS = (
    ["elasticBeamColumn"],
    ["forceBeamColumn"],
    ["dispBeamColumn"],
    ["zeroLengthSection"],
    ["zeroLength"],
    ["twoNodeLink"],
    ["truss"],
    ["corotTruss"],
    ["zeroLength", "-doRayleigh", 1],
    ["truss", "-doRayleigh", 1],
    ["twoNodeLink", "-doRayleigh"],
    ["twoNodeLink", "-doRayleigh", 0],
    ["elasticBeamColumn", "-doRayleigh", 0],
)


def habits(_: dict[str, Any]) -> dict[str, Any]:
    """All answers, by the name of the habit."""
    by_step, by_time, ones = ["-dt", 0.5], ["-time", 0.0, 0.5, 1.0], ["-values", 1.0, 1.0, 1.0]
    with tempfile.TemporaryDirectory() as folder:
        files = {
            "every": recorded(folder, 0.001, 5),
            "multiple": recorded(folder, 0.001, 45, "-dT", 0.01),
            "no_multiple": recorded(folder, 0.003, 20, "-dT", 0.01),
            "power_of_two": recorded(folder, 1 / 1024, 2000, "-dT", 0.01),
            "after_100": recorded(folder, 1 / 1024, 3000, start=99.0),
            "after_1000": recorded(folder, 0.001, 600, start=999.7),
            "sixteen_digits": recorded(folder, 1 / 1024, 100, "-precision", 16, start=100.0),
        }
    return {
        "version": version("openseespy"),
        "path": {
            "dt": path_end(*by_step, *ones),
            "dt_last": path_end(*by_step, *ones, "-useLast"),
            "time": path_end(*by_time, *ones),
            "time_last": path_end(*by_time, *ones, "-useLast"),
        },
        "release": {
            str(dt): [release(["Newmark", 0.5, 0.25], dt, given)["x"] for given in (None, -(OMEGA**2))] for dt in (0.02, 0.01)
        },
        "step_load": {
            name: {str(dt): step_load([name, *more], dt) for dt in (0.02, 0.01)}
            for name, more in (("CentralDifference", []), ("Newmark", [0.5, 0.25]))
        },
        "kr_alpha": {
            str(rho): [release(["KRAlphaExplicit", rho], turn / OMEGA, -(OMEGA**2), 10.0) for turn in (0.5, 0.1)]
            for rho in (1.0, 0.5, 0.0)
        },
        "rayleigh": {" ".join(map(str, one)): decay(*one) for one in ELEMENTS},
        "recorder": files,
        "imposed": {
            "plain": imposed("Plain", "-disp", 0.01, 2.5),
            "disp": imposed("Transformation", "-disp", 0.01, 2.5),
            "accel": imposed("Transformation", "-accel", 0.01, 2.5),
            "accel_short": imposed("Transformation", "-accel", 0.01, 0.8),
        },
        "maxwell": {name: [damped_eigenvalue(name, c) for c in (1e-6, 1e6)] for name in ("Maxwell", "ViscousDamper")},
        "massless": {
            "default": [massless(20, 2, asked) for asked in range(1, 11)],
            "lapack": [massless(20, 2, asked, "-fullGenLapack") for asked in (10, 11)],
            "none_massless": [massless(10, 1, asked) for asked in (9, 10)],
        },
    }
