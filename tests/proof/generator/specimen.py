"""The force of a specimen over a motion: x -> connection -> law -> effects -> force."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence

import numpy as np
from scipy.integrate import solve_ivp

from tests.proof.generator.laws import Law
from tests.proof.generator.left_out import At, Effect, Series
from tests.proof.generator.motion import Array, Motion

RTOL, ATOL = 1e-8, 1e-9  # of states of order one
MOST = 600_000  # evaluations of the equations: a record takes some 100 000
Current = Callable[[float], float]


def steady(time: float) -> float:
    return 1.0


def mild(time: float) -> float:
    return 293.15


def force(
    law: Law,
    effects: Sequence[Effect | Series],
    motion: Motion,
    time: Array,
    current: Current = steady,
    temperature: Current = mild,
) -> Array:
    """Force (N) at `time`, from rest, under a current (A) and a temperature (K)."""
    connection = next((one for one in effects if isinstance(one, Series)), None)
    others = [one.prepared(current, float(time[-1])) for one in effects if isinstance(one, Effect)]
    if connection:
        return _through(connection, law, others, motion, time, current)
    return _direct(law.prepared(motion), others, motion, time, current, temperature)


def _direct(law: Law, effects: Sequence[Effect], motion: Motion, time: Array, current: Current, temperature: Current) -> Array:
    places = np.cumsum([law.states, *(one.states for one in effects)]).tolist()
    start = [0.0] * law.states + [value for one in effects for value in one.start(current(0.0))]

    def felt(at: At, s: Sequence[float]) -> tuple[float, float]:
        """What the law feels of the displacement, and its rate."""
        shares = [one.felt(at, s[place : place + one.states]) for one, place in zip(effects, places, strict=False)]
        share = math.prod(shares)
        if share == 1.0:
            return at.x, at.v
        f = law.force(at.t, share * at.x, share * at.v, s)
        rates = [one.felt_rate(at, s[place : place + one.states], f) for one, place in zip(effects, places, strict=False)]
        return share * at.x, share * at.v + at.x * sum(rates)

    def through(t: float, s: Sequence[float]) -> tuple[float, list[float]]:
        x, v, a = motion(t)
        at = At(t, x, v, a, current(t), temperature(t))
        u, rate = felt(at, s)
        f, slopes = law.force(t, u, rate, s), law.slopes(t, u, rate, s)
        for one, place in zip(effects, places, strict=False):
            own, before = s[place : place + one.states], f
            f = one.force(at, own, before)
            slopes = slopes + one.slopes(at, own, before, f)
        return f, slopes

    if not start:
        return np.array([through(t, [])[0] for t in time.tolist()])
    states = solved(lambda t, s: through(t, s.tolist())[1], start, time)
    return np.array([through(t, s)[0] for t, s in zip(time.tolist(), states.T.tolist(), strict=True)])


def _through(connection: Series, law: Law, effects: Sequence[Effect], motion: Motion, time: Array, current: Current) -> Array:
    """The state u of the specimen's end (over the peak of x) and the effects' own; effects are slow factors of the force."""
    scale = float(np.max(np.abs(motion.sample(time))))
    places = np.cumsum([1, *(one.states for one in effects)]).tolist()

    def slopes(t: float, s: Array) -> list[float]:
        x, v, a = motion(t)
        states = s.tolist()
        u = states[0] * scale
        f, stiffness = connection.pulled(x - u)
        at, factor = At(t, u, 0.0, a, current(t)), 1.0
        for one, place in zip(effects, places, strict=False):
            own = states[place : place + one.states]
            factor *= one.force(at, own, f) / f if f else 1.0
        rate = law.rate(u, f / factor, stiffness / factor, v)
        at = At(t, u, rate, a, current(t))
        grown = [rate / scale]
        for one, place in zip(effects, places, strict=False):
            grown += one.slopes(at, states[place : place + one.states], f / factor, f)
        return grown

    start = [0.0, *(value for one in effects for value in one.start(current(0.0)))]
    states = solved(slopes, start, time)
    x = motion.sample(time)
    return np.array([connection.pulled(d)[0] for d in (x - states[0] * scale).tolist()])


def solved(slopes: Callable[[float, Array], Sequence[float]], start: Sequence[float], time: Array) -> Array:
    """States (rows) at `time`. LSODA turns to its stiff method where contact or friction asks for it.

    Raises ArithmeticError where the equations are so stiff that MOST evaluations do not solve them.
    """
    asked = itertools.count()

    def limited(t: float, s: Array) -> Sequence[float]:
        if next(asked) > MOST:
            raise ArithmeticError(f"more than {MOST} evaluations: the equations are too stiff")
        return slopes(t, s)

    found = solve_ivp(limited, (time[0], time[-1]), start, method="LSODA", t_eval=time, rtol=RTOL, atol=ATOL, max_step=0.02)
    if not found.success:
        raise ArithmeticError(found.message)
    return np.asarray(found.y)
