"""Couplings: several actuators on one specimen, which resists all of them together.

f = M a + C v + K x + sum of w_i f_i(w_i x), with x the strokes of the coupled actuators (m) and f the forces on them (N). v and
a are backward differences over the controller step. The laws f_i are specimens of one displacement each, w_i x.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Value, kinds, quantity
from rths_engine.parts.specimens import Specimen
from rths_engine.parts.specimens.linear import LinearSpecimen

# chosen; see docs/decisions/0023
MOST_COUPLED = 8  # stations of a coupling
MOST_LAWS = 8
NEAREST = 1e-3  # m, spacing of parallel actuators
EQUAL = 1e-9  # of the largest entry: closer entries count as equal, smaller negative eigenvalues as zero

Entry = Annotated[float, Field(ge=-1e12, le=1e12)]
Row = Annotated[tuple[Entry, ...], Field(max_length=MOST_COUPLED)]
Weight = Annotated[float, Field(ge=-1e3, le=1e3)]
Number = Annotated[int, Field(ge=1, le=1000)]


class Matrices(NamedTuple):
    """The linear part of a specimen between the strokes of its actuators: M (kg), C (N s/m) and K (N/m), each (n, n)."""

    mass: Array
    damping: Array
    stiffness: Array


class Law(NamedTuple):
    """A specimen of one displacement: the weights of the strokes in it (n), and the specimen."""

    weights: Array
    specimen: Any


class Attached(Value):
    """A specimen at a place of the loading beam: its displacement is that of the beam at this place."""

    position: float = quantity(
        "Position on the beam",
        "m",
        "mm",
        ge=-100,
        le=100,
        default=0.0,
        help="from the specimen's axis, towards the second actuator",
    )
    specimen: Specimen = Field(LinearSpecimen(), title="Law")
    title: ClassVar[str] = "Specimen on the beam"


class LoadingBeam(Value):
    """Two parallel actuators on a rigid loading beam over one specimen: x_1,2 = u + (e -+ s / 2) theta, q = M y'' + C y' + K y.

    y = (u, theta) are translation and rotation of the beam at the axis of the specimen; s is the spacing of the actuators and e
    the distance of their midpoint from the axis. The forces follow by virtual work: f = T^-T q with x = T y. Theta is
    positive when the second actuator is ahead.
    Not valid for rotations at which the actuators are no longer parallel, and with a beam that bends.
    """

    kind: Literal["loading_beam"] = "loading_beam"
    title: ClassVar[str] = "Two parallel actuators on a rigid loading beam"
    name: str = Field("Beam", title="Name", min_length=1, max_length=80)
    stations: tuple[Number, ...] = quantity("Numbers of the two stations", min_length=2, max_length=2, default=(1, 2))
    spacing: float = quantity("Spacing of the actuators s", "m", "mm", ge=NEAREST, le=100, default=2.0)
    offset: float = quantity(
        "Midpoint of the actuators e",
        "m",
        "mm",
        ge=-100,
        le=100,
        default=0.0,
        help="its distance from the specimen's axis",
    )
    stiffness: float = quantity("Stiffness against translation k", "N/m", "kN/m", ge=0, le=1e12, default=2.0e7)
    rotational_stiffness: float = quantity(
        "Stiffness against rotation k_θ, per radian", "N*m", "kN*m", ge=0, le=1e12, default=4.0e7
    )
    cross_stiffness: float = quantity(
        "Stiffness between translation and rotation k_c, per radian", "N", "kN", ge=-1e12, le=1e12, default=0.0
    )
    damping: float = quantity("Damping of translation c", "N*s/m", "kN*s/m", ge=0, le=1e12, default=0.0)
    rotational_damping: float = quantity("Damping of rotation c_θ", "N*m*s", "kN*m*s", ge=0, le=1e12, default=0.0)
    mass: float = quantity("Mass of beam and specimen m", "kg", "t", ge=0, le=1e9, default=0.0)
    rotary_inertia: float = quantity("Rotary inertia about the axis J", "kg*m^2", "t*m^2", ge=0, le=1e12, default=0.0)
    specimens: tuple[Attached, ...] = Field((), title="Specimens on the beam", max_length=MOST_LAWS)

    def transform(self) -> Array:
        """T (2, 2): strokes x = T y of translation and rotation."""
        return np.array([[1.0, self.offset - 0.5 * self.spacing], [1.0, self.offset + 0.5 * self.spacing]])

    def matrices(self) -> Matrices:
        inverse = np.linalg.inv(self.transform())
        stiffness = np.array([[self.stiffness, self.cross_stiffness], [self.cross_stiffness, self.rotational_stiffness]])
        inertia, damping = np.diag([self.mass, self.rotary_inertia]), np.diag([self.damping, self.rotational_damping])
        return Matrices(*(inverse.T @ one @ inverse for one in (inertia, damping, stiffness)))

    def laws(self) -> list[Law]:
        inverse = np.linalg.inv(self.transform())
        return [Law(np.array([1.0, one.position]) @ inverse, one.specimen) for one in self.specimens]


class Weighted(Value):
    """A specimen between several actuators: its displacement is the weighted sum of their strokes."""

    weights: tuple[Weight, ...] = quantity(
        "Weights of the strokes", min_length=1, max_length=MOST_COUPLED, help="one for each station of the coupling"
    )
    specimen: Specimen = Field(LinearSpecimen(), title="Law")
    title: ClassVar[str] = "Specimen between the strokes"


class StrokeMatrices(Value):
    """One specimen given by matrices between the strokes of its actuators: f = M a + C v + K x.

    x (m) are the strokes and f (N) the forces on the actuators, in the order of the stations. M, C and K are (n, n), symmetric
    and without negative eigenvalues (`coupling_checks`). Not valid where the specimen has motions that the strokes do not
    determine.
    """

    kind: Literal["matrices"] = "matrices"
    title: ClassVar[str] = "Matrices between the strokes"
    name: str = Field("Specimen", title="Name", min_length=1, max_length=80)
    stations: tuple[Number, ...] = quantity("Numbers of the stations", min_length=2, max_length=MOST_COUPLED, default=(1, 2))
    stiffness: tuple[Row, ...] = quantity("Stiffness matrix K", "N/m", "kN/m", min_length=2, max_length=MOST_COUPLED)
    damping: tuple[Row, ...] = quantity(
        "Damping matrix C", "N*s/m", "kN*s/m", max_length=MOST_COUPLED, default=(), help="empty: zero"
    )
    mass: tuple[Row, ...] = quantity("Mass matrix M", "kg", "t", max_length=MOST_COUPLED, default=(), help="empty: zero")
    specimens: tuple[Weighted, ...] = Field((), title="Further specimens", max_length=MOST_LAWS)

    def matrices(self) -> Matrices:
        count = len(self.stations)
        return Matrices(
            *(np.array(rows) if rows else np.zeros((count, count)) for rows in (self.mass, self.damping, self.stiffness))
        )

    def laws(self) -> list[Law]:
        return [Law(np.array(one.weights), one.specimen) for one in self.specimens]


Coupling = Annotated[LoadingBeam | StrokeMatrices, Field(discriminator="kind")]
KINDS = kinds(Coupling)
