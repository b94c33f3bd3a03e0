"""The table of channels, and the channels that a run records.

A channel's key is its role with the station or floor that it belongs to: `ag`, `x_cmd.1`, `x_floor.2`. Runs and imported
measurements use the same keys.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from rths_engine.foundation import units
from rths_engine.planning.loads import pushed
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan, Station


@dataclass(frozen=True, slots=True)
class Role:
    """The role of a channel: its label, symbol and units.

    `unit` is SI; people read the channel in `shown`. `counts` says whether the number of a channel is that of a station or of a
    floor; it is empty where a recording has one channel of the role. `also` lists further SI units of files. A run computes
    `derived` channels from the others; they are never imported.
    """

    label: str
    symbol: str
    unit: str
    shown: str
    counts: Literal["station", "floor", ""]
    meaning: str
    also: tuple[str, ...] = ()
    derived: bool = False

    @property
    def dimensions(self) -> tuple[str, ...]:
        return tuple(units.UNITS[unit][0] for unit in (self.unit, *self.also))

    def as_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {
            "label": self.label,
            "symbol": self.symbol,
            "unit": self.unit,
            "shown": self.shown,
            "shown_label": units.pretty(self.shown),
            "factor": units.factor(self.shown),
            "counts": self.counts,
            "derived": self.derived,
            "meaning": self.meaning,
        }


CHANNELS: dict[str, Role] = {
    "t": Role("Time", "t", "s", "s", "", "time of each sample"),
    "ag": Role("Ground acceleration", "a_g", "m/s^2", "g", "", "acceleration of the ground under the structure"),
    "drive": Role("Drive", "d", "m", "mm", "", "displacement or voltage that a test without structure follows", ("V", "1")),
    "x_cmd": Role("Command displacement", "d_c", "m", "mm", "station", "displacement that the structure or the drive asks for"),
    "x_comp": Role("Compensated command", "d_p", "m", "mm", "station", "command after the delay compensator"),
    "x_meas": Role("Measured displacement", "d_m", "m", "mm", "station", "displacement that the sensor reads"),
    "v_meas": Role("Measured velocity", "v_m", "m/s", "mm/s", "station", "velocity that the sensor reads"),
    "f_meas": Role("Measured force", "r", "N", "kN", "station", "force of one specimen that the load cell reads"),
    "current": Role("Current", "I", "A", "A", "station", "electric current of the specimen, as commanded or measured"),
    "coil_voltage": Role("Coil voltage", "U", "V", "V", "station", "voltage on the coil of the specimen"),
    "temperature": Role("Temperature", "T", "K", "degC", "station", "temperature of the specimen"),
    "x_floor": Role("Floor displacement", "x", "m", "mm", "floor", "displacement of a floor relative to the ground"),
    "v_floor": Role("Floor velocity", "v", "m/s", "mm/s", "floor", "velocity of a floor relative to the ground"),
    "a_floor": Role("Floor acceleration", "a", "m/s^2", "g", "floor", "acceleration of a floor"),
    "force_ext": Role("External force", "p", "N", "kN", "floor", "sum of the external forces on a floor"),
    "v_cmd": Role(
        "Command velocity", "v_c", "m/s", "mm/s", "station", "change of d_c in one controller step over the step", derived=True
    ),
    "error": Role("Tracking error", "e", "m", "mm", "station", "d_c - d_m", derived=True),
    "ti": Role(
        "Tracking indicator", "TI", "m^2", "mm^2", "station", "0.5 (A - TA) of d_m over d_c; grows under lag", derived=True
    ),
    "d_alpha": Role("Adaptation Δα", "Δα", "1", "1", "station", "change that an adaptive compensator makes", derived=True),
    "energy_error": Role(
        "Energy error", "E", "J", "kN*m", "station", "work of r along d_c less along d_m; falls under lag", derived=True
    ),
}
RECORDED = (
    "x_cmd",
    "x_comp",
    "x_meas",
    "f_meas",
    "error",
    "ti",
    "d_alpha",
    "energy_error",
)  # of a station, in the loop's order; the current follows where a controller commands it

INPUTS, FLOORS = ("ag", "force_ext"), ("x_floor",)  # what moves a structure, and how it moves


def key(role: str, number: int | None) -> str:
    """The key of a channel: `ag`, `x_meas.1`."""
    return f"{role}.{number}" if CHANNELS[role].counts else role


@dataclass(frozen=True, slots=True)
class Channel:
    """One recorded column: its role in `CHANNELS`, its station or floor (None where there is one), its label."""

    role: str
    number: int | None
    label: str

    @property
    def key(self) -> str:
        return key(self.role, self.number)

    @property
    def unit(self) -> str:
        return CHANNELS[self.role].unit

    @property
    def shown(self) -> str:
        return CHANNELS[self.role].shown

    @property
    def shown_label(self) -> str:
        return units.pretty(self.shown)

    @property
    def factor(self) -> float:
        """SI value of one shown unit."""
        return units.factor(self.shown)

    @property
    def heading(self) -> str:
        """The heading of a column in shown units: `x_cmd.1 (mm)`."""
        return self.key if self.shown == "1" else f"{self.key} ({self.shown})"

    def as_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {
            "key": self.key,
            "role": self.role,
            "number": self.number,
            "label": self.label,
            "unit": self.unit,
            "shown": self.shown,
            "shown_label": self.shown_label,
            "factor": self.factor,
        }


def channels(planned: Plan | Model) -> tuple[Channel, ...]:
    """Columns in the order of the compiled loop: ground acceleration, forces on floors, floors, stations."""
    model = Model.of(planned)
    plan = model.plan
    found = []
    if not plan.driven:
        found.append(Channel("ag", None, CHANNELS["ag"].label))
        found += [Channel("force_ext", floor, f"Force on floor {floor}") for floor in pushed(plan)]
        floors = len(model.built.floors)
        found += [Channel("x_floor", floor, f"Floor {floor} displacement") for floor in range(1, floors + 1)]
    for number, station in enumerate(plan.stations, start=1):
        found += [Channel(role, number, f"{station.name}: {CHANNELS[role].label}") for role in recorded(station)]
    return tuple(found)


def recorded(station: Station) -> tuple[str, ...]:
    """The roles that a run records of a station, in the loop's order."""
    return RECORDED if station.controller.kind == "none" else (*RECORDED, "current")


def columns(channels: tuple[Channel, ...], *roles: str) -> list[int]:
    """The columns of all channels of these roles, in their order."""
    return [number for number, channel in enumerate(channels) if channel.role in roles]
