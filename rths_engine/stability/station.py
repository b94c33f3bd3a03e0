"""A station about rest as a linear system of one controller step, derived from the steps that its parts run in a test."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.specimens.commanded import Commanded
from rths_engine.planning.plan import Station

# chosen; see docs/decisions/0023
AMPLITUDE = 1e-9  # m, below any yield, slack or limit; about rest rounding is relative, so no precision is lost
EXCITED = 24  # controller steps of random command that show which states move
NEGLIGIBLE = 1e-10  # of the largest value
FEWEST = 16  # number of states at which a realisation begins
MOST = 512  # responses in a realisation: systems with nearly as many states, or whose response never settles, are refused


class Lifted(NamedTuple):
    """A station over n controller steps, the command ramping from x0 to x1: s -> power s + start x0 + end x1;  f = c s."""

    power: Array
    start: Array
    end: Array
    c: Array


@dataclass(frozen=True, slots=True)
class LinearStation:
    """A station about rest as a linear system: s[q] = a s[q-1] + b x_cmd[q], f[q] = c s[q].

    f[q] is the force (N) of one specimen at controller step q. a (m, m), b (m), c (m).
    Unit perturbations of the parts' own steps give the matrices. A nonlinear specimen has its initial tangent, an adaptive
    compensator its start value (the tracking indicator is of second order). Not valid beyond yielding or a limit.
    """

    a: Array
    b: Array
    c: Array

    def over(self, n: int) -> Lifted:
        power, start, end = np.eye(len(self.b)), np.zeros_like(self.b), np.zeros_like(self.b)
        for q in range(1, n + 1):
            power = self.a @ power
            start = self.a @ start + self.b * (1 - q / n)
            end = self.a @ end + self.b * (q / n)
        return Lifted(power, start, end, self.c)


def linear(station: Station, dt: float, added: float = 0.0) -> LinearStation:
    """The station with `added` controller steps of delay. Raises PlanError when a part has no linear behaviour about rest."""
    chain = _Chain(station, dt, added)
    still = np.array_equal(chain.step(chain.rest, 0.0), chain.rest)
    found = _perturbed(chain) if still else _realised(chain)
    if not all(np.isfinite(one).all() for one in (found.a, found.b, found.c)):
        raise PlanError(not_linear(station.name))
    return found


def not_linear(name: str) -> Issue:
    """The issue of a station whose response about rest is not finite."""
    return Issue("", f"station '{name}' cannot be linearised about rest", fix="check the values of its parts")


def delay(station: Station) -> float | None:
    """The delay constant alpha of the station, which added delay increases; None where added delay is a separate lag."""
    return station.actuator.alpha if isinstance(station.actuator, FirstOrderDelay) else None


class _Chain:
    """One controller step of a station: compensator, actuator, lag and specimen, as the loop runs them without noise.

    Flat state: compensator, actuator, specimen, lagging displacement (m), last command (m), last measured displacement (m),
    last force (N). `added` delay raises the alpha of a first-order actuator (5a). For any other actuator it is a further
    first-order lag with alpha = 1 + added, behind the actuator.
    """

    def __init__(self, station: Station, dt: float, added: float):
        self.name, self.dt, self.lag = station.name, dt, 1.0 + added
        actuator: Any = station.actuator
        if isinstance(actuator, FirstOrderDelay):
            actuator, self.lag = actuator.model_copy(update={"alpha": actuator.alpha + added}), 1.0
        specimen = station.specimen
        if isinstance(specimen, Commanded):
            specimen = specimen.at(station.controller.mean)
        self.parts: tuple[Any, ...] = (station.compensator, actuator, specimen)
        built = [part.build(dt) for part in self.parts]
        self.parameters = [parameters for parameters, _ in built]
        self.cuts = np.cumsum([len(state) for _, state in built])
        self.rest: Array = np.concatenate([*(state for _, state in built), np.zeros(4)])

    def step(self, state: Array, x_cmd: float) -> Array:
        compensator, actuator, specimen = self.parts
        own = np.split(state.copy(), self.cuts)
        x_lag, x_cmd_last, x_meas_last, force_last = (float(value) for value in own[3])
        x_comp = compensator.step(self.parameters[0], own[0], x_cmd, x_cmd_last, x_meas_last, 0.0, self.dt)
        x_true = actuator.step(self.parameters[1], own[1], x_comp, force_last)
        x_meas = x_lag + (x_true - x_lag) / self.lag
        force = specimen.step(self.parameters[2], own[2], x_meas, self.dt)
        return np.concatenate([*own[:3], [x_meas, x_cmd, x_meas, force]])


def _perturbed(chain: _Chain) -> LinearStation:
    """The linear system by central differences; each state moves about as far as under a random command of AMPLITUDE."""
    random = np.random.default_rng(0)
    state, reached = chain.rest, np.zeros(len(chain.rest))
    for command in random.normal(scale=AMPLITUDE, size=EXCITED):
        state = chain.step(state, command)
        reached = np.maximum(reached, np.abs(state - chain.rest))
    moving = np.flatnonzero(reached)
    scale = reached[moving]

    def slope(direction: Array, x_cmd: float) -> Array:
        ahead, back = chain.step(chain.rest + direction, x_cmd), chain.step(chain.rest - direction, -x_cmd)
        difference: Array = (ahead - back)[moving] / (2 * scale)
        return difference

    a = np.array([slope(size * one, 0.0) for size, one in zip(scale, np.eye(len(chain.rest))[moving], strict=True)]).T
    b = slope(np.zeros(len(chain.rest)), AMPLITUDE) / AMPLITUDE
    c = np.zeros(len(moving))
    c[moving == len(chain.rest) - 1] = scale[moving == len(chain.rest) - 1]
    a = a.reshape(len(moving), len(moving))
    kept = _joined(np.abs(a), np.abs(b) * AMPLITUDE, c != 0.0)
    return LinearStation(a[np.ix_(kept, kept)], b[kept], c[kept])


def _joined(links: Array, entered: Array, seen: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Indices of the states that the command changes and that change the force."""
    linked = links > NEGLIGIBLE
    after, before = entered > NEGLIGIBLE, seen
    for _ in range(len(after)):
        after, before = after | (linked @ after), before | (linked.T @ before)
    return np.flatnonzero(after & before)


def _realised(chain: _Chain) -> LinearStation:
    """The smallest system with the same response to a unit command (Ho-Kalman), for parts that count steps (ring buffers).

    Source: Ho and Kalman (1966), Regelungstechnik 14, 545-548.
    """
    response: list[float] = []
    state = chain.step(chain.rest, AMPLITUDE)
    order, size = FEWEST, 0
    while order > size - FEWEST // 2:  # double the order while nearly all states count
        size = 2 * max(order, FEWEST)
        if size > MOST:
            problem = f"station '{chain.name}' needs more than {MOST - FEWEST // 2} states to be described about rest"
            fix = "shorten its delays, or make its compensator stable with the actuator"
            raise PlanError(Issue("", problem, fix=fix))
        while len(response) < 2 * size:
            response.append(state[-1] / AMPLITUDE)
            state = chain.step(state, 0.0)
        if not np.isfinite(response).all():
            raise PlanError(not_linear(chain.name))
        index = np.add.outer(np.arange(size), np.arange(size))
        left, values, right = np.linalg.svd(np.array(response)[index])
        order = int(np.sum(values > NEGLIGIBLE * values[0]))
    root = np.sqrt(values[:order])
    left, right = left[:, :order], right[:order]
    a = left.T @ np.array(response)[index + 1] @ right.T / np.outer(root, root)
    return LinearStation(a, right[:, 0] * root, left[0] * root)
