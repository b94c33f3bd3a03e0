"""A linear structure given by its matrices."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import ClassVar, Literal

import numpy as np
from pydantic import model_validator

from rths_engine.arrays import Array
from rths_engine.errors import Issue, PlanError
from rths_engine.part import Value, quantity
from rths_engine.structures.assembled import Assembled, no_members
from rths_engine.structures.modes import circular_frequencies, rayleigh

MOST_DOF = 2000
EQUAL = 1e-9  # of the largest entry: closer entries are the same number written twice
Rows = tuple[tuple[float, ...], ...]


class MatricesStructure(Value):
    """M a + C v + K x = -M iota a_g + L^T f + F, with M (n, n), C (n, n) and K (n, n) as given.

    Without C: Rayleigh damping with `damping_ratio` in modes 1 and 2. Without floors, every degree of freedom is one; without
    iota, a ground displacement moves every floor as much and nothing else; without L, a damper of storey s works between floors
    s - 1 and s. M and K are symmetric, K positive definite, M positive semidefinite: massless degrees of freedom are allowed.
    Fails first when members yield. Source: Chopra, Dynamics of Structures, chapter 9.
    """

    kind: Literal["matrices"] = "matrices"
    mass: Rows = quantity("Mass matrix M", "kg", min_length=1, max_length=MOST_DOF)
    stiffness: Rows = quantity("Stiffness matrix K", "N/m", min_length=1, max_length=MOST_DOF)
    damping: Rows = quantity("Damping matrix C", "N*s/m", max_length=MOST_DOF, default=(), help="empty: Rayleigh damping")
    damping_ratio: float = quantity("Damping ratio of modes 1 and 2, without C", shown="%", ge=0, lt=1, default=0.02)
    floors: tuple[int, ...] = quantity("Floors", default=(), help="degrees of freedom counted from 1; empty: every one")
    influence: tuple[float, ...] = quantity("Influence of the ground ι", default=(), help="empty: 1 at floors, else 0")
    drifts: Rows = quantity("Strokes of dampers L, a row a storey", default=(), help="empty: between neighbouring floors")
    title: ClassVar[str] = "Given matrices M, C, K"

    @model_validator(mode="after")
    def _consistent(self) -> MatricesStructure:
        problems = list(self._problems())
        if problems:
            raise ValueError("; ".join(problems))
        return self

    def assemble(self) -> Assembled:
        """The matrices as the loop takes them. Raises PlanError when it is a mechanism or mass is missing or negative."""
        return _assembled(self)

    def _problems(self) -> Iterator[str]:
        count = len(self.stiffness)
        for name, rows in (("M", self.mass), ("K", self.stiffness), ("C", self.damping)):
            if (rows or name != "C") and (len(rows) != count or any(len(row) != count for row in rows)):
                yield f"matrix {name} needs {count} rows of {count} numbers, as many as K has rows"
            elif rows:
                yield from _asymmetry(name, np.array(rows))
        wrong = [floor for floor in self.floors if not 1 <= floor <= count]
        if wrong or len(set(self.floors)) < len(self.floors):
            yield f"floors {list(self.floors)}: give different degrees of freedom from 1 to {count}"
        if self.influence and len(self.influence) != count:
            yield f"the influence of the ground needs {count} numbers and has {len(self.influence)}"
        if any(len(row) != count for row in self.drifts):
            yield f"each row of L needs {count} numbers"


def _asymmetry(name: str, matrix: Array) -> Iterator[str]:
    apart = np.abs(matrix - matrix.T)
    i, j = np.unravel_index(int(np.argmax(apart)), apart.shape)
    if apart[i, j] > EQUAL * np.abs(matrix).max():
        there, back = f"{name}[{i + 1}, {j + 1}]", f"{name}[{j + 1}, {i + 1}]"
        yield f"matrix {name} is not symmetric: {there} = {matrix[i, j]:g}, {back} = {matrix[j, i]:g}"


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
        fix = "a mass matrix has no negative eigenvalue"
        raise PlanError(Issue("structure.mass", f"has the negative eigenvalue {least:.4g} kg", fix=fix))
