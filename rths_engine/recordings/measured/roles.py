"""Roles of measured channels: their dimension, and whether their number is a station or a floor."""

from __future__ import annotations

from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.units import dimension
from rths_engine.results.channels import CHANNELS, key

__all__ = ["RAW", "ROLES", "SHOWN", "SI", "UNITS", "dimension", "key", "shown", "to_si", "units_of"]

ROLES = {name: role for name, role in CHANNELS.items() if not role.derived}
_ALSO = {units.UNITS[unit][0]: unit for role in ROLES.values() for unit in role.also}

# dimension -> unit in files, unit for people
SI = _ALSO | {role.dimensions[0]: role.unit for role in ROLES.values()}
SHOWN = _ALSO | {role.dimensions[0]: role.shown for role in ROLES.values()}

RAW = ("voltage", "voltage ratio", "count")  # readings of a transducer before its calibration: a gain converts them
_NO_ROLE = ("strain", "angle", "stress", "mass")  # measured quantities; a gain can convert them to a quantity of a role
UNITS = tuple(unit for unit, (kind, _) in units.UNITS.items() if kind in {*SI, *RAW, *_NO_ROLE})


def units_of(role: str) -> tuple[str, ...]:
    """The units that a column with this role can have, without a gain."""
    return tuple(unit for kind in ROLES[role].dimensions for unit in units.of_dimension(kind) if unit in UNITS)


def to_si(unit: str) -> tuple[float, float]:
    """Factor and zero of a unit: SI = factor * value + zero."""
    return units.factor(unit), units.zero(unit)


def shown(values: Array, unit: str) -> tuple[Array, str]:
    """SI values in the unit that people read, and this unit."""
    name = SHOWN[dimension(unit)]
    factor, zero = to_si(name)
    return (values - zero) / factor, name
