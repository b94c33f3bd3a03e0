"""A plane frame made of nodes, members, bars and springs, and its matrices."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array
from rths_engine.parts.structures.assembled import Members

# three-point Lobatto rule on (0, 1), and curvature times length from the two end rotations at its points
WEIGHTS = np.array([1.0, 4.0, 1.0]) / 6
CURVATURE = np.array([[-4.0, -2.0], [-1.0, 1.0], [2.0, 4.0]])


@dataclass(frozen=True, slots=True)
class Member:
    """A beam-column between two nodes: EA (N), EI (N m^2), yield moment (N m), plastic modulus H (N m^2)."""

    start: int
    end: int
    axial: float
    bending: float
    yield_moment: float
    plastic: float


@dataclass
class FrameModel:
    """A plane frame. Degrees of freedom are numbered in the order of the nodes; -1 is supported.

    All nodes of a diaphragm share one lateral degree of freedom.
    """

    points: list[tuple[float, float]] = field(default_factory=list)
    dofs: list[tuple[int, int, int]] = field(default_factory=list)
    members: list[Member] = field(default_factory=list)
    bars: list[tuple[int, int, float]] = field(default_factory=list)  # nodes, axial stiffness (N/m)
    springs: list[tuple[dict[int, float], float]] = field(default_factory=list)  # deformation row, stiffness (N/m)
    floors: list[int] = field(default_factory=list)
    drifts: list[dict[int, float]] = field(default_factory=list)
    size: int = 0

    def coordinate(self) -> int:
        self.size += 1
        return self.size - 1

    def node(
        self, x: float, y: float, lateral: int | None = None, fixed: tuple[bool, bool, bool] = (False, False, False)
    ) -> int:
        """A node at (x, y) with lateral, vertical and rotational freedom; `lateral` ties it to a diaphragm."""
        own = [-1 if held else None for held in fixed]
        if lateral is not None:
            own[0] = lateral
        self.dofs.append(tuple(self.coordinate() if dof is None else dof for dof in own))  # type: ignore[arg-type]
        self.points.append((float(x), float(y)))
        return len(self.points) - 1

    def tables(self) -> Members:
        """The members as tables for the compiled loop."""
        count = len(self.members)
        dofs = np.zeros((count, 6), dtype=np.int64)
        shape, section = np.zeros((count, 3, 6)), np.zeros((count, 5))
        for e, member in enumerate(self.members):
            dofs[e] = [*self.dofs[member.start], *self.dofs[member.end]]
            length, shape[e] = self._shape(member.start, member.end)
            section[e] = [length, member.axial, member.bending, member.yield_moment, member.plastic]
        return Members(dofs, shape, section)

    def stiffness(self) -> Array:
        """Initial stiffness K (n, n)."""
        total = self.rest()
        members = self.tables()
        for dofs, shape, (length, axial, bending, _, _) in zip(members.dofs, members.shape, members.section, strict=True):
            bend = bending / length * (CURVATURE.T * WEIGHTS) @ CURVATURE
            basic = np.zeros((3, 3))
            basic[0, 0], basic[1:, 1:] = axial / length, bend
            _add(total, dofs, shape.T @ basic @ shape)
        return total

    def rest(self) -> Array:
        """Stiffness (n, n) of bars and springs, which stay elastic."""
        total: Array = np.zeros((self.size, self.size))
        for start, end, stiffness in self.bars:
            _, shape = self._shape(start, end)
            dofs = np.array([*self.dofs[start], *self.dofs[end]])
            _add(total, dofs, stiffness * np.outer(shape[0], shape[0]))
        for row, stiffness in self.springs:
            vector = self._row(row)
            total += stiffness * np.outer(vector, vector)
        return total

    def drift_rows(self) -> Array:
        return np.array([self._row(drift) for drift in self.drifts])

    def _row(self, entries: dict[int, float]) -> Array:
        row: Array = np.zeros(self.size)
        for dof, value in entries.items():
            row[dof] = value
        return row

    def _shape(self, start: int, end: int) -> tuple[float, Array]:
        """Length, and rows (3, 6) for elongation, start rotation and end rotation relative to the chord."""
        dx, dy = np.subtract(self.points[end], self.points[start])
        length = float(np.hypot(dx, dy))
        c, s = dx / length, dy / length
        elongation = [-c, -s, 0, c, s, 0]
        chord = np.array([s, -c, 0, -s, c, 0]) / length
        return length, np.array([elongation, np.eye(6)[2] - chord, np.eye(6)[5] - chord])


def _add(total: Array, dofs: NDArray[np.int64], block: Array) -> None:
    free = np.flatnonzero(dofs >= 0)
    np.add.at(total, np.ix_(dofs[free], dofs[free]), block[np.ix_(free, free)])  # both ends of a beam share a lateral DOF
