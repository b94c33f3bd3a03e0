"""Shear buildings with left-out physics: M x'' + C y' + K y + sum l_s r_s = -M iota a,  y = x - iota b on a flexible base."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numba import njit
from scipy.linalg import eigh, expm

from tests.proof.generator.motion import Array

FINE = 1e-4  # s: substeps are at most this long, (omega h)^5 < 1e-11 at 10 Hz
(
    FRICTION,
    QUADRATIC,
    CUBIC,
    YIELDING,
    HYSTERESIS,
    PINCHING,
    GAP,
    DROP,
    MEMORY,
    HEALING,
    COGGING,
    PARAMETRIC,
    ONE_SIDED,
    SOFTENING,
    TURNED,
    FLAG,
) = range(16)
NUMBERS = 4  # of an element, at most


@dataclass
class Building:
    """Floor masses (kg), storey stiffnesses (N/m), damping ratio of modes 1 and 2; x relative to the ground."""

    masses: Array
    stiffnesses: Array
    ratio: float

    @property
    def drifts(self) -> Array:
        return np.eye(len(self.masses)) - np.eye(len(self.masses), k=-1)

    def matrices(self) -> tuple[Array, Array, Array]:
        """M, C, K with Rayleigh damping: ratio = (a_0 / omega + a_1 omega) / 2 at the first two frequencies."""
        mass, stiffness = np.diag(self.masses), self.drifts.T @ np.diag(self.stiffnesses) @ self.drifts
        omega = np.sqrt(eigh(stiffness, mass, eigvals_only=True))
        first, second = omega[0], omega[min(1, len(omega) - 1)]
        by_mass, by_stiffness = 2 * self.ratio * first * second / (first + second), 2 * self.ratio / (first + second)
        return mass, by_mass * mass + by_stiffness * stiffness, stiffness


@dataclass
class Element:
    """Physics of storey `number` (from 1), against its drift d, rate v and elastic force w = k d; its one state is s.

    FRICTION    F s,  x_e s' = v - |v| s  (LuGre)              QUADRATIC  c |v| v           CUBIC  k_3 d^3
    YIELDING    (1 - r) (F_y s - w),  F_y s' = w' unless |s| = 1 and w goes on             PINCHING  -p w exp(-(d / d_p)^2)
    HYSTERESIS  F s,  x_y s' = v - eta |v| |s|^(n-1) s - (1 - eta) v |s|^n  (Bouc-Wen)     DROP  -p w from t_d on
    GAP         k max(d - g, 0) + k min(d + g, 0)          SOFTENING  -p w |d| / (|d| + d_s)
    TURNED      -p w (1 - exp(-s)),  E_d s' = |w v|           FLAG  F s,  x_a s' = v within the flag's borders
    Outside any library: MEMORY F s^3, tau s' = v / v_m - s;  HEALING -p w (1 - exp(-s)), s' = |v| / travel - s / tau;
    COGGING F sin(2 pi d / pitch);  PARAMETRIC p w sin(2 pi f t);  ONE_SIDED c max(v, 0)^3
    """

    number: int
    kind: int
    numbers: tuple[float, ...]


@dataclass
class Whole:
    """What changes of the whole structure: shares of storey stiffness, of floor mass, of damping; gravity; a flexible base."""

    stiffness: dict[int, float] = field(default_factory=dict)
    mass: dict[int, float] = field(default_factory=dict)
    damping: float = 0.0
    gravity: float = 0.0
    base: float = 0.0  # m/N

    def joined(self, other: Whole) -> Whole:
        return Whole(
            {**self.stiffness, **other.stiffness},
            {**self.mass, **other.mass},
            self.damping + other.damping,
            self.gravity + other.gravity,
            self.base + other.base,
        )


def changed(building: Building, whole: Whole) -> tuple[Array, Array, Array]:
    """M, C, K with the changes; C stays that of the plan but for its own share."""
    mass, damping, stiffness = building.matrices()
    rows = building.drifts
    for storey, share in whole.stiffness.items():
        row = rows[storey - 1]
        stiffness = stiffness + share * building.stiffnesses[storey - 1] * np.outer(row, row)
    if whole.gravity:
        above = np.cumsum(building.masses[::-1])[::-1]
        geometric = rows.T @ np.diag(above) @ rows
        stiffness = stiffness - whole.gravity * geometric / eigh(geometric, stiffness, eigvals_only=True)[-1]
    scale = np.ones(len(mass))
    for floor, share in whole.mass.items():
        scale[floor - 1] += share
    return mass * scale, (1 + whole.damping) * damping, stiffness


def response(
    building: Building,
    whole: Whole,
    elements: Sequence[Element],
    ground: Callable[[Array], Array],
    time: Array,
    start: tuple[Array, Array] | None = None,
) -> tuple[Array, Array]:
    """Displacements against the ground and absolute accelerations (floors, samples) at even `time` from 0."""
    mass, damping, stiffness = changed(building, whole)
    x, v = start or (np.zeros(len(mass)), np.zeros(len(mass)))
    step = float(time[1] - time[0])
    parts = math.ceil(step / FINE)
    half = ground(np.arange(2 * parts * (len(time) - 1) + 1) * step / (2 * parts))
    if whole.base:
        if elements:
            raise ValueError("a flexible base is solved by matrices, without elements")
        return _on_base(mass, damping, stiffness, whole.base, half[:: 2 * parts], step, np.concatenate([x, v, [0.0]]))
    kinds, storeys = (np.array([getattr(one, name) for one in elements], dtype=np.int64) for name in ("kind", "number"))
    numbers = np.zeros((len(elements), NUMBERS))
    for place, one in enumerate(elements):
        numbers[place, : len(one.numbers)] = one.numbers
    inverse = 1 / np.diag(mass)
    first = np.concatenate([x, v, np.zeros(len(elements))])
    found = _marched(
        inverse, damping, stiffness, building.stiffnesses, kinds, storeys - 1, numbers, half, parts, step / parts, first
    )
    return found[: len(mass)], found[len(mass) :]


def _on_base(
    mass: Array, damping: Array, stiffness: Array, base: float, ground: Array, step: float, s: Array
) -> tuple[Array, Array]:
    """Exact for a ground acceleration linear between samples: s' = A s + B a,  iota^T (C y' + K y) = b / phi."""
    count, iota = len(mass), np.ones(len(mass))
    rates, into = np.zeros((2 * count + 1, 2 * count + 1)), np.zeros(2 * count + 1)
    rates[:count, count : 2 * count] = np.eye(count)
    shear = np.concatenate([iota @ stiffness, iota @ damping, [-iota @ stiffness @ iota - 1 / base]])
    rates[-1] = shear / (iota @ damping @ iota)
    forces = np.hstack([stiffness, damping, -(stiffness @ iota)[:, None]]) - np.outer(damping @ iota, rates[-1])
    rates[count : 2 * count] = -np.linalg.solve(mass, forces)
    into[count : 2 * count] = -1.0
    whole = np.zeros((2 * count + 3, 2 * count + 3))
    whole[:-2, :-2], whole[:-2, -2], whole[-2, -1] = rates, into, 1 / step
    moved = expm(whole * step)
    states = [s]
    for now, then in pairwise(ground.tolist()):
        states.append(moved[:-2, :-2] @ states[-1] + moved[:-2, -2] * now + moved[:-2, -1] * (then - now))
    found = np.array(states).T
    return found[:count], (rates @ found)[count : 2 * count]


@njit(cache=True)
def _within(p, d, s):  # type: ignore[no-untyped-def]
    """s within the borders of a flag at the drift d: opening at 1, closing at 1 - p[2]."""
    side = 1.0 if d >= 0.0 else -1.0
    reach = abs(d) / p[1]
    return side * min(max(side * s, min(reach, 1.0 - p[2])), min(reach, 1.0))


@njit(cache=True)
def _force(kind, p, t, d, v, w, s):  # type: ignore[no-untyped-def]
    if kind in (FRICTION, HYSTERESIS):
        return p[0] * s
    if kind == QUADRATIC:
        return p[0] * abs(v) * v
    if kind == CUBIC:
        return p[0] * d**3
    if kind == YIELDING:
        return (1.0 - p[1]) * (min(max(s, -1.0), 1.0) * p[0] - w)
    if kind == PINCHING:
        return -p[0] * w * math.exp(-((d / p[1]) ** 2))
    if kind == GAP:
        return p[1] * (max(d - p[0], 0.0) + min(d + p[0], 0.0))
    if kind == DROP:
        return -p[0] * w if t > p[1] else 0.0
    if kind == MEMORY:
        return p[0] * s**3
    if kind in (HEALING, TURNED):
        return -p[0] * w * (1.0 - math.exp(-s))
    if kind == FLAG:
        return p[0] * _within(p, d, s)
    if kind == SOFTENING:
        return -p[0] * w * abs(d) / (abs(d) + p[1])
    if kind == COGGING:
        return p[0] * math.sin(2.0 * math.pi * d / p[1])
    if kind == PARAMETRIC:
        return p[0] * w * math.sin(2.0 * math.pi * p[1] * t)
    return p[0] * max(v, 0.0) ** 3


@njit(cache=True)
def _slope(kind, p, d, v, w, w_rate, s):  # type: ignore[no-untyped-def]
    if kind == FRICTION:
        return (v - abs(v) * s) / p[1]
    if kind == YIELDING:
        return 0.0 if abs(s) >= 1.0 and s * w_rate > 0.0 else w_rate / p[0]
    if kind == HYSTERESIS:
        turned = p[3] * abs(v) * abs(s) ** (p[2] - 1.0) * s
        return (v - turned - (1.0 - p[3]) * v * abs(s) ** p[2]) / p[1]
    if kind == MEMORY:
        return (v / p[1] - s) / p[2]
    if kind == HEALING:
        return abs(v) / p[1] - s / p[2]
    if kind == TURNED:
        return abs(w * v) / p[1]
    if kind == FLAG:  # towards a border that it has left, within a time far below a substep of the recording
        inside = _within(p, d, s)
        return v / p[1] if inside == s else (inside - s) / 1e-3
    return 0.0


@njit(cache=True)
def _slopes(inverse, damping, stiffness, elastic, kinds, storeys, numbers, a, t, s, grown):  # type: ignore[no-untyped-def]
    n = inverse.size
    for i in range(n):
        force = 0.0
        for j in range(n):
            force += stiffness[i, j] * s[j] + damping[i, j] * s[n + j]
        grown[i], grown[n + i] = s[n + i], -inverse[i] * force - a
    for e in range(kinds.size):
        top, own = storeys[e], 2 * n + e
        d, v = s[top], s[n + top]
        if top > 0:
            d, v = d - s[top - 1], v - s[n + top - 1]
        k = elastic[top]
        force = _force(kinds[e], numbers[e], t, d, v, k * d, s[own])
        grown[n + top] -= inverse[top] * force
        if top > 0:
            grown[n + top - 1] += inverse[top - 1] * force
        grown[own] = _slope(kinds[e], numbers[e], d, v, k * d, k * v, s[own])


@njit(cache=True)
def _marched(inverse, damping, stiffness, elastic, kinds, storeys, numbers, half, parts, h, s):  # type: ignore[no-untyped-def]
    """Classical Runge-Kutta over substeps h; `half` the ground acceleration every h / 2. Rows: x, then x'' + a."""
    n, count = inverse.size, (half.size - 1) // (2 * parts) + 1
    found = np.empty((2 * n, count))
    one, two, three, four, work = np.empty(s.size), np.empty(s.size), np.empty(s.size), np.empty(s.size), np.empty(s.size)
    for q in range(count):
        for part in range(parts):
            place = 2 * (q * parts + part)
            t = h * (q * parts + part)
            _slopes(inverse, damping, stiffness, elastic, kinds, storeys, numbers, half[place], t, s, one)
            if part == 0:
                for i in range(n):
                    found[i, q], found[n + i, q] = s[i], one[n + i] + half[place]
                if q == count - 1:
                    break
            work[:] = s + 0.5 * h * one
            _slopes(inverse, damping, stiffness, elastic, kinds, storeys, numbers, half[place + 1], t + 0.5 * h, work, two)
            work[:] = s + 0.5 * h * two
            _slopes(inverse, damping, stiffness, elastic, kinds, storeys, numbers, half[place + 1], t + 0.5 * h, work, three)
            work[:] = s + h * three
            _slopes(inverse, damping, stiffness, elastic, kinds, storeys, numbers, half[place + 2], t + h, work, four)
            s = s + h / 6.0 * (one + 2.0 * two + 2.0 * three + four)
    return found


def off(building: Building, stiffness: Array, damping: float) -> Building:
    """The building as another sees it: stiffnesses and damping ratio off by shares."""
    return replace(building, stiffnesses=building.stiffnesses * (1 + stiffness), ratio=building.ratio * (1 + damping))
