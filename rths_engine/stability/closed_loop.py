"""The closed loop of a plan about rest: one matrix over an integration step, its spectral radius and its modes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.stability import station as stations
from rths_engine.stability import structure
from rths_engine.stability.station import Lifted

# chosen; see docs/decisions/0023
ROUNDING = 1e-9  # a radius above 1 by no more is 1
GONE = 1e-3  # a root so small is over within a step, and no mode


@dataclass(frozen=True, slots=True)
class Mode:
    """A root z of the loop: z = exp(s dt); frequency |Im s| / 2 pi (Hz), damping ratio -Re s / |s|, radius |z|."""

    frequency: float
    damping: float
    radius: float


class ClosedLoop:
    """X[i+1] = A X[i],  X = (q, s_1 ... s_S): structure and integrator, then the linear state of each station.

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

    def station(self, j: int, added: float = 0.0) -> Lifted:
        """Station j with `added` controller steps of delay, over an integration step."""
        return stations.linear(self.plan.stations[j], self.plan.substep, added).over(self.plan.substeps)

    def matrix(self, changed: Mapping[int, Lifted] | None = None) -> Array:
        """A, with some stations changed."""
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
        """Spectral radii of many matrices; rows and columns of zeros make them equally large."""
        size = max(len(one) for one in matrices)
        equal = np.array([np.pad(one, (0, size - len(one))) for one in matrices])
        radii: Array = np.abs(np.linalg.eigvals(equal)).max(axis=-1)
        return radii

    def modes(self) -> list[Mode]:
        """The oscillating modes, the least damped first; z < 0 oscillates at the Nyquist frequency."""
        roots = np.linalg.eigvals(self.matrix())
        lasting = roots[np.abs(roots) > GONE]
        found = [_mode(complex(z), self.dt) for z in lasting if z.imag > 0 or (z.imag == 0 and z.real < 0)]
        return sorted(found, key=lambda mode: mode.damping)

    def notes(self) -> list[str]:
        """What the prediction takes for granted, in sentences."""
        found = []
        curved = [station.name for station in self.plan.stations if not isinstance(station.specimen, LinearSpecimen)]
        if curved:
            names = ", ".join(curved)
            found.append(
                f"For small amplitudes: {names} by the specimen's initial tangent; once it slides or yields, growth is limited."
            )
        adaptive = [station.name for station in self.plan.stations if station.compensator.kind == "aic"]
        if adaptive:
            found.append(f"The adaptive compensation of {', '.join(adaptive)} is held at its start value.")
        if len(self.model.built.members.dofs):
            found.append("The frame's members are taken before yielding.")
        if any(station.physics for station in self.plan.stations) or self.plan.structure_physics:
            found.append("Left-out physics that the plan adds to its models is not in the prediction.")
        return found


def stable(radius: float) -> bool:
    """Whether a spectral radius is at most 1, to rounding."""
    return radius <= 1.0 + ROUNDING


def _mode(z: complex, dt: float) -> Mode:
    radius = abs(z)
    decay = math.log(radius) / dt
    angle = math.atan2(z.imag, z.real) / dt
    return Mode(abs(angle) / (2 * math.pi), -decay / math.hypot(decay, angle), radius)
