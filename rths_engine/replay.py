"""One component alone on recorded signals, by the steps of the loop."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine import specimens
from rths_engine.arrays import Array
from rths_engine.dispatch import effects, extend_sensor, extend_specimen, resisted
from rths_engine.kernel import entry
from rths_engine.part import Part
from rths_engine.physics.effect import F_SENSOR, FORCE, INPUT, SERIES, Effect


def specimen(part: Part, left_out: Sequence[Effect], x: Array, current: Array, dt: float) -> Array:
    """Force (N) of a specimen and the effects on it, from displacement (m) and current, every dt (s)."""
    parameters, state = part.build(dt)
    code = specimens.KINDS.index(type(part))
    force: Array = np.empty(len(x))
    _specimen(x, current, dt, code, parameters, state, effects(left_out, dt), force)
    return force


@entry
def _specimen(x, current, dt, code, parameters, state, left_out, force):
    f, last, last_u = 0.0, x[0], x[0]
    for q in range(x.size):
        v = (x[q] - last) / dt
        last = x[q]
        u = extend_specimen(INPUT, left_out, x[q], x[q], v, f, q * dt, dt)
        flexibility = extend_specimen(SERIES, left_out, 0.0, x[q], v, f, q * dt, dt)
        u, f = resisted(code, parameters, state, flexibility, u, dt)
        f = extend_specimen(FORCE, left_out, f, u, (u - last_u) / dt, current[q], q * dt, dt)
        last_u = u
        force[q] = extend_sensor(F_SENSOR, left_out, f, x[q], v, f, q * dt, dt)
