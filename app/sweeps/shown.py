"""What people see of a sweep: its axes, columns and inputs in the units shown."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from app.sweeps.schemas import AxisOut, ColumnOut
from rths_engine.foundation import units
from rths_engine.sweeps.axes import Axis
from rths_engine.sweeps.columns import Column, inputs
from rths_engine.sweeps.design import Design
from rths_engine.sweeps.table import Table


def axes(design: Design) -> list[AxisOut]:
    """Every varied field, with the scales first."""
    found = [] if design.scales is None else [_axis(design.scales, design.scales.levels)]
    return [*found, *(_axis(one, design.values_of(place)) for place, one in enumerate(design.axes))]


def column(one: Column) -> ColumnOut:
    """JSON form of a column."""
    return ColumnOut.model_validate(one.as_dict() | {"categories": list(one.categories)})


def inputs_of(design: Design, point: int) -> dict[str, Any]:
    """The inputs of a point (from 0) by column, in the units shown."""
    own = tuple(inputs(design))
    table = Table(own, np.array([point]), np.array([design.inputs(point)]), {})
    return {one.key: table.listed(place)[0] for place, one in enumerate(own)}


def _axis(one: Axis, values: Any) -> AxisOut:
    names = one.names
    numbers = [] if names else [units.from_si(float(value), one.shown) for value in values]
    listed: list[Any] | None = None
    if one.law is None:
        listed = [names[int(level)] for level in one.levels] if names else numbers
    return AxisOut(
        path=one.path,
        label=one.label,
        shown=one.shown,
        shown_label=units.pretty(one.shown),
        change="multiply" if one.factor else "set",
        fields=[place.path for place in one.places],
        planned=_planned(one),
        values=listed,
        lowest=min(numbers, default=None),
        highest=max(numbers, default=None),
    )


def _planned(one: Axis) -> float | str | None:
    value = one.planned
    if math.isnan(value):
        return None
    return one.names[int(value)] if one.categories else units.from_si(value, one.shown)
