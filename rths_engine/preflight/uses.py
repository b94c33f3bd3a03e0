"""The share of each safety limit and each capacity that a dry run uses.

A safety limit bounds the command (displacement, velocity, half waves) or the measured force. A capacity bounds the piston: its
displacement x_p = d_m - noise, its velocity (x_p[q] - x_p[q-1]) / dt, and the force of the specimen without noise. All are
compared by their largest magnitude over the controller steps. The velocity of the piston is not known, and has no row, where
the plan adds errors to the station's sensors.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.planning.plan import Station
from rths_engine.planning.safety import LIMITS
from rths_engine.preflight.dry_run import DryRun
from rths_engine.running.oscillation import longest_rows

AGAINST = {"limit": "safety limit", "actuator": "capacity of the actuator", "rig": "capacity of the rig"}


class Capacity(NamedTuple):
    """The capacity of an actuator of a rig: stroke (m), velocity (m/s) and force (N); None where it is not known."""

    stroke: float | None = None
    velocity: float | None = None
    force: float | None = None


@dataclass(frozen=True, slots=True)
class Use:
    """The largest magnitude of one quantity of a station against one bound, SI.

    `time_s` is the time of the peak and `beyond_s` the first time beyond the bound, None where the bound holds. `path` is the
    field of the plan that sets the bound.
    """

    station: int
    name: str
    quantity: str
    label: str
    against: str
    path: str
    peak: float
    time_s: float
    bound: float
    unit: str
    shown: str
    beyond_s: float | None

    @property
    def share(self) -> float:
        return self.peak / self.bound

    def as_dict(self) -> dict[str, Any]:
        """JSON form: a peak and a share that are not finite become None."""
        peak = self.peak if np.isfinite(self.peak) else None
        return {
            "station": self.station,
            "name": self.name,
            "quantity": self.quantity,
            "label": self.label,
            "against": self.against,
            "against_label": AGAINST[self.against],
            "path": self.path,
            "peak": peak,
            "bound": self.bound,
            "share": None if peak is None else self.share,
            "time_s": self.time_s,
            "beyond_s": self.beyond_s,
            "unit": self.unit,
            "shown": self.shown,
            "shown_label": units.pretty(self.shown),
            "factor": units.factor(self.shown),
        }


def uses(dry: DryRun, stations: Sequence[Station], capacities: Sequence[Capacity | None] = ()) -> list[Use]:
    """Every use of each station, against the limits of `stations` and the `capacities` of the rig, one for each station."""
    given = [*capacities, *[None] * len(stations)]
    return [use for j, station in enumerate(stations) for use in _of_station(dry, j, station, given[j])]


@np.errstate(over="ignore", invalid="ignore")
def _of_station(dry: DryRun, j: int, station: Station, capacity: Capacity | None) -> Iterator[Use]:
    dt, result, noise = dry.run.dt, dry.result, dry.run.noise[:, j]
    x_cmd, x_meas, f_meas = (result.signal(f"{role}.{j + 1}") for role in ("x_cmd", "x_meas", "f_meas"))
    v_cmd, piston, force = _rate(x_cmd, dt), x_meas - noise[:, 0], f_meas - noise[:, 1]
    of_limits = {"displacement": x_cmd, "velocity": v_cmd, "force": f_meas}
    if station.limits.oscillation:
        of_limits["oscillation"] = longest_rows(v_cmd, dt)
    for name, signal in of_limits.items():
        words, unit, shown = LIMITS[name]
        bound = float(getattr(station.limits, name))
        yield _use(dt, j, station, name, words, "limit", f"limits.{name}", signal, bound, unit, shown)
    of_actuator = {"velocity": station.actuator.velocity_limit, "force": station.actuator.force_limit}
    of_rig = {} if capacity is None else {name: value for name, value in capacity._asdict().items() if value is not None}
    signals: dict[str, tuple[str, Array]] = {"stroke": ("piston displacement", piston), "force": ("specimen force", force)}
    if not station.sensor_physics:
        signals["velocity"] = ("piston velocity", _rate(piston, dt))
    for against, bounds in (("actuator", of_actuator), ("rig", of_rig)):
        for name in [name for name in ("stroke", "velocity", "force") if name in bounds and name in signals]:
            words, signal = signals[name]
            quantity = "displacement" if name == "stroke" else name
            _, unit, shown = LIMITS[quantity]
            path = f"actuator.{name}_limit" if against == "actuator" else "actuator"
            yield _use(dt, j, station, quantity, words, against, path, signal, bounds[name], unit, shown)


def _use(
    dt: float,
    j: int,
    station: Station,
    quantity: str,
    words: str,
    against: str,
    path: str,
    signal: Array,
    bound: float,
    unit: str,
    shown: str,
) -> Use:
    size = np.abs(signal)
    size[np.isnan(size)] = np.inf
    at = int(np.argmax(size)) if len(size) else 0
    peak = float(size[at]) if len(size) else 0.0
    beyond = (int(np.argmax(size > bound)) + 1) * dt if peak > bound else None
    where = f"stations.{j}.{path}"
    return Use(j + 1, station.name, quantity, words, against, where, peak, (at + 1) * dt, bound, unit, shown, beyond)


def _rate(x: Array, dt: float) -> Array:
    """The velocity over each controller step; a test starts at zero."""
    rate: Array = np.diff(x, prepend=0.0) / dt
    return rate
