"""The compiled dispatch over each registry of parts, and over the effects of a component."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from rths_engine.foundation.kernel import compiled, fold, named, piece
from rths_engine.parts import actuators, compensators, controllers, physics, specimens
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.specimens.commanded import Commanded

compensate = fold([part.step for part in compensators.KINDS])
actuate = fold([part.step for part in actuators.KINDS])
resist = fold([part.step for part in specimens.KINDS])
command = fold([part.step for part in controllers.KINDS])


def energising(part: Any) -> Any:
    """How a kind of specimen takes its command; nothing happens where it has no command of its own."""
    return part.energise if issubclass(part, Commanded) else _without_command


def _without_command(p, s, w, dt):
    """The command of a specimen that has none of its own."""


energise = fold([energising(part) for part in specimens.KINDS])


class Effects(NamedTuple):
    """Effects of one component: codes (E, 2), hook and step; parameters and states (E, widest)."""

    codes: Any
    parameters: Any
    states: Any


def effects(planned: Sequence[Effect], dt: float, steps: Sequence[Any] | None = None) -> Effects:
    """Left-out effects in the form of the compiled loop: hooks and codes, parameters, states.

    A code is the place of the effect's step in `steps`; without these, in the steps of its component.
    """
    built = [effect.build(dt) for effect in planned]
    codes = [(effect.hook, _code(effect) if steps is None else steps.index(type(effect).step)) for effect in planned]
    return Effects(
        np.array(codes, dtype=np.int64).reshape(-1, 2),
        _table([parameters for parameters, _ in built]),
        _table([state for _, state in built]),
    )


def _code(effect: Effect) -> int:
    registries = (physics.ACTUATOR, physics.SPECIMEN, physics.SENSOR, physics.STRUCTURE)
    registry = next(kinds for kinds in registries if type(effect) in kinds)
    return _steps(registry).index(type(effect).step)


def stacked(rows: Sequence[Effects]) -> Effects:
    """The effects of several components: codes (C, E, 2), parameters and states (C, E, widest); a code of -1 is no effect."""
    count = max((len(row.codes) for row in rows), default=0)
    tables = [np.full((len(rows), count, 2), -1, dtype=np.int64)]
    for which in (1, 2):
        widest = max((row[which].shape[1] for row in rows), default=1)
        tables.append(np.zeros((len(rows), count, widest)))
    for place, row in enumerate(rows):
        for table, own in zip(tables, row, strict=True):
            table[place, : own.shape[0], : own.shape[1]] = own
    return Effects(*tables)


@piece
def own(effects, component):
    """The effects of one component, as views into the stacked effects."""
    return Effects(effects.codes[component], effects.parameters[component], effects.states[component])


@compiled
def acts(hook, effects):
    """Whether any effect is at this hook."""
    return np.any(effects.codes[:, 0] == hook)


def _extending(kinds: Sequence[type[Effect]]) -> Any:
    """`extended(hook, effects, y, x, v, w, t, dt)`: the signal y after every effect at this hook (`physics.effect`).

    Each component has its own dispatch over its own effects only, which keeps the compiled loop small.
    """
    steps = _steps(kinds)
    extend = fold(steps)

    def extended(hook, effects, y, x, v, w, t, dt):
        for k in range(effects.codes.shape[0]):
            if effects.codes[k, 0] == hook:
                y = extend(effects.codes[k, 1], effects.parameters[k], effects.states[k], y, x, v, w, t, dt)
        return y

    return compiled(named(extended, steps))


def _steps(kinds: Sequence[type[Effect]]) -> tuple[Any, ...]:
    return tuple(
        dict.fromkeys(kind.step for kind in kinds)
    )  # several kinds can share one step, and so its code in the dispatch


extend_actuator = _extending(physics.ACTUATOR)
extend_specimen = _extending(physics.SPECIMEN)
extend_sensor = _extending(physics.SENSOR)
extend_storey = _extending(physics.STRUCTURE)


def behind(resist: Any) -> Any:
    """`resisted` for a specimen with the compiled step `resist(code, parameters, state, x, dt)`.

    `resisted(code, parameters, state, flexibility, x, dt, before, last)` gives the displacement u and the force f of a specimen
    behind a series flexibility: u + flexibility f(u) = x. f increases with u within a substep, so u lies between x and
    x - flexibility f(x). Secant steps start from the force `last` and stay within the bracket found so far. `before` is memory
    for a copy of the state.
    """

    def resisted(code, parameters, state, flexibility, x, dt, before, last):
        if flexibility <= 0.0:
            return x, resist(code, parameters, state, x, dt)
        for k in range(state.size):
            before[k] = state[k]
        low, high = -np.inf, np.inf
        u, u_old, left_old, force = x - flexibility * last, 0.0, 0.0, last
        for turn in range(60):
            for k in range(state.size):
                state[k] = before[k]
            force = resist(code, parameters, state, u, dt)
            left = u + flexibility * force - x
            if abs(left) <= 1e-8 * abs(flexibility * force) + 1e-16:
                break
            if left > 0.0:
                high = min(high, u)
            else:
                low = max(low, u)
            slope = (left - left_old) / (u - u_old) if turn > 0 and u != u_old else 2.0
            u_old, left_old = u, left
            u -= left / max(slope, 1.0)
            if not low < u < high:
                u = 0.5 * (low + high) if np.isfinite(low) and np.isfinite(high) else u_old - left
            if turn > 20 and np.isfinite(low) and np.isfinite(high):
                u = 0.5 * (low + high)
        return u, force

    return compiled(named(resisted, [resist.py_func]))


resisted = behind(resist)


def _table(rows: Sequence[Any]) -> Any:
    table = np.zeros((len(rows), max((len(row) for row in rows), default=1)))
    for place, row in enumerate(rows):
        table[place, : len(row)] = row
    return table
