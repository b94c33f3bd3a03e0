"""Recordings of runs in the first format, `rths-recording/1`, which used other keys for its channels.

`s1.x_cmd` is now `x_cmd.1`, `floor2.x` is `x_floor.2`, and `force1`, the first force of the plan, is `force_ext.N` for its
floor N. Each force had its own column; now one column records the sum of the forces on a floor.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.planning.plan import Plan
from rths_engine.results.channels import Channel, channels

SCHEMA = "rths-recording/1"
_STATION = re.compile(r"s(\d+)\.(.+)")
_FLOOR = re.compile(r"floor(\d+)\.x")
_FORCE = re.compile(r"force(\d+)")


def translated(items: list[dict[str, Any]], signals: Array, plan: Plan) -> tuple[tuple[Channel, ...], Array]:
    """Channels and signals (substeps, channels) in today's format. Raises ValueError if the channels do not match the plan."""
    found: dict[str, Array] = {}
    for column, item in enumerate(items):
        key, values = _key(item["key"], plan), signals[:, column]
        found[key] = found[key] + values if key in found else values
    today = channels(plan)
    if list(found) != [channel.key for channel in today]:
        raise ValueError(f"its channels do not match its plan: {', '.join(found)}")
    return today, np.column_stack(list(found.values()))


def _key(key: str, plan: Plan) -> str:
    if station := _STATION.fullmatch(key):
        return f"{station[2]}.{station[1]}"
    if floor := _FLOOR.fullmatch(key):
        return f"x_floor.{floor[1]}"
    if force := _FORCE.fullmatch(key):
        return f"force_ext.{plan.forces[int(force[1]) - 1].floor}"
    return key
