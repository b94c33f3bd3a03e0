"""A linear structure given by its matrices."""

from __future__ import annotations

from functools import lru_cache
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator, Field, ValidationInfo, field_validator

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.foundation.part import Value, quantity
from rths_engine.parts.structures.assembled import Assembled, no_members
from rths_engine.parts.structures.modes import circular_frequencies, rayleigh

# chosen; see docs/decisions/0023
MOST_DOF = 2000
EQUAL = 1e-9  # of the largest entry: closer entries count as equal
SYMBOLS = {"mass": "M", "stiffness": "K", "damping": "C"}
Entry = Annotated[float, Field(ge=-1e18, le=1e18)]
Row = tuple[Entry, ...]


def _of_possible_size(rows: Any) -> Any:
    """Reject a matrix that is too large before its numbers are read."""
    if isinstance(rows, list | tuple) and any(len(part) > MOST_DOF for part in (rows, *rows) if isinstance(part, list | tuple)):
        raise ValueError(f"takes at most {MOST_DOF} rows of {MOST_DOF} numbers")
    return rows


Rows = Annotated[tuple[Row, ...], BeforeValidator(_of_possible_size)]


class MatricesStructure(Value):
    """A linear structure given by its matrices: M a + C v + K x = -M iota a_g + L^T f + F.

    M, C and K are (n, n). Defaults: C is Rayleigh damping with `damping_ratio` in modes 1 and 2; every degree of freedom is a
    floor; iota is 1 at floors and 0 elsewhere; L places a damper of storey s between floors s - 1 and s. M and K are symmetric,
    K is positive definite and M positive semidefinite: massless degrees of freedom are allowed.
    Not valid when members yield. Source: Chopra, Dynamics of Structures, chapter 9.
    """

    kind: Literal["matrices"] = "matrices"
    mass: Rows = quantity("Mass matrix M", "kg", "t", min_length=1, max_length=MOST_DOF)
    stiffness: Rows = quantity("Stiffness matrix K", "N/m", "kN/m", min_length=1, max_length=MOST_DOF)
    damping: Rows = quantity(
        "Damping matrix C", "N*s/m", "kN*s/m", max_length=MOST_DOF, default=(), help="empty: Rayleigh damping"
    )
    damping_ratio: float = quantity("Damping ratio of modes 1 and 2, if C is empty", shown="%", ge=0, lt=1, default=0.02)
    floors: tuple[int, ...] = quantity(
        "Floors", max_length=MOST_DOF, default=(), help="numbers of the degrees of freedom, from 1; empty: all"
    )
    influence: Row = quantity(
        "Influence vector of the ground motion ι", max_length=MOST_DOF, default=(), help="empty: 1 at the floors, 0 elsewhere"
    )
    drifts: Rows = quantity(
        "Damper strokes L, one row per storey", max_length=MOST_DOF, default=(), help="empty: between neighbouring floors"
    )
    title: ClassVar[str] = "Matrices M, C and K"

    @field_validator("mass", "stiffness", "damping")
    @classmethod
    def _square(cls, rows: Rows, info: ValidationInfo) -> Rows:
        name, count = SYMBOLS[str(info.field_name)], len(info.data.get("mass", rows))
        if rows and (len(rows) != count or any(len(row) != count for row in rows)):
            raise ValueError(f"matrix {name} needs {count} rows of {count} numbers, because M has {count} rows")
        if rows:
            _check_symmetry(name, np.array(rows))
        return rows

    @field_validator("floors")
    @classmethod
    def _different(cls, floors: tuple[int, ...], info: ValidationInfo) -> tuple[int, ...]:
        count = len(info.data.get("mass", ()))
        if count and (len(set(floors)) < len(floors) or any(not 1 <= floor <= count for floor in floors)):
            raise ValueError(f"give different degrees of freedom from 1 to {count}")
        return floors

    @field_validator("influence")
    @classmethod
    def _as_many(cls, influence: Row, info: ValidationInfo) -> Row:
        count = len(info.data.get("mass", ()))
        if count and len(influence) not in (0, count):
            raise ValueError(f"the influence of the ground needs {count} numbers and has {len(influence)}")
        return influence

    @field_validator("drifts")
    @classmethod
    def _wide(cls, drifts: Rows, info: ValidationInfo) -> Rows:
        count = len(info.data.get("mass", ()))
        if count and any(len(row) != count for row in drifts):
            raise ValueError(f"each row of L needs {count} numbers")
        return drifts

    def assemble(self) -> Assembled:
        """The matrices as the loop uses them. Raises PlanError for a mechanism, and for a mass that is missing or negative."""
        return _assembled(self)


def _check_symmetry(name: str, matrix: Array) -> None:
    apart = np.abs(matrix - matrix.T)
    i, j = np.unravel_index(int(np.argmax(apart)), apart.shape)
    if apart[i, j] > EQUAL * np.abs(matrix).max():
        there, back = f"{name}[{i + 1}, {j + 1}]", f"{name}[{j + 1}, {i + 1}]"
        raise ValueError(f"matrix {name} is not symmetric: {there} = {matrix[i, j]:g}, {back} = {matrix[j, i]:g} (SI)")


@lru_cache(maxsize=8)
def _assembled(given: MatricesStructure) -> Assembled:
    mass, stiffness = _symmetric(given.mass), _symmetric(given.stiffness)
    _check_mass(mass)
    count = len(mass)
    floors = np.array(given.floors or range(1, count + 1), dtype=np.int64) - 1
    influence: Array = np.zeros(count)
    influence[floors] = 1.0
    drifts: Array = np.zeros((len(floors), count))
    drifts[np.arange(len(floors)), floors] = 1.0
    drifts[1:] -= drifts[:-1]
    omega = circular_frequencies(mass, stiffness)
    damping = _symmetric(given.damping) if given.damping else rayleigh(mass, stiffness, given.damping_ratio, omega)
    return Assembled(
        mass,
        damping,
        stiffness,
        stiffness,
        np.array(given.influence) if given.influence else influence,
        tuple(floors.tolist()),
        np.array(given.drifts) if given.drifts else drifts,
        no_members(),
    )


def _symmetric(rows: Rows) -> Array:
    matrix = np.array(rows)
    return np.asarray((matrix + matrix.T) / 2)


def _check_mass(mass: Array) -> None:
    if not mass.any():
        raise PlanError(Issue("structure.mass", "is all zero", fix="give at least one degree of freedom mass"))
    least = float(np.linalg.eigvalsh(mass)[0])
    if least < -EQUAL * np.abs(mass).max():
        fix = "give a mass matrix without negative eigenvalues"
        raise PlanError(Issue("structure.mass", f"has the negative eigenvalue {least:.4g} kg", fix=fix))
