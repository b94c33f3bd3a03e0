"""The terms of the general law: restoring forces as functions of displacement, velocity, dissipated energy and time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.signal import lfilter

from rths_engine.diagnosis.components.component import Data, Feature
from rths_engine.foundation.arrays import Array
from rths_engine.running.stop import stop

# chosen; see docs/decisions/0023
Terms = list[tuple[str, str, Array]]  # formula, words, values
STOPS = (0.1, 0.3, 0.7)  # of the largest displacement
SMOOTHING = 0.02  # of the largest velocity: width over which friction changes its sign
WAVES = 12
RELAXATIONS = (0.1, 0.5, 3.0)  # s
MODULATIONS = 14  # half waves over a recording


class Sizes(NamedTuple):
    """The values that the terms of a law are scaled by: the largest of each signal, the dissipated energy and the duration.

    Recordings of several amplitudes share the sizes of the first, so that one law holds for all of them.
    """

    x: float  # m
    v: float  # m/s
    a: float  # m/s^2
    f: float  # N
    energy: float  # J
    duration: float  # s

    @classmethod
    def of(cls, x: Array, v: Array, dt: float, force: Array) -> Sizes:
        energy = float(np.sum(np.abs(force * v))) * dt
        top_x, top_v, top_a, top_f = (max(float(np.max(np.abs(one))), 1e-300) for one in (x, v, np.gradient(v, dt), force))
        return cls(top_x, top_v, top_a, top_f, max(energy, 1e-300), max(len(x) - 1, 1) * dt)


def of_motion(x: Array, v: Array, dt: float, force: Array, sizes: Sizes | None = None) -> Terms:
    """Terms of displacement x (m), velocity v (m/s), force (N), energy and time.

    x, v, a and f are divided by their sizes; without `sizes`, by their largest values. E is the dissipated energy and t the
    time, as shares of the sizes' energy and duration.
    """
    sizes = sizes or Sizes.of(x, v, dt, force)
    energy = np.cumsum(np.abs(force * v)) * dt / sizes.energy
    a = np.gradient(v, dt) / sizes.a
    x, v = x / sizes.x, v / sizes.v
    side = np.tanh(v / SMOOTHING)
    time = dt * np.arange(len(x)) / sizes.duration
    stops = [(f"stop_{r:g}(x)", f"hysteretic, closing over {100 * r:.0f} % of the amplitude", stop(x, r)) for r in STOPS]
    return [
        ("1", "constant", np.ones(len(x))),
        ("x", "proportional to displacement", x),
        ("v", "proportional to velocity", v),
        ("a", "proportional to acceleration", a),
        ("x^2", "even in displacement", x * x),
        ("x^3", "growing with the cube of displacement", x**3),
        ("x^5", "rising steeply at large displacement", x**5),
        ("sgn(v)", "of constant size against the velocity, like dry friction", side),
        ("|v|", "even in velocity", np.abs(v)),
        ("v |v|", "growing with the square of velocity", v * np.abs(v)),
        ("v^3", "growing with the cube of velocity", v**3),
        ("x |v|", "a stiffness that grows with velocity", x * np.abs(v)),
        ("|x| v", "a damping that grows with displacement", np.abs(x) * v),
        ("x^2 v", "a damping that grows with the square of displacement", x * x * v),
        ("|x| sgn(v)", "friction that grows with displacement", np.abs(x) * side),
        ("x sgn(v)", "friction that depends on the position", x * side),
        ("E x", "a stiffness that changes with the dissipated energy", energy * x),
        ("E v", "a damping that changes with the dissipated energy", energy * v),
        ("E sgn(v)", "friction that changes with the dissipated energy", energy * side),
        ("t", "a drift in time", time),
        ("t x", "a stiffness that changes in time", time * x),
        ("t v", "a damping that changes in time", time * v),
        *stops,
    ]


def of_position(x: Array, v: Array, dt: float, sizes: Sizes | None = None) -> Terms:
    """Terms that are periodic in displacement, as a force or as friction, and terms that relax in time."""
    sizes = sizes or Sizes.of(x, v, dt, v)
    largest = sizes.x
    side = np.tanh(v / sizes.v / SMOOTHING)
    found: Terms = []
    for waves in range(1, WAVES + 1):
        length = 2 * largest / waves
        periodic = f"periodic in displacement with a period of {1e3 * length:.3g} mm"
        for name, wave in (("sin", np.sin), ("cos", np.cos)):
            shape = wave(2 * np.pi * x / length)
            found.append((f"{name}(2 pi x / {1e3 * length:.3g} mm)", periodic, shape))
            found.append((f"{name}(2 pi x / {1e3 * length:.3g} mm) sgn(v)", f"friction {periodic}", shape * side))
    for time in RELAXATIONS:
        keep = np.exp(-dt / time)
        for name, words, signal in (("x", "displacement", x / largest), ("sgn(v)", "direction of motion", side)):
            slow = lfilter([1 - keep], [1, -keep], signal)
            found.append((f"{name} relaxed over {time:g} s", f"following the {words} with a delay of about {time:g} s", slow))
    return found


def modulated(values: Array, formula: str, words: str, sizes: Sizes | None = None) -> list[Feature]:
    """Terms that modulate `values` (channels, n) slowly in time; `formula` and `words` describe the values."""
    middle = (np.arange(values.shape[1]) + 0.5) / values.shape[1]
    return [
        Feature(
            f"{formula} cos({half_waves} pi t / T)",
            f"{words} that rises and falls in time",
            values * np.cos(np.pi * half_waves * middle),
            sizes,
        )
        for half_waves in range(1, MODULATIONS + 1)
    ]


def shaped(terms: Terms, data: Data, sizes: Sizes) -> list[Feature]:
    """The features of terms that add to the output, in the band of the comparison."""
    return [Feature(formula, words, data.reduced(values[None]), sizes) for formula, words, values in terms]
