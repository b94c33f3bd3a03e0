"""The numerical model of a plan, computed once before a run: matrices, scheme, factor, loads and periods."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.factor import Factor, factorised
from rths_engine.parts.integrators.scheme import Scheme
from rths_engine.parts.physics.effect import MATRICES
from rths_engine.parts.structures.assembled import Assembled
from rths_engine.parts.structures.modes import circular_frequencies
from rths_engine.planning.loads import columns, loads
from rths_engine.planning.plan import Plan

STRUCTURE = {"structure"}
MATRICES_OF = STRUCTURE | {"structure_physics"}
STEPPED = MATRICES_OF | {"stations", "couplings", "integrator"}
LOADED = MATRICES_OF | {"forces", "test"}
# value of a model -> fields of the plan that it depends on
DEPENDS = {
    "bare": STRUCTURE,
    "built": MATRICES_OF,
    "drifts": MATRICES_OF | {"stations"},
    "scheme": STEPPED,
    "factor": STEPPED,
    "loads": LOADED,
    "floor_loads": LOADED,
    "periods": MATRICES_OF,
}
# chosen; see docs/decisions/0023
MASSLESS = 1e-9  # of the largest load: a smaller load is rounding of a condensation


@dataclass(frozen=True)
class Model:
    """The numerical model of a plan, made once and passed to all code that runs or checks the plan.

    n degrees of freedom, S stations, I inputs. Each value is computed at its first use and then stored. Raises PlanError
    where the structure is a mechanism or an effect does not fit it.
    """

    plan: Plan

    @classmethod
    def of(cls, planned: Plan | Model) -> Model:
        """The model of a plan. A model is returned unchanged."""
        return planned if isinstance(planned, Model) else cls(planned)

    def changed(self, **fields: Any) -> Model:
        """The model of the plan with `fields` changed. Values that do not depend on these fields are not computed again."""
        other = Model(self.plan.model_copy(update=fields))
        kept = {name: value for name, value in vars(self).items() if name != "plan" and not fields.keys() & DEPENDS[name]}
        vars(other).update(kept)
        return other

    @cached_property
    def bare(self) -> Assembled:
        """The structure without left-out effects."""
        return self.plan.structure.assemble()

    @cached_property
    def built(self) -> Assembled:
        """The structure with the effects that change its matrices."""
        built = self.bare
        for effect in self.plan.structure_physics:
            if effect.hook == MATRICES:
                built = effect.assembled(built)
        return built

    @cached_property
    def drifts(self) -> Array:
        """L (S, n): row j maps displacements to the stroke of station j."""
        return self.built.drifts[[station.storey - 1 for station in self.plan.stations]]

    @cached_property
    def scheme(self) -> Scheme:
        """The integrator's scheme from M, C and initial K with the stations' equivalents and the specimens they share."""
        built = self.built
        damping, stiffness = built.damping.copy(), built.stiffness.copy()
        for station, drift in zip(self.plan.stations, self.drifts, strict=True):
            outer = station.dampers * np.outer(drift, drift)
            damping += station.equivalent_damping * outer
            stiffness += station.equivalent_stiffness * outer
        for coupling in self.plan.couplings:
            rows, shared = self.drifts[[number - 1 for number in coupling.stations]], coupling.matrices()
            damping += rows.T @ shared.damping @ rows
            stiffness += rows.T @ shared.stiffness @ rows
        return self.plan.integrator.build(built.mass, damping, stiffness)

    @cached_property
    def factor(self) -> Factor:
        """The factor of the scheme's matrix. Raises PlanError unless the matrix is positive definite."""
        return factorised(self.scheme.effective)

    @cached_property
    def loads(self) -> Array:
        """Load vectors (I, n): the force vector for a unit of each input."""
        return loads(self.plan, self.built)

    @cached_property
    def floor_loads(self) -> Array | None:
        """Forces on the floors (recorded inputs, floors) for a unit of each recorded input.

        None without a structure, and where the ground moves mass that is not at a floor: its motion is not recorded.
        """
        if self.plan.driven:
            return None
        floors = list(self.built.floors)
        every = self.loads[np.unique(columns(self.plan), return_index=True)[1]]
        elsewhere = np.delete(every, floors, axis=1)
        return every[:, floors] if np.max(np.abs(elsewhere), initial=0.0) <= MASSLESS * np.max(np.abs(every)) else None

    @cached_property
    def periods(self) -> Array:
        """Natural periods (s) of the analytical substructure, from the first mode on."""
        if not len(self.built.mass):
            return np.zeros(0)
        periods: Array = 2 * np.pi / circular_frequencies(self.built.mass, self.built.stiffness)
        return periods
