"""The free parameters of a model as one vector z."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import annotated_types
import numpy as np

from rths_engine.diagnosis.components.component import Component, Loose
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect

# chosen; see docs/decisions/0023
SMALLEST = 1e-12
LARGEST_LOGARITHM = math.log(sys.float_info.max)  # an interval may end beyond it


@dataclass(frozen=True, slots=True)
class Number:
    """A free parameter: one field of the part at the index `owner` of the model. z = ln value, or value / scale."""

    owner: int
    field: str
    low: float
    high: float
    scale: float
    logarithmic: bool
    planned: float  # z of the planned value
    spread: float  # prior standard deviation of z; inf where the parameter is free

    def to_z(self, value: float) -> float:
        return math.log(value) if self.logarithmic else value / self.scale

    def from_z(self, z: float) -> float:
        value = math.exp(min(z, LARGEST_LOGARITHM)) if self.logarithmic else z * self.scale
        return min(max(value, self.low), self.high)

    @property
    def bounds(self) -> tuple[float, float]:
        return self.to_z(self.low), self.to_z(self.high)


def numbers(component: Component, parts: Sequence[Part]) -> list[Number]:
    """The free parameters of the parts, in order. A planned parameter that is zero stays zero."""
    base = len(component.base)
    found = []
    for owner, part in enumerate(parts):
        planned = component.base[owner] if owner < base else None
        for number in _of(owner, part, planned, component):
            if planned is None or isinstance(planned, Effect | Loose) or getattr(planned, number.field) != 0.0:
                found.append(number)
    return found


def vector(parts: Sequence[Part], free: Sequence[Number]) -> Array:
    """The vector z of the free parameters of `parts`."""
    return np.array([number.to_z(getattr(parts[number.owner], number.field)) for number in free])


def moved(parts: Sequence[Part], free: Sequence[Number], z: Array) -> list[Part]:
    """The parts with the values of `z`."""
    changes: list[dict[str, float]] = [{} for _ in parts]
    for number, one in zip(free, z, strict=True):
        changes[number.owner][number.field] = number.from_z(float(one))
    return [part.model_copy(update=change) if change else part for part, change in zip(parts, changes, strict=True)]


def _of(owner: int, part: Part, planned: Part | None, component: Component) -> Iterator[Number]:
    held = physics.SEARCHES[type(part)].held if isinstance(part, Effect) else ()
    for name, field in type(part).model_fields.items():
        if field.annotation is not float or name in held:
            continue
        low, high, strict = -math.inf, math.inf, False
        for bound in field.metadata:
            if isinstance(bound, annotated_types.Gt):
                low, strict = float(bound.gt), True  # type: ignore[arg-type]
            elif isinstance(bound, annotated_types.Ge):
                low = float(bound.ge)  # type: ignore[arg-type]
            elif isinstance(bound, annotated_types.Le | annotated_types.Lt):
                high = float(bound.le if isinstance(bound, annotated_types.Le) else bound.lt)  # type: ignore[arg-type]
        value = abs(float(getattr(planned or part, name)))
        scale = getattr(part, "scale", None) or value or 1.0
        logarithmic = strict and low >= 0
        if logarithmic:
            low = max(low, SMALLEST)
        number = Number(owner, name, low, high, scale, logarithmic, 0.0, math.inf)
        spread = None if planned is None else component.spread(planned, name)
        if planned is not None and spread is not None:
            number = replace(number, planned=number.to_z(float(getattr(planned, name))), spread=spread)
        yield number
