"""A run's recording as a measured one: `s1.x_cmd` becomes `x_cmd.1`, `floor2.x` becomes `x_floor.2`."""

from __future__ import annotations

import re
from typing import Any

from rths_engine.recordings.measured.recording import Measured, MeasuredChannel
from rths_engine.recordings.measured.roles import ROLES
from rths_engine.recordings.run_file import Recording

_STATION = re.compile(r"s(\d+)\.(.+)")
_FLOOR = re.compile(r"floor(\d+)\.([xva])")
_FORCE = re.compile(r"force(\d+)")


def of_run(recording: Recording, name: str) -> Measured:
    """The channels that a laboratory measures; those derived from them, such as the tracking error, are left out."""
    found = []
    for channel in recording.channels:
        role, number = _role(channel.key, recording)
        if role in ROLES:
            values = recording.signal(channel.key)
            found.append(MeasuredChannel(role, number, values, channel.unit, channel.label, channel.key))
    plan = recording.plan
    attrs: dict[str, Any] = {
        "title": plan.name,
        "test": plan.test,
        "source": name,
        "source_sha256": str(recording.attrs["digest"]),
    }
    return Measured(recording.dt, _summed(found), recording.dt, **attrs, of_run=True)


def _role(key: str, recording: Recording) -> tuple[str, int | None]:
    if station := _STATION.fullmatch(key):
        return station[2], int(station[1])
    if floor := _FLOOR.fullmatch(key):
        return f"{floor[2]}_floor", int(floor[1])
    if force := _FORCE.fullmatch(key):
        return "force_ext", recording.plan.forces[int(force[1]) - 1].floor
    return key, None


def _summed(channels: list[MeasuredChannel]) -> tuple[MeasuredChannel, ...]:
    """Forces on the same floor are one."""
    found: dict[str, MeasuredChannel] = {}
    for one in channels:
        if (same := found.get(one.key)) is not None:
            total = same.values + one.values
            one = MeasuredChannel(one.role, one.number, total, one.unit, same.label, f"{same.column} + {one.column}")
        found[one.key] = one
    return tuple(found.values())
