"""The closed loop of a plan about rest: one matrix over an integration step, its spectral radius and its modes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.stability import station as stations
from rths_engine.stability import structure
from rths_engine.stability.station import Lifted

# chosen; see docs/decisions/0023
ROUNDING = 1e-9  # a radius that exceeds 1 by less counts as 1
MOST = 1024  # states of all stations
GONE = 1e-3  # a root this small decays within one step and is not listed as a mode


@dataclass(frozen=True, slots=True)
class Mode:
    """A mode of the loop, with the root z = exp(s dt): frequency |Im s| / 2 pi (Hz), damping ratio -Re s / |s|, radius |z|."""

    frequency: float
    damping: float
    radius: float


class ClosedLoop:
    """The linear closed loop, X[i+1] = A X[i] with X = (q, s_1 ... s_S).

    q is the state of structure and integrator, s_j the state of station j.

    q[i+1] = a q[i] - b n f[i];  s_j[i+1] = power_j s_j[i] + start_j d_j q[i] + end_j d_j q[i+1];  f_j = c_j s_j, with n_j equal
    specimens in a station. Stable while every root |z| <= 1. Exact for a linear plan; see `structure` and `station` for what
    is linearised. Source: Chen and Ricles (2012), EESD 41, 549-569, section 2, with the ramp (8) lifted over its substeps.
    """

    def __init__(self, planned: Plan | Model):
        self.model = model = Model.of(planned)
        self.plan = plan = model.plan
        self.dt = plan.step
        self._structure = structure.linear(model)
        self._own = [self.station(j) for j in range(len(plan.stations))]
        states = sum(len(one.c) for one in self._own)
        if states > MOST:
            problem = f"the stations need {states} states to be described about rest; the maximum is {MOST}"
            raise PlanError(Issue("", problem, fix="shorten their delays, or predict them in plans of their own"))

    def station(self, j: int, added: float = 0.0) -> Lifted:
        """Station j over an integration step, with `added` controller steps of delay."""
        given = self.plan.stations[j]
        one = stations.linear(given, self.plan.substep, added)
        with np.errstate(over="ignore", invalid="ignore"):
            lifted = one.over(self.plan.substeps)
        if not all(np.isfinite(values).all() for values in lifted):
            raise PlanError(stations.not_linear(given.name))
        return lifted

    def matrix(self, changed: Mapping[int, Lifted] | None = None) -> Array:
        """The matrix A, with some stations replaced by those in `changed`."""
        used = [(changed or {}).get(j, own) for j, own in enumerate(self._own)]
        a, b, d = self._structure.a, self._structure.b, self._structure.d
        forces = np.zeros((len(used), len(a) + sum(len(one.c) for one in used)))
        places = np.cumsum([len(a), *(len(one.c) for one in used)])
        for j, one in enumerate(used):
            forces[j, places[j] : places[j + 1]] = self.plan.stations[j].dampers * one.c
        before = np.eye(len(a), forces.shape[1])
        after = np.hstack([a, np.zeros((len(a), forces.shape[1] - len(a)))]) - b @ forces
        rows = [after]
        for j, one in enumerate(used):
            row = np.outer(one.start, d[j] @ before) + np.outer(one.end, d[j] @ after)
            row[:, places[j] : places[j + 1]] += one.power
            rows.append(row)
        return np.vstack(rows)

    def radius(self, changed: Mapping[int, Lifted] | None = None) -> float:
        return float(np.max(np.abs(np.linalg.eigvals(self.matrix(changed)))))

    def radii(self, matrices: Sequence[Array]) -> Array:
        """Spectral radii of many matrices, which are padded with zeros to equal size."""
        size = max(len(one) for one in matrices)
        equal = np.array([np.pad(one, (0, size - len(one))) for one in matrices])
        radii: Array = np.abs(np.linalg.eigvals(equal)).max(axis=-1)
        return radii

    def modes(self) -> list[Mode]:
        """The oscillating modes, in ascending order of damping; z < 0 oscillates at the Nyquist frequency."""
        roots = np.linalg.eigvals(self.matrix())
        lasting = roots[np.abs(roots) > GONE]
        found = [_mode(complex(z), self.dt) for z in lasting if z.imag > 0 or (z.imag == 0 and z.real < 0)]
        return sorted(found, key=lambda mode: mode.damping)

    def notes(self) -> list[str]:
        """The assumptions of the prediction, one sentence each."""
        found = []
        curved = [station.name for station in self.plan.stations if not isinstance(station.specimen, LinearSpecimen)]
        if curved:
            names = ", ".join(curved)
            found.append(
                f"Valid for small amplitudes: {names} by its initial tangent. Once it slides or yields, growth is limited."
            )
        adaptive = [station.name for station in self.plan.stations if station.compensator.adaptive]
        if adaptive:
            found.append(f"The adaptive compensation of {', '.join(adaptive)} is held at its start value.")
        if len(self.model.built.members.dofs):
            found.append("The members of the frame are assumed not to yield.")
        if any(station.physics for station in self.plan.stations) or self.plan.structure_physics:
            found.append("The prediction does not include the left-out physics that the plan adds to its models.")
        return found


def stable(radius: float) -> bool:
    """Whether a spectral radius is at most 1, except for rounding."""
    return radius <= 1.0 + ROUNDING


def _mode(z: complex, dt: float) -> Mode:
    radius = abs(z)
    decay = math.log(radius) / dt
    angle = math.atan2(z.imag, z.real) / dt
    return Mode(abs(angle) / (2 * math.pi), -decay / math.hypot(decay, angle), radius)
