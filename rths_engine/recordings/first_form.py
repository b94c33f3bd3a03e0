"""Recordings of runs in their first form, `rths-recording/1`, whose channels had keys of their own.

`s1.x_cmd` is `x_cmd.1` today, `floor2.x` is `x_floor.2`, and `force1`, the first force of the plan, is `force_ext.N` on its
floor N. Forces on one floor had a column each; today one column records their sum.
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
    """Channels and signals (substeps, channels) in today's form. Raises ValueError for other channels than the plan's."""
    found: dict[str, Array] = {}
    for column, item in enumerate(items):
        key, values = _key(item["key"], plan), signals[:, column]
        found[key] = found[key] + values if key in found else values
    today = channels(plan)
    if list(found) != [channel.key for channel in today]:
        raise ValueError(f"its channels are not those of its plan: {', '.join(found)}")
    return today, np.column_stack(list(found.values()))


def _key(key: str, plan: Plan) -> str:
    if station := _STATION.fullmatch(key):
        return f"{station[2]}.{station[1]}"
    if floor := _FLOOR.fullmatch(key):
        return f"x_floor.{floor[1]}"
    if force := _FORCE.fullmatch(key):
        return f"force_ext.{plan.forces[int(force[1]) - 1].floor}"
    return key
