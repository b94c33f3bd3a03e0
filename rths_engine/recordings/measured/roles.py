"""What a measured channel can be: its role, its dimension and what its number counts."""

from __future__ import annotations

from dataclasses import dataclass

from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array


@dataclass(frozen=True, slots=True)
class Role:
    """`counts`: station, floor, or empty where a recording has one channel of the role."""

    label: str
    dimensions: tuple[str, ...]
    counts: str = ""


ROLES: dict[str, Role] = {
    "t": Role("Time", ("time",)),
    "ag": Role("Ground acceleration", ("acceleration",)),
    "drive": Role("Drive", ("length", "voltage", "number")),
    "x_cmd": Role("Command displacement", ("length",), "station"),
    "x_comp": Role("Compensated command", ("length",), "station"),
    "x_meas": Role("Measured displacement", ("length",), "station"),
    "v_meas": Role("Measured velocity", ("velocity",), "station"),
    "f_meas": Role("Measured force", ("force",), "station"),
    "current": Role("Current", ("current",), "station"),
    "temperature": Role("Temperature", ("temperature",), "station"),
    "x_floor": Role("Floor displacement", ("length",), "floor"),
    "v_floor": Role("Floor velocity", ("velocity",), "floor"),
    "a_floor": Role("Floor acceleration", ("acceleration",), "floor"),
    "force_ext": Role("External force", ("force",), "floor"),
}

SI = {
    "time": "s",
    "acceleration": "m/s^2",
    "velocity": "m/s",
    "length": "m",
    "force": "N",
    "current": "A",
    "temperature": "K",
    "voltage": "V",
    "number": "1",
}
SHOWN = {**SI, "acceleration": "g", "velocity": "mm/s", "length": "mm", "force": "kN", "temperature": "degC"}

# unit -> (SI value of one, SI value at its zero), by definition
WITH_ZERO = {"degC": (1.0, 273.15), "degF": (5 / 9, 255.3722222222222)}
UNITS = (*(name for name, (dimension, _) in units.UNITS.items() if dimension in SI), *WITH_ZERO)


def dimension(unit: str) -> str:
    """Dimension of a unit of UNITS."""
    return "temperature" if unit in WITH_ZERO else units.UNITS[unit][0]


def to_si(unit: str) -> tuple[float, float]:
    """Factor and zero of a unit: SI = factor * value + zero."""
    return WITH_ZERO.get(unit) or (units.UNITS[unit][1], 0.0)


def key(role: str, number: int | None) -> str:
    """Name of a channel in a measured recording: `ag`, `x_meas.1`."""
    return f"{role}.{number}" if ROLES[role].counts else role


def shown(values: Array, unit: str) -> tuple[Array, str]:
    """Values in SI as people read them, with the unit they are shown in."""
    name = SHOWN[dimension(unit)]
    factor, zero = to_si(name)
    return (values - zero) / factor, name
