"""Conversion of units at the edge of the engine: `si = factor * shown + zero`. Inside the engine every number is SI."""

from __future__ import annotations

import math
import re

from rths_engine.foundation import unit_text
from rths_engine.foundation.errors import Issue, RthsError

STANDARD_GRAVITY = 9.80665  # m/s^2, ISO 80000-3
INCH = 0.0254
POUND_FORCE = 4.4482216152605  # N
KIP = 1e3 * POUND_FORCE
KILOGRAM_FORCE = STANDARD_GRAVITY  # N
US_TON_FORCE = 2e3 * POUND_FORCE

# unit -> (dimension, factor to SI), ISO 80000 and by definition; `mg` is a thousandth of g, never a mass
UNITS: dict[str, tuple[str, float]] = {
    "1": ("number", 1.0),
    "%": ("number", 1e-2),
    "s": ("time", 1.0),
    "ms": ("time", 1e-3),
    "us": ("time", 1e-6),
    "min": ("time", 60.0),
    "h": ("time", 3600.0),
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
    "um/s": ("velocity", 1e-6),
    "m/s^2": ("acceleration", 1.0),
    "mm/s^2": ("acceleration", 1e-3),
    "cm/s^2": ("acceleration", 1e-2),
    "gal": ("acceleration", 1e-2),
    "in/s^2": ("acceleration", INCH),
    "ft/s^2": ("acceleration", 12 * INCH),
    "g": ("acceleration", STANDARD_GRAVITY),
    "mg": ("acceleration", 1e-3 * STANDARD_GRAVITY),
    "g/10": ("acceleration", 0.1 * STANDARD_GRAVITY),
    "m/s^3": ("jerk", 1.0),
    "mm/s^3": ("jerk", 1e-3),
    "kg": ("mass", 1.0),
    "t": ("mass", 1e3),
    "N": ("force", 1.0),
    "kN": ("force", 1e3),
    "MN": ("force", 1e6),
    "mN": ("force", 1e-3),
    "daN": ("force", 10.0),
    "kgf": ("force", KILOGRAM_FORCE),
    "tf": ("force", 1e3 * KILOGRAM_FORCE),
    "tonf(US)": ("force", US_TON_FORCE),
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
    "N*m*s": ("rotational damping", 1.0),
    "kN*m*s": ("rotational damping", 1e3),
    "kg*m^2": ("rotary inertia", 1.0),
    "t*m^2": ("rotary inertia", 1e3),
    "N/m^2": ("stress", 1.0),
    "Pa": ("stress", 1.0),
    "kPa": ("stress", 1e3),
    "MPa": ("stress", 1e6),
    "GPa": ("stress", 1e9),
    "bar": ("stress", 1e5),
    "psi": ("stress", POUND_FORCE / INCH**2),
    "ksi": ("stress", KIP / INCH**2),
    "J": ("energy", 1.0),
    "mJ": ("energy", 1e-3),
    "kJ": ("energy", 1e3),
    "MJ": ("energy", 1e6),
    "GJ": ("energy", 1e9),
    "N*m": ("energy", 1.0),
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
    "mm/N": ("flexibility", 1e-3),
    "mm/MN": ("flexibility", 1e-9),
    "N/m^3": ("cubic stiffness", 1.0),
    "kN/m^3": ("cubic stiffness", 1e3),
    "N/mm^3": ("cubic stiffness", 1e9),
    "kN/mm^3": ("cubic stiffness", 1e12),
    "N*(s/m)^2": ("quadratic damping", 1.0),
    "kN*(s/m)^2": ("quadratic damping", 1e3),
    "MN*(s/m)^2": ("quadratic damping", 1e6),
    "1/J": ("per energy", 1.0),
    "1/MJ": ("per energy", 1e-6),
    "1/kJ": ("per energy", 1e-3),
    "1/s": ("per time", 1.0),
    "1/s^2": ("per time squared", 1.0),
    "N/(m*s^3)": ("stiffness per time cubed", 1.0),
    "1/m": ("per length", 1.0),
    "1/mm": ("per length", 1e3),
    "1/N": ("per force", 1.0),
    "1/kN": ("per force", 1e-3),
    "1/MN": ("per force", 1e-6),
    "s/m": ("time per length", 1.0),
    "ms/mm": ("time per length", 1.0),
    "us/mm": ("time per length", 1e-3),
    "A": ("current", 1.0),
    "mA": ("current", 1e-3),
    "ohm": ("resistance", 1.0),
    "V": ("voltage", 1.0),
    "mV": ("voltage", 1e-3),
    "V/V": ("voltage ratio", 1.0),
    "mV/V": ("voltage ratio", 1e-3),
    "m/(s*V)": ("velocity per voltage", 1.0),
    "mm/(s*V)": ("velocity per voltage", 1e-3),
    "K": ("temperature", 1.0),
    "1/K": ("per temperature", 1.0),
    "degC": ("temperature", 1.0),
    "degF": ("temperature", 5 / 9),
    "m/m": ("strain", 1.0),
    "um/m": ("strain", 1e-6),
    "rad": ("angle", 1.0),
    "mrad": ("angle", 1e-3),
    "deg": ("angle", math.pi / 180),
    "count": ("count", 1.0),
    "N*(s/m)^n": ("power-law damping", 1.0),
    "kN*(s/m)^n": ("power-law damping", 1e3),
}

# SI value of the unit's zero, for units with a zero of their own (by definition): `si = factor * shown + zero`
ZEROS = {"degC": 273.15, "degF": 459.67 * 5 / 9}

# chosen; see docs/decisions/0023
LONGEST = 40  # characters of a unit; longer text is not parsed
_BY_POWERS = {frozenset((unit_text.powers(unit) or {}).items()): unit for unit in reversed(UNITS)}
_QUANTITY = re.compile(r"^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*((?:[^\d\s.,]|1\s*/|1\s*$).*)?$")


def pretty(unit: str) -> str:
    """The unit as shown to people: `kN*s/m` -> `kN·s/m`, `1` -> empty."""
    return unit_text.shown(unit)


def named(text: str) -> str | None:
    """The unit of UNITS that `text` names, in any spelling (`1/mm²`, `1/mm^2`, `mm^-2`); None where it names no unit."""
    typed = text.strip()
    if typed in UNITS or len(typed) > LONGEST:
        return typed if typed in UNITS else None
    found = unit_text.powers(typed)
    return None if found is None else _BY_POWERS.get(frozenset(found.items()))


def factor(unit: str) -> float:
    """SI value of one `unit`. Raises RthsError for an unknown unit."""
    return _lookup(unit)[1]


def zero(unit: str) -> float:
    """SI value at zero of `unit`: 273.15 for degC, 0 for units that share the zero of their SI unit."""
    return ZEROS.get(unit, 0.0)


def dimension(unit: str) -> str:
    """Dimension of `unit`, such as `force`. Raises RthsError for an unknown unit."""
    return _lookup(unit)[0]


def of_dimension(dimension: str) -> tuple[str, ...]:
    """The units of a dimension, in the order of the table."""
    return tuple(unit for unit, (kind, _) in UNITS.items() if kind == dimension)


def to_si(value: float, unit: str) -> float:
    """A value in `unit`, converted to SI."""
    return value * factor(unit) + zero(unit)


def from_si(value: float, unit: str) -> float:
    """A value in SI, converted to `unit`."""
    return (value - zero(unit)) / factor(unit)


def parse(text: str, unit: str) -> float:
    """The SI value of a text such as `"36007 kN/m"`; `unit` (here `N/m`) gives the dimension. A number without unit is SI.

    Numbers and units can be written as they are shown, `−0.4 1/mm²`, or as they are typed, `-0.4 1/mm^2`. Raises RthsError
    if the text is not a number, or if its unit is unknown or has a different dimension.
    """
    found = _QUANTITY.match(unit_text.ascii_signs(text))
    if not found:
        example = f", optionally with a unit such as '{pretty(unit)}'" if pretty(unit) else ""
        raise RthsError(Issue("", f"needs a number{example}", text))
    number, written = float(found[1]), (found[2] or "").strip()
    if not written:
        return number
    given = named(written)
    dimension = _lookup(unit)[0]
    if given is None or UNITS[given][0] != dimension:
        allowed = ", ".join(pretty(name) or "no unit" for name, (kind, _) in UNITS.items() if kind == dimension)
        raise RthsError(Issue("", f"needs a unit of {dimension}: {allowed}", text))
    return to_si(number, given)


def _lookup(unit: str) -> tuple[str, float]:
    try:
        return UNITS[unit]
    except KeyError:
        raise RthsError(Issue("", f"is not a known unit; the known units are {', '.join(UNITS)}", unit)) from None
