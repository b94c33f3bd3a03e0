"""Roles of measured channels: their dimension, and whether their number is a station or a floor."""

from __future__ import annotations

from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.unit_names import WITH_ZERO
from rths_engine.results.channels import CHANNELS, key

__all__ = ["ROLES", "SHOWN", "SI", "UNITS", "WITH_ZERO", "dimension", "key", "shown", "to_si"]

ROLES = {name: role for name, role in CHANNELS.items() if not role.derived}
_ALSO = {units.UNITS[unit][0]: unit for role in ROLES.values() for unit in role.also}

# dimension -> unit in files, unit for people
SI = _ALSO | {role.dimensions[0]: role.unit for role in ROLES.values()}
SHOWN = _ALSO | {role.dimensions[0]: role.shown for role in ROLES.values()}

UNITS = (*(name for name, (dimension, _) in units.UNITS.items() if dimension in SI), *WITH_ZERO)


def dimension(unit: str) -> str:
    """Dimension of a unit of UNITS."""
    return "temperature" if unit in WITH_ZERO else units.UNITS[unit][0]


def to_si(unit: str) -> tuple[float, float]:
    """Factor and zero of a unit: SI = factor * value + zero."""
    return WITH_ZERO.get(unit) or (units.UNITS[unit][1], 0.0)


def shown(values: Array, unit: str) -> tuple[Array, str]:
    """SI values in the unit that people read, and this unit."""
    name = SHOWN[dimension(unit)]
    factor, zero = to_si(name)
    return (values - zero) / factor, name
