"""Histories and helpers for tests of left-out effects."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import entry
from rths_engine.parts.physics.effect import COMMAND, F_SENSOR, FORCE, HEAT, INPUT, PISTON, SERIES, STOREY, X_SENSOR, Effect
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.structures.assembled import Assembled
from rths_engine.parts.structures.shear_building import ShearBuilding
from rths_engine.running.dispatch import effects, extend_actuator, extend_sensor, extend_specimen, extend_storey

DT = 1 / 512
TIME = DT * np.arange(int(16 / DT))
PATH = 0.05 * np.sin(2 * np.pi * 0.9 * TIME) * np.sin(0.4 * TIME) + 0.004 * np.sin(2 * np.pi * 4.3 * TIME)
SPEED = np.diff(PATH, prepend=0.0) / DT
LOAD = 1e5 * np.tanh(SPEED / 0.02) + 2e6 * PATH
CURRENT = 1.0 + np.sign(np.sin(2 * np.pi * 0.3 * TIME))
TEMPERATURE = 290.0 + TIME
ENERGY = float(np.sum(np.abs(LOAD * SPEED)) * DT)
SEEN = Seen(
    float(np.abs(PATH).max()), float(np.abs(SPEED).max()), float(np.abs(LOAD).max()), float(TIME[-1]), ENERGY, DT, storey=2
)


@entry
def _streamed(hook: int, left_out: Any, y: Array, x: Array, v: Array, w: Array, dt: float, out: Array) -> None:
    for q in range(y.size):
        t = q * dt
        if hook <= PISTON:
            out[q] = extend_actuator(hook, left_out, y[q], x[q], v[q], w[q], t, dt)
        elif hook <= HEAT:
            out[q] = extend_specimen(hook, left_out, y[q], x[q], v[q], w[q], t, dt)
        elif hook <= F_SENSOR:
            out[q] = extend_sensor(hook, left_out, y[q], x[q], v[q], w[q], t, dt)
        else:
            out[q] = extend_storey(hook, left_out, y[q], x[q], v[q], w[q], t, dt)


def streamed(effect: Effect, signals: tuple[Array, Array, Array, Array]) -> Array:
    """What the compiled effect makes of its signals y, x, v, w."""
    out = np.zeros_like(signals[0])
    _streamed(effect.hook, effects([effect], DT), *signals, DT, out)
    return out


def signals(hook: int) -> tuple[Array, Array, Array, Array]:
    """y, x, v, w of the contract of `Effect` at a hook."""
    last_load = np.concatenate([[0.0], LOAD[:-1]])
    late = np.concatenate([np.zeros(9), PATH[:-9]])
    still = np.zeros_like(PATH)
    return {
        COMMAND: (PATH, late, np.diff(late, prepend=0.0) / DT, last_load),
        PISTON: (late, PATH, SPEED, last_load),
        INPUT: (PATH, PATH, SPEED, last_load),
        SERIES: (still, PATH, SPEED, last_load),
        FORCE: (LOAD, PATH, SPEED, CURRENT),
        HEAT: (LOAD, PATH, SPEED, TEMPERATURE),
        X_SENSOR: (PATH, PATH, SPEED, PATH),
        F_SENSOR: (LOAD, PATH, SPEED, LOAD),
        STOREY: (still, PATH, SPEED, 2e6 * PATH),
    }[hook]


def stepped(effect: Effect, y: Array, x: Array | None = None, w: Array | None = None, dt: float = DT) -> Array:
    """The effect's Python step over the signals; v is the increment of x (of y where no x is given) over dt, 0 at first."""
    x = y if x is None else x
    w = np.zeros_like(y) if w is None else w
    v = np.diff(x, prepend=x[0]) / dt
    parameters, state = effect.build(dt)
    return np.array([effect.step(parameters, state, y[q], x[q], v[q], w[q], q * dt, dt) for q in range(len(y))])


def building(stiffnesses: tuple[float, ...] = (4e7, 3e7, 2e7), masses: tuple[float, ...] = (3e4, 2e4, 1e4)) -> Assembled:
    storeys = [{"mass": mass, "stiffness": stiffness} for mass, stiffness in zip(masses, stiffnesses, strict=True)]
    return ShearBuilding.model_validate({"storeys": storeys, "damping_ratio": 0.03}).assemble()


def enclosed(force: Array, x: Array) -> float:
    """Work round a closed cycle by the trapezoidal rule."""
    return float(np.trapezoid(force, x))
