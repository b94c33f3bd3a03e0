"""What a run records: the columns of its signals, with units inside and shown."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from rths_engine.foundation import units

if TYPE_CHECKING:
    from rths_engine.planning.plan import Plan

_STATION = (
    ("x_cmd", "Command displacement", "m", "mm"),
    ("x_comp", "Compensated command", "m", "mm"),
    ("x_meas", "Measured displacement", "m", "mm"),
    ("f_meas", "Measured force", "N", "kN"),
    ("error", "Tracking error", "m", "mm"),
    ("ti", "Tracking indicator", "m^2", "mm^2"),
    ("d_alpha", "Δα", "1", "1"),
    ("energy_error", "Energy error", "J", "kN*m"),
)


@dataclass(frozen=True, slots=True)
class Channel:
    """One recorded column. `unit` is SI, `shown` for people, SI = factor * shown; `group`: s1, s2, ..., floors, input."""

    key: str
    label: str
    unit: str
    shown: str
    group: str

    @property
    def shown_label(self) -> str:
        return units.pretty(self.shown)

    @property
    def factor(self) -> float:
        return units.factor(self.shown)

    def as_dict(self) -> dict[str, Any]:
        return {**asdict(self), "shown_label": self.shown_label, "factor": self.factor}


def channels(plan: Plan) -> tuple[Channel, ...]:
    """Columns in the order of the compiled loop: inputs (ground acceleration, forces on floors), floors, stations."""
    found = []
    if not plan.driven:
        found.append(Channel("ag", "Ground acceleration", "m/s^2", "g", "input"))
        for number, force in enumerate(plan.forces, start=1):
            found.append(Channel(f"force{number}", f"Force on floor {force.floor}", "N", "kN", "input"))
        for floor in range(1, len(plan.assembled().floors) + 1):
            found.append(Channel(f"floor{floor}.x", f"Floor {floor} displacement", "m", "mm", "floors"))
    for number, station in enumerate(plan.stations, start=1):
        found += [
            Channel(f"s{number}.{key}", f"{station.name}: {label}", unit, shown, f"s{number}")
            for key, label, unit, shown in _STATION
        ]
    return tuple(found)
