"""Steel moment-resisting frame with lumped yielding, lean-on column and braces."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field, model_validator

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Value, quantity
from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.structures.assembled import Assembled, no_members
from rths_engine.parts.structures.condensation import condensed
from rths_engine.parts.structures.frame_model import FrameModel, Member
from rths_engine.parts.structures.modes import circular_frequencies, rayleigh
from rths_engine.parts.structures.sections import SECTIONS

# chosen; see docs/decisions/0023
MOST_DOF = 3000  # a check of a plan stores K as a dense matrix
BayWidth = Annotated[float, Field(ge=0.1, le=100)]
LEAN_AREA = 0.5  # m^2
LEAN_INERTIA = 1e-5  # m^4, almost zero


class FrameStorey(Value):
    """One storey: its columns, the beams and the mass of the floor above, and the braces of its dampers."""

    height: float = quantity("Storey height", "m", ge=0.1, le=50)
    mass: float = quantity(
        "Floor mass", "kg", "t", gt=0, le=1e9, help="tributary mass of the frame; also gives its gravity load"
    )
    column: str = Field(title="Column section", min_length=1)
    beam: str = Field(title="Beam section", min_length=1)
    title: ClassVar[str] = "Storey"
    brace_stiffness: float = quantity(
        "Lateral stiffness of the braces",
        "N/m",
        "kN/m",
        ge=0,
        le=1e13,
        default=0.0,
        help="in series with the dampers; 0: rigid",
    )


class MomentFrame(Value):
    """Steel moment-resisting frame with lumped yielding, lean-on column and braces.

    M a + C v + r(x) = F. Every member is three beam-columns in series (hinge_fraction, rest, hinge_fraction of its length).

    Each beam-column has linear curvature between its ends, a bilinear moment-curvature law (yield moment Z fy, second slope
    `hardening`) at three Lobatto points, and elastic axial stiffness; displacements are small. Floors are rigid diaphragms. A
    lean-on column carries all gravity loads; its P-delta effect is K_g = -P/h on the drift of the storey. The braces of a
    storey are two elastic bars from the second and third column line that meet in a node at the top of the storey. Dampers act
    between this node and the floor. Masses act on the lateral displacement of the floors; rotations and vertical displacements
    are massless. C = a0 M + a1 K with the initial K. A frame that stays elastic is condensed exactly to its floors and brace
    tops. Not valid with large rotations, local buckling or axial-flexural interaction.
    Sources: Chen and Ricles (2012), EESD 41, section 4; Neuenhofer and Filippou (1997), J. Struct. Eng. 123, for the element.
    """

    kind: Literal["moment_frame"] = "moment_frame"
    bays: tuple[BayWidth, ...] = quantity("Bay widths", "m", min_length=1, max_length=20)
    storeys: tuple[FrameStorey, ...] = Field(title="Storeys", min_length=1, max_length=50)
    damping_ratio: float = quantity("Damping ratio of modes 1 and 2", shown="%", ge=0, lt=1, default=0.02)
    fixed_base: bool = Field(True, title="Fixed column bases")
    inelastic: bool = Field(True, title="Yielding members")
    p_delta: bool = Field(True, title="P-delta of the gravity frames")
    hinge_fraction: float = quantity("Length of an end segment over member length", shown="%", ge=1e-3, le=0.49, default=0.05)
    hardening: float = quantity("Strain hardening", shown="%", ge=0, lt=1, default=0.03)
    elastic_modulus: float = quantity("Elastic modulus", "N/m^2", "GPa", gt=0, le=1e13, default=200e9)
    yield_stress: float = quantity("Yield stress", "N/m^2", "MPa", gt=0, le=1e11, default=345e6)
    title: ClassVar[str] = "Moment-resisting frame"

    @model_validator(mode="after")
    def _known(self) -> MomentFrame:
        for number, storey in enumerate(self.storeys, start=1):
            for name in (storey.column, storey.beam):
                if name not in SECTIONS:
                    raise ValueError(
                        f"storey {number} has the unknown section '{name}'; the known sections are {', '.join(SECTIONS)}"
                    )
            if storey.brace_stiffness and len(self.bays) < 2:
                raise ValueError(f"storey {number} has braces, and braces need at least two bays")
        lines = len(self.bays) + 1
        size = len(self.storeys) * (1 + 2 * lines + 6 * lines + 4 * (lines - 1))
        if size > MOST_DOF:
            raise ValueError(f"the frame has about {size} degrees of freedom; the maximum is {MOST_DOF}")
        return self

    def assemble(self) -> Assembled:
        """The matrices and members of the frame. Raises PlanError for a mechanism."""
        return _assembled(self)

    def model(self) -> FrameModel:
        model = FrameModel()
        x = np.concatenate([[0.0], np.cumsum(self.bays)])
        y = np.concatenate([[0.0], np.cumsum([storey.height for storey in self.storeys])])
        floors = [model.coordinate() for _ in self.storeys]
        joints = [[model.node(xc, 0.0, fixed=(True, True, self.fixed_base)) for xc in x]]
        joints += [[model.node(xc, y[level], lateral=floors[level - 1]) for xc in x] for level in range(1, len(y))]
        for level, storey in enumerate(self.storeys):
            for line in range(len(x)):
                self._member(model, joints[level][line], joints[level + 1][line], storey.column)
            for line in range(len(self.bays)):
                self._member(model, joints[level + 1][line], joints[level + 1][line + 1], storey.beam, floors[level])
            model.floors.append(floors[level])
            self._brace(model, level, joints[level], float(x[1] + x[2]) / 2 if len(x) > 2 else 0.0, y[level + 1])
        if self.p_delta:
            self._lean_on(model, x[-1] + self.bays[-1], y)
        return model

    def _lean_on(self, model: FrameModel, x: float, y: Array) -> None:
        """A column with high axial and negligible bending stiffness that carries the gravity load of all floors."""
        nodes = [model.node(x, y[0], fixed=(True, True, True))]
        nodes += [model.node(x, y[level + 1], lateral=floor) for level, floor in enumerate(model.floors)]
        axial, bending = self.elastic_modulus * LEAN_AREA, self.elastic_modulus * LEAN_INERTIA
        for level, drift in enumerate(self._floor_drifts(model)):
            model.members.append(Member(nodes[level], nodes[level + 1], axial, bending, np.inf, 0.0))
            weight = STANDARD_GRAVITY * sum(storey.mass for storey in self.storeys[level:])
            model.springs.append((drift, -weight / self.storeys[level].height))

    def _member(self, model: FrameModel, start: int, end: int, name: str, lateral: int | None = None) -> None:
        first, last = np.array(model.points[start]), np.array(model.points[end])
        shares = (self.hinge_fraction, 1 - self.hinge_fraction)
        places = [first + share * (last - first) for share in shares]
        inner = [model.node(float(x), float(y), lateral=lateral) for x, y in places]
        nodes = [start, *inner, end]
        section = SECTIONS[name]
        for one, two in pairwise(nodes):
            model.members.append(
                Member(
                    one,
                    two,
                    axial=self.elastic_modulus * section.area,
                    bending=self.elastic_modulus * section.inertia,
                    yield_moment=self.yield_stress * section.plastic_modulus,
                    plastic=self.hardening / (1 - self.hardening) * self.elastic_modulus * section.inertia,
                )
            )

    def _brace(self, model: FrameModel, level: int, below: list[int], x: float, y: float) -> None:
        stiffness = self.storeys[level].brace_stiffness
        drift = dict(self._floor_drifts(model)[level])
        if stiffness:
            top = model.node(x, y, fixed=(False, False, True))
            for start in below[1:3]:
                length_x = x - model.points[start][0]
                length = float(np.hypot(length_x, y - model.points[start][1]))
                model.bars.append((start, top, stiffness / 2 * (length / length_x) ** 2))
            drift = {model.floors[level]: 1.0, model.dofs[top][0]: -1.0}
        model.drifts.append(drift)

    def _floor_drifts(self, model: FrameModel) -> list[dict[int, float]]:
        found = []
        for level, floor in enumerate(model.floors):
            found.append({floor: 1.0, **({model.floors[level - 1]: -1.0} if level else {})})
        return found

    def summary(self) -> Iterator[str]:
        """Sentences about the size of the model."""
        model = self.model()
        yield f"{model.size} degrees of freedom"
        yield f"{len(model.members)} beam-columns, {len(model.bars)} brace bars"


@lru_cache(maxsize=8)
def _assembled(frame: MomentFrame) -> Assembled:
    model = frame.model()
    stiffness, drifts, members = model.stiffness(), model.drift_rows(), model.tables()
    kept = np.arange(model.size)
    if not frame.inelastic:
        kept = np.union1d(model.floors, np.flatnonzero(drifts.any(axis=0)))
        stiffness, drifts, members = condensed(stiffness, kept), drifts[:, kept], no_members()
    floors = np.searchsorted(kept, model.floors)
    mass: Array = np.zeros_like(stiffness)
    mass[floors, floors] = [storey.mass for storey in frame.storeys]
    omega = circular_frequencies(mass, stiffness)
    damping = rayleigh(mass, stiffness, frame.damping_ratio, omega)
    elastic = model.rest() if frame.inelastic else stiffness
    influence = np.isin(kept, [lateral for lateral, _, _ in model.dofs]).astype(np.float64)
    return Assembled(mass, damping, stiffness, elastic, influence, tuple(floors.tolist()), drifts, members)
