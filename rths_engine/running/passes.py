"""One part or effect over a whole signal: the compiled passes of a replay.

The loop of a test steps all parts once in every substep, because each needs the others' results. Where nothing is fed back, a
part can step through the whole signal before the next part begins. The dispatch then happens once for a signal instead of once
for a step, and the compiler joins the step with its loop. The results are the same to the bit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import compiled, entry, fold, named
from rths_engine.parts import actuators, physics, specimens
from rths_engine.parts.physics.effect import FORCE, HEAT, INPUT, SERIES, Effect
from rths_engine.running.dispatch import behind, effects, energising


def _resisting(part: type[Any]) -> Any:
    inner, energise = compiled(part.step), compiled(energising(part))

    def resisting(p, s, x, current, dt, force):
        for q in range(x.size):
            energise(p, s, current[q], dt)
            force[q] = inner(p, s, x[q], dt)

    return named(resisting, [part.step, energising(part)])


def _acting(step: Callable[..., Any]) -> Any:
    inner = compiled(step)

    def acting(p, s, command, load, x):
        force = 0.0
        for q in range(command.size):
            x[q] = inner(p, s, command[q], force)
            force = load[q]

    return named(acting, [step])


def _extending(step: Callable[..., Any]) -> Any:
    inner = compiled(step)

    def extending(p, s, y, x, v, w, start, dt):
        for q in range(y.size):
            y[q] = inner(p, s, y[q], x[q], v[q], w[q], start + q * dt, dt)

    return named(extending, [step])


def _moving(part: type[Any]) -> Any:
    inner, energise = compiled(part.step), compiled(energising(part))

    def alone(code, p, s, x, dt):
        return inner(p, s, x, dt)

    alone_step = compiled(named(alone, [part.step]))
    resisted = behind(alone_step)

    def moving(p, s, x, current, warmth, start, dt, pressed, moves, gives, adds, heats, force):
        f, own, flexibility, last, last_u = pressed, 0.0, 0.0, x[0], 0.0
        before = np.empty(s.size)
        for q in range(x.size):
            t = start + q * dt
            v = (x[q] - last) / dt
            u = last = x[q]
            energise(p, s, current[q], dt)
            for k in range(moves.codes.shape[0]):
                u = _move(moves.codes[k, 1], moves.parameters[k], moves.states[k], u, x[q], v, f, t, dt)
            if gives.codes.shape[0]:
                flexibility = 0.0
                for k in range(gives.codes.shape[0]):
                    flexibility = _give(gives.codes[k, 1], gives.parameters[k], gives.states[k], flexibility, x[q], v, f, t, dt)
                u, f = resisted(0, p, s, flexibility, u, dt, before, own)
            else:
                f = inner(p, s, u, dt)
            own = f
            last_u = u if q == 0 else last_u
            for k in range(adds.codes.shape[0]):
                f = _add(adds.codes[k, 1], adds.parameters[k], adds.states[k], f, u, (u - last_u) / dt, current[q], t, dt)
            for k in range(heats.codes.shape[0]):
                f = _heat(heats.codes[k, 1], heats.parameters[k], heats.states[k], f, u, (u - last_u) / dt, warmth[q], t, dt)
            last_u = u
            force[q] = f

    return named(moving, [part.step, energising(part)])


def _steps(kinds: Sequence[type[Effect]]) -> list[Any]:
    return list(dict.fromkeys(kind.step for kind in kinds))


def _at(hook: int) -> list[Any]:
    return _steps([kind for kind in physics.SPECIMEN if kind.hook == hook])


_resist = fold([_resisting(part) for part in specimens.KINDS])
_act = fold([_acting(part.step) for part in actuators.KINDS])
_MOVES, _GIVES, _ADDS, _HEATS = _at(INPUT), _at(SERIES), _at(FORCE), _at(HEAT)
_move, _give, _add, _heat = fold(_MOVES), fold(_GIVES), fold(_ADDS), fold(_HEATS)
_move_all = fold([_moving(part) for part in specimens.KINDS])
_STEPS = _steps((*physics.SPECIMEN, *physics.ACTUATOR, *physics.SENSOR))
_extend = fold([_extending(step) for step in _STEPS])


@entry
def _resist_all(code, p, s, x, current, dt, force):
    _resist(code, p, s, x, current, dt, force)


@entry
def _specimen_all(code, p, s, x, current, warmth, start, dt, pressed, moves, gives, adds, heats, force):
    _move_all(code, p, s, x, current, warmth, start, dt, pressed, moves, gives, adds, heats, force)


@entry
def _act_all(code, p, s, command, load, x):
    _act(code, p, s, command, load, x)


@entry
def _extend_all(code, p, s, y, x, v, w, start, dt):
    _extend(code, p, s, y, x, v, w, start, dt)


def resist(part: Any, x: Array, current: Array, dt: float) -> Array:
    """Force (N) of a specimen without effects, from its displacement (m) and current (A)."""
    parameters, state = part.build(dt)
    force: Array = np.empty(len(x))
    _resist_all(specimens.KINDS.index(type(part)), parameters, state, _plain(x), _plain(current), dt, force)
    return force


def moved(
    part: Any,
    extended: Sequence[Effect],
    x: Array,
    current: Array,
    warmth: Array,
    dt: float,
    start: float,
    pressed: float,
) -> Array:
    """Force (N) of a specimen with effects of which some act on its displacement, before the sensor reads it.

    Displacement x (m), current (A) and temperature `warmth` (K), every dt (s) from `start` (s). `pressed` is the force (N)
    before the first sample.
    """
    parameters, state = part.build(dt)
    moves, gives, adds, heats = (
        effects([one for one in extended if one.hook == hook], dt, steps)
        for hook, steps in ((INPUT, _MOVES), (SERIES, _GIVES), (FORCE, _ADDS), (HEAT, _HEATS))
    )
    force: Array = np.empty(len(x))
    code = specimens.KINDS.index(type(part))
    driven = _plain(x), _plain(current), _plain(warmth)
    _specimen_all(code, parameters, state, *driven, start, dt, pressed, moves, gives, adds, heats, force)
    return force


def act(part: Any, command: Array, load: Array, dt: float) -> Array:
    """Displacement (m) of an actuator without effects, from its command (m) and the force on it (N), a step late."""
    parameters, state = part.build(dt)
    x: Array = np.empty(len(command))
    _act_all(actuators.KINDS.index(type(part)), parameters, state, _plain(command), _plain(load), x)
    return x


def extend(effect: Effect, y: Array, x: Array, v: Array, w: Array, start: float, dt: float) -> None:
    """Replace the signal y by the signal after the effect; x, v and w as its hook defines them (`physics.effect`)."""
    parameters, state = effect.build(dt)
    _extend_all(_STEPS.index(type(effect).step), parameters, state, y, _plain(x), _plain(v), _plain(w), start, dt)


def _plain(signal: Array) -> Array:
    """The signal as numba's ordinary type of array: another one, such as a read-only array, would be compiled for anew."""
    found: Array = np.require(signal, np.float64, ("C", "W", "E"))
    return found


def velocity(x: Array, dt: float, before: float) -> Array:
    """Backward difference (x[q] - x[q - 1]) / dt; `before` is the value before the first."""
    return np.diff(x, prepend=before) / dt
