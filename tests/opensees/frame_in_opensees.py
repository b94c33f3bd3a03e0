"""The moment frame in OpenSees' own commands (N, m, kg, s). Runs where openseespy is; knows nothing of the engine."""

from __future__ import annotations

from itertools import pairwise
from math import hypot
from typing import Any

import openseespy.opensees as ops

Description = dict[str, Any]
LINEAR, SECOND_ORDER = 1, 2
MEMBER_LENGTH_POINTS = 3


class Frame:
    """A frame as described by `peer.describe`: builds the model at once; `masters` are the floors' nodes."""

    def __init__(self, description: Description, inelastic: bool):
        self.given, self.inelastic = description, inelastic
        self.bays, self.storeys = description["bays"], description["storeys"]
        self.levels = [0.0]
        for storey in self.storeys:
            self.levels.append(self.levels[-1] + storey["height"])
        self.lines = [0.0]
        for bay in self.bays:
            self.lines.append(self.lines[-1] + bay)
        self.tag = 0
        self.leaning: list[int] = []
        self.on_floor: list[list[int]] = [[] for _ in self.levels]
        ops.wipe()
        ops.model("basic", "-ndm", 2, "-ndf", 3)
        ops.geomTransf("Linear", LINEAR)
        ops.geomTransf("PDelta", SECOND_ORDER)
        self._sections()
        self._bare_frame()
        for level in range(len(self.storeys)):
            if self.storeys[level]["brace_stiffness"]:
                self._brace(level)
        if description["p_delta"]:
            self._lean_on_column()
        self.masters = [nodes[0] for nodes in self.on_floor[1:]]
        for master, nodes, storey in zip(self.masters, self.on_floor[1:], self.storeys, strict=True):
            for node in nodes[1:]:
                ops.equalDOF(master, node, 1)
            ops.mass(master, storey["mass"], 0.0, 0.0)

    def _next(self) -> int:
        self.tag += 1
        return self.tag

    def _node(self, x: float, y: float, floor: int | None = None) -> int:
        tag = self._next()
        ops.node(tag, x, y)
        if floor is not None:
            self.on_floor[floor].append(tag)
        return tag

    def _sections(self) -> None:
        modulus, self.section_tags = self.given["elastic_modulus"], {}
        for name, (area, inertia, plastic) in self.given["sections"].items():
            axial, bending, tag = self._next(), self._next(), self._next()
            ops.uniaxialMaterial("Elastic", axial, modulus * area)
            if self.inelastic:
                yield_moment = self.given["yield_stress"] * plastic
                ops.uniaxialMaterial("Steel01", bending, yield_moment, modulus * inertia, self.given["hardening"])
            else:
                ops.uniaxialMaterial("Elastic", bending, modulus * inertia)
            ops.section("Aggregator", tag, axial, "P", bending, "Mz")
            ops.beamIntegration("Lobatto", tag, tag, MEMBER_LENGTH_POINTS)
            self.section_tags[name] = tag

    def _bare_frame(self) -> None:
        self.joints = [[self._node(x, y, floor if floor else None) for x in self.lines] for floor, y in enumerate(self.levels)]
        for base in self.joints[0]:
            ops.fix(base, 1, 1, int(self.given["fixed_base"]))
        for level, storey in enumerate(self.storeys):
            below, above = self.joints[level], self.joints[level + 1]
            for foot, head in zip(below, above, strict=True):
                self._member(foot, head, storey["column"], None)
            for left, right in pairwise(above):
                self._member(left, right, storey["beam"], level + 1)

    def _member(self, start: int, end: int, section: str, floor: int | None) -> None:
        (x1, y1), (x2, y2) = ops.nodeCoord(start), ops.nodeCoord(end)
        hinge = self.given["hinge_fraction"]
        first, second = (self._node(x1 + s * (x2 - x1), y1 + s * (y2 - y1), floor) for s in (hinge, 1 - hinge))
        for one, two in ((start, first), (first, second), (second, end)):
            if self.inelastic:
                ops.element("dispBeamColumn", self._next(), one, two, LINEAR, self.section_tags[section])
            else:
                area, inertia, _ = self.given["sections"][section]
                modulus = self.given["elastic_modulus"]
                ops.element("elasticBeamColumn", self._next(), one, two, area, modulus, inertia, LINEAR)

    def _brace(self, level: int) -> None:
        """Two bars from the second and third column line to a node at the top; together the described lateral stiffness."""
        feet, modulus = self.joints[level][1:3], self.given["elastic_modulus"]
        apex = (sum(ops.nodeCoord(foot, 1) for foot in feet) / 2, self.levels[level + 1])
        top, steel = self._node(*apex), self._next()
        ops.fix(top, 0, 0, 1)
        ops.uniaxialMaterial("Elastic", steel, modulus)
        for foot in feet:
            across = apex[0] - ops.nodeCoord(foot, 1)
            length = hypot(across, self.storeys[level]["height"])
            area = self.storeys[level]["brace_stiffness"] / 2 * length**3 / (across**2 * modulus)
            ops.element("truss", self._next(), foot, top, area, steel, "-doRayleigh", 1)

    def _lean_on_column(self) -> None:
        x = self.lines[-1] + self.bays[-1]
        nodes = [self._node(x, y, floor if floor else None) for floor, y in enumerate(self.levels)]
        ops.fix(nodes[0], 1, 1, 1)
        for foot, head in pairwise(nodes):
            area, inertia = self.given["lean_on"]
            modulus, tag = self.given["elastic_modulus"], self._next()
            ops.element("elasticBeamColumn", tag, foot, head, area, modulus, inertia, SECOND_ORDER)
            self.leaning.append(tag)
        ops.timeSeries("Linear", 1)
        ops.pattern("Plain", 1, 1)
        for node, storey in zip(nodes[1:], self.storeys, strict=True):
            ops.load(node, 0.0, -storey["mass"] * self.given["gravity"], 0.0)
        _analysis("BandGeneral", "Newton")
        ops.integrator("LoadControl", 1.0)
        ops.analysis("Static")
        if ops.analyze(1):
            raise RuntimeError("OpenSees finds no equilibrium under gravity")
        ops.loadConst("-time", 0.0)
        ops.wipeAnalysis()

    def omega_squared(self) -> list[float]:
        """Eigenvalues of the modes that have mass, one a storey, with the gravity load's second-order effect."""
        _analysis("FullGeneral", "Newton")
        found = ops.eigen("-fullGenLapack", len(self.storeys))
        ops.wipeAnalysis()
        return [float(value) for value in found]

    def shake(self, acceleration: list[float], dt: float, omega_squared: list[float]) -> None:
        """Rayleigh damping and the ground's acceleration.

        The initial stiffness of OpenSees' elements is without the gravity load's share, so the elastic lean-on column damps by
        its present stiffness instead: the damping ratio is then the described one in modes 1 and 2.
        """
        ratio, (first, second) = self.given["damping_ratio"], [value**0.5 for value in omega_squared[:2]]
        by_mass, by_stiffness = 2 * ratio * first * second / (first + second), 2 * ratio / (first + second)
        ops.rayleigh(by_mass, 0.0, by_stiffness, 0.0)
        if self.leaning:
            ops.region(1, "-ele", *self.leaning, "-rayleigh", by_mass, by_stiffness, 0.0, 0.0)
        ops.timeSeries("Path", 2, "-dt", dt, "-values", *acceleration)
        ops.pattern("UniformExcitation", 2, 1, "-accel", 2)

    def scheme(self, name: str, system: str) -> None:
        """`newmark`: average acceleration, Newton to convergence; `alpha_os`: operator splitting, factored once."""
        if name == "newmark":
            _analysis(system, "Newton")
            ops.integrator("Newmark", 0.5, 0.25)
        else:
            _analysis(system, "Linear", "-factorOnce")
            ops.integrator("AlphaOS", 1.0)
        ops.analysis("Transient")


def _analysis(system: str, *algorithm: str) -> None:
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system(system)
    ops.test("NormDispIncr", 1e-10, 50)
    ops.algorithm(*algorithm)
