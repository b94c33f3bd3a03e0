"""Units at the edge: `si = factor * shown`. Inside the engine every number is SI."""

from __future__ import annotations

import re

from rths_engine.foundation.errors import Issue, RthsError

STANDARD_GRAVITY = 9.80665  # m/s^2, ISO 80000-3
INCH = 0.0254
POUND_FORCE = 4.4482216152605  # N
KIP = 1e3 * POUND_FORCE

# unit -> (dimension, factor to SI)
UNITS: dict[str, tuple[str, float]] = {
    "1": ("number", 1.0),
    "%": ("number", 1e-2),
    "s": ("time", 1.0),
    "ms": ("time", 1e-3),
    "us": ("time", 1e-6),
    "min": ("time", 60.0),
    "Hz": ("frequency", 1.0),
    "kHz": ("frequency", 1e3),
    "m": ("length", 1.0),
    "mm": ("length", 1e-3),
    "cm": ("length", 1e-2),
    "um": ("length", 1e-6),
    "in": ("length", INCH),
    "ft": ("length", 12 * INCH),
    "m/s": ("velocity", 1.0),
    "mm/s": ("velocity", 1e-3),
    "cm/s": ("velocity", 1e-2),
    "in/s": ("velocity", INCH),
    "ft/s": ("velocity", 12 * INCH),
    "m/s^2": ("acceleration", 1.0),
    "mm/s^2": ("acceleration", 1e-3),
    "cm/s^2": ("acceleration", 1e-2),
    "gal": ("acceleration", 1e-2),
    "in/s^2": ("acceleration", INCH),
    "ft/s^2": ("acceleration", 12 * INCH),
    "g": ("acceleration", STANDARD_GRAVITY),
    "m/s^3": ("jerk", 1.0),
    "mm/s^3": ("jerk", 1e-3),
    "kg": ("mass", 1.0),
    "t": ("mass", 1e3),
    "N": ("force", 1.0),
    "kN": ("force", 1e3),
    "MN": ("force", 1e6),
    "lb": ("force", POUND_FORCE),
    "lbf": ("force", POUND_FORCE),
    "kip": ("force", KIP),
    "N/s": ("force rate", 1.0),
    "kN/s": ("force rate", 1e3),
    "N/m": ("stiffness", 1.0),
    "N/mm": ("stiffness", 1e3),
    "kN/m": ("stiffness", 1e3),
    "kN/mm": ("stiffness", 1e6),
    "kip/in": ("stiffness", KIP / INCH),
    "N*s/m": ("damping", 1.0),
    "kN*s/m": ("damping", 1e3),
    "kN*s/mm": ("damping", 1e6),
    "N/m^2": ("stress", 1.0),
    "Pa": ("stress", 1.0),
    "MPa": ("stress", 1e6),
    "GPa": ("stress", 1e9),
    "ksi": ("stress", KIP / INCH**2),
    "J": ("energy", 1.0),
    "kN*m": ("energy", 1e3),
    "kNm": ("energy", 1e3),
    "m^2": ("area", 1.0),
    "mm^2": ("area", 1e-6),
    "1/(m^2)": ("per area", 1.0),
    "1/(mm^2)": ("per area", 1e6),
    "1/(m^2*s)": ("per area per time", 1.0),
    "1/(mm^2*s)": ("per area per time", 1e6),
    "m/N": ("flexibility", 1.0),
    "mm/kN": ("flexibility", 1e-6),
    "N/m^3": ("cubic stiffness", 1.0),
    "kN/m^3": ("cubic stiffness", 1e3),
    "N*(s/m)^2": ("quadratic damping", 1.0),
    "kN*(s/m)^2": ("quadratic damping", 1e3),
    "1/J": ("per energy", 1.0),
    "1/MJ": ("per energy", 1e-6),
    "1/s": ("per time", 1.0),
    "s/m": ("time per length", 1.0),
    "ms/mm": ("time per length", 1.0),
    "A": ("current", 1.0),
    "mA": ("current", 1e-3),
    "V": ("voltage", 1.0),
    "mV": ("voltage", 1e-3),
    "m/(s*V)": ("velocity per voltage", 1.0),
    "mm/(s*V)": ("velocity per voltage", 1e-3),
    "K": ("temperature", 1.0),
    "N*(s/m)^n": ("power-law damping", 1.0),
    "kN*(s/m)^n": ("power-law damping", 1e3),
}

# how a unit is written for people
PRETTY = {
    "1": "",
    "N*s/m": "N·s/m",
    "kN*s/m": "kN·s/m",
    "m/s^2": "m/s²",
    "mm^2": "mm²",
    "kN*m": "kN·m",
    "1/(mm^2)": "1/mm²",
    "1/(mm^2*s)": "1/(mm²·s)",
    "kN*(s/m)^n": "kN·(s/m)ⁿ",
    "N/m^3": "N/m³",
    "kN/m^3": "kN/m³",
    "m/(s*V)": "m/(s·V)",
    "mm/(s*V)": "mm/(s·V)",
    "m/s^3": "m/s³",
    "mm/s^2": "mm/s²",
    "mm/s^3": "mm/s³",
    "N*(s/m)^2": "N·(s/m)²",
    "kN*(s/m)^2": "kN·(s/m)²",
}

_QUANTITY = re.compile(r"^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S*)\s*$")


def pretty(unit: str) -> str:
    """The unit as shown to people: `kN*s/m` -> `kN·s/m`, `1` -> empty."""
    return PRETTY.get(unit, unit)


def factor(unit: str) -> float:
    """SI value of one `unit`. Raises RthsError for an unknown unit."""
    return _lookup(unit)[1]


def to_si(value: float, unit: str) -> float:
    return value * factor(unit)


def from_si(value: float, unit: str) -> float:
    return value / factor(unit)


def parse(text: str, unit: str) -> float:
    """Read `"36007 kN/m"` as SI where `unit` (here `N/m`) gives the dimension; a bare number is SI already.

    Raises RthsError if the text is no number, or its unit is unknown or of another dimension.
    """
    found = _QUANTITY.match(text)
    if not found:
        raise RthsError(Issue("", f"needs a number, optionally with a unit such as '{unit}'", text))
    number, given = float(found[1]), found[2].replace("·", "*").replace("²", "^2")
    if not given:
        return number
    dimension = _lookup(unit)[0]
    if _lookup(given)[0] != dimension:
        allowed = ", ".join(name for name, (kind, _) in UNITS.items() if kind == dimension)
        raise RthsError(Issue("", f"is no {dimension}: give it in one of {allowed}", text))
    return to_si(number, given)


def _lookup(unit: str) -> tuple[str, float]:
    try:
        return UNITS[unit]
    except KeyError:
        raise RthsError(Issue("", f"unknown unit; known are {', '.join(UNITS)}", unit)) from None
