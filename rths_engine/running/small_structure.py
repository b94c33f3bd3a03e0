"""Motion of a small elastic structure under known forces: the scheme of the loop with dense matrices."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import entry, fold
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import STOREY
from rths_engine.parts.physics.structure.storey import OfStorey, drift, stiffness
from rths_engine.planning.model import Model
from rths_engine.running import starting
from rths_engine.running.dispatch import effects

# chosen; see docs/decisions/0023
MOST = 12  # degrees of freedom up to which dense matrices are faster than sparse ones

_STEPS = list(dict.fromkeys(kind.step for kind in physics.STRUCTURE))
_resist = fold(_STEPS)


@entry
def _move(inverse, damping, elastic, pushes, shift, dt, storeys, drifts, moduli, x, v, history):
    count = x.size
    residual = np.empty(count)
    for i in range(history.shape[0] - 1):
        for a in range(count):
            total = pushes[i, a]
            for b in range(count):
                total -= damping[a, b] * v[b] + elastic[a, b] * x[b]
            residual[a] = total
        for k in range(moduli.size):
            moved, rate = 0.0, 0.0
            for a in range(count):
                moved += drifts[k, a] * x[a]
                rate += drifts[k, a] * v[a]
            parameters, state, code = storeys.parameters[k], storeys.states[k], storeys.codes[k, 1]
            force = _resist(code, parameters, state, 0.0, moved, rate, moduli[k] * moved, i * dt, dt)
            for a in range(count):
                residual[a] -= drifts[k, a] * force
        for a in range(count):
            acceleration = 0.0
            for b in range(count):
                acceleration += inverse[a, b] * residual[b]
            v[a] += dt * acceleration
            history[i + 1, a] = x[a] + dt * (v[a] + shift * dt * acceleration)
        for a in range(count):
            x[a] = history[i + 1, a]


def fits(model: Model) -> bool:
    """Whether `moved` can replay the model: few degrees of freedom, no members, and a scheme that keeps nothing of a step."""
    built = model.built
    return 0 < len(built.mass) <= MOST and not len(built.members.dofs) and model.scheme.held is None


def moved(model: Model, inputs: Array, reactions: Array) -> Array:
    """Displacements (steps + 1, DOF), m, by the scheme of the loop; `inputs` and `reactions` as in `replay.structure`.

    Raises PlanError where the matrix of the scheme is not positive definite.
    """
    plan, built, scheme = model.plan, model.built, model.scheme
    dampers = np.array([float(station.dampers) for station in plan.stations])
    pushes = inputs @ model.loads - (reactions * dampers) @ model.drifts
    x, v, _ = starting.state(model, inputs[0] @ model.loads)
    against: list[Any] = [one for one in plan.structure_physics if isinstance(one, OfStorey) and one.hook == STOREY]
    drifts = [drift(built, effect.storey) for effect in against]
    history: Array = np.empty((len(inputs), len(x)))
    history[0] = x
    try:
        half = np.linalg.inv(np.linalg.cholesky(scheme.effective))
    except np.linalg.LinAlgError:
        _ = model.factor  # raises a PlanError with its reason
        raise
    _move(
        half.T @ half,
        np.ascontiguousarray(built.damping),
        np.ascontiguousarray(built.elastic),
        pushes,
        scheme.shift,
        plan.step,
        effects(against, plan.step, _STEPS),
        np.array(drifts).reshape(len(drifts), len(x)),
        np.array([stiffness(built, row) for row in drifts], dtype=np.float64),
        x,
        v,
        history,
    )
    return history
