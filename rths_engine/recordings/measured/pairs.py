"""Checks between channels: contradicting signs, wrong units, and devices that supply energy."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from rths_engine.formats.scratch import on_disk, release
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured import blocks, relations
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.roles import key

# chosen; see docs/decisions/0023
SURE = 0.5  # smallest correlation at which sign and factor are reported; noise and phase lag lower it
FAR = 30.0  # factor between two channels from which a unit is certainly wrong
NEAR = 1.5  # factor between two channels from which a gain can be wrong
GIVES = -0.3  # share of the exchanged energy below which a device supplies energy

_DERIVATIVES = (("x_meas", "v_meas"), ("x_floor", "v_floor"), ("v_floor", "a_floor"))
_ALIKE = (("x_cmd", "x_meas"), ("x_comp", "x_meas"), ("x_cmd", "x_comp"))


def contradictions(signals: Mapping[str, Array], dt: float) -> list[Finding]:
    """Findings about all stations and floors; `signals` are the channels in SI by their keys."""
    numbers = sorted({int(name.rpartition(".")[2]) for name in signals if "." in name})
    large = any(on_disk(one) for one in signals.values())
    return [one for found in blocks.each(lambda number: _of(number, signals, dt), numbers, large) for one in found]


@np.errstate(over="ignore", invalid="ignore")
def _of(number: int, signals: Mapping[str, Array], dt: float) -> list[Finding]:
    """Findings about one station or floor."""
    found: list[Finding] = []
    for source, derived in _DERIVATIVES:
        a, b = key(source, number), key(derived, number)
        if a in signals and b in signals:
            relation = relations.of_derivative(signals[a], signals[b], dt)
            found += _finding(relation, b, f"the derivative of {a}", certain=derived != "a_floor")
    for source, follower in _ALIKE:
        a, b = key(source, number), key(follower, number)
        if a in signals and b in signals:
            found += _finding(relations.between(signals[a], signals[b]), b, a, certain=False)
    x, force = key("x_meas", number), key("f_meas", number)
    if x in signals and force in signals and (share := relations.dissipated(signals[x], signals[force])) < GIVES:
        problem = f"supplies energy with {x}, which a passive device cannot do: the sign of one of the two is reversed"
        value = f"{-100 * share:.0f} % of the energy exchanged"
        fix = f"set reverse: true for {force} or {x}, unless the device is driven"
        found.append(Finding("warning", force, problem, value, fix=fix))
    for name, values in signals.items():
        if name.endswith(f".{number}"):
            release(values)
    return found


def _finding(relation: relations.Relation, channel: str, other: str, certain: bool) -> list[Finding]:
    """Findings about a factor other than 1 between two channels; `certain` where only a mistake explains the factor."""
    if abs(relation.correlation) < SURE:
        return []
    factor = abs(relation.factor)
    value = f"{relation.factor:.4g} times {other}"
    severity = "error" if certain else "warning"
    found = []
    if relation.correlation < 0:
        fix = "set reverse: true for one of the two channels"
        found.append(Finding(severity, channel, f"has the sign opposite to {other}", value, fix=fix))  # type: ignore[arg-type]
    if factor > FAR or factor < 1 / FAR:
        fix = f"correct a unit: {_likely(factor)}"
        problem = f"does not have the magnitude of {other}: a unit is wrong"
        found.append(Finding("error", channel, problem, value, fix=fix))
    elif certain and (factor > NEAR or factor < 1 / NEAR):
        problem = f"does not match {other}: check the unit and the gain"
        found.append(Finding("warning", channel, problem, value, fix=_likely(factor)))
    return found


def _likely(factor: float) -> str:
    known = {
        1000.0: "mm taken for m",
        25.4: "in taken for mm",
        39.37: "in taken for m",
        9.80665: "g taken for m/s^2",
        10.0: "cm and mm",
    }
    large = max(factor, 1 / factor)
    near = min(known, key=lambda one: abs(one / large - 1))
    if abs(near / large - 1) < 0.1:
        return f"a factor of {near:g} is {known[near]}, or the reverse"
    return f"a factor of {large:.3g} between the two"
