"""Axes of a sweep: the values of one varied field in SI, checked against unit and bounds of each field that they are put in."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.sweeps.definition import Range, Values
from rths_engine.sweeps.distributions import Law, law
from rths_engine.sweeps.places import Place, in_words

# chosen; see docs/decisions/0023
MOST_SHOWN = 60  # characters of a category's label
MOST_SAID = 5  # values of one field whose errors are listed


_NUMBER = re.compile(r"(?<= )\d+(?=:)")  # of an item of a list, in a label


@dataclass(frozen=True)
class Axis:
    """One varied field.

    `levels` are its values in SI, or places in `categories` where the field is not a number; empty for a distribution, `law`.
    With `factor` the values are factors on the plan's value of each field.
    """

    path: str
    label: str
    shown: str
    places: tuple[Place, ...]
    factor: bool
    levels: Array
    categories: tuple[Any, ...] = ()
    law: Law | None = None

    @property
    def planned(self) -> float:
        """The value of the plan itself (of the first field), or the factor 1; NaN where it is none of the categories."""
        if self.factor:
            return 1.0
        value = self.places[0].value
        if self.categories:
            return float(self.categories.index(value)) if value in self.categories else math.nan
        return math.nan if value is None else float(value)

    @property
    def names(self) -> list[str]:
        """The label of each category."""
        return [_named(one) for one in self.categories]

    def values(self, level: float) -> list[tuple[tuple[str | int, ...], Any]]:
        """The keys and the value of each field at one level."""
        if self.categories:
            return [(place.keys, self.categories[int(level)]) for place in self.places]
        numbers = [level * place.value if self.factor else level for place in self.places]
        return [
            (place.keys, round(number) if place.whole else float(number))
            for place, number in zip(self.places, numbers, strict=True)
        ]

    def sampled(self, share: Array) -> Array:
        """The values at cumulative probabilities `share` (n)."""
        assert self.law is not None
        values = self.law.at(share)
        return np.round(values) if self.places[0].whole and not self.factor else values


def axis(given: Values, places: Sequence[Place], path: str, factor: bool, where: str) -> Axis:
    """The axis of a varied field. Raises PlanError with every issue."""
    ways = [name for name in ("values", "range", "distribution") if getattr(given, name) is not None]
    if len(ways) != 1:
        fix = "give a list as 'values', a 'range' or a 'distribution'"
        raise PlanError(Issue(where, f"needs exactly one of values, range and distribution, not {len(ways)}", fix=fix))
    first = places[0]
    if first.unit is None:
        return _categories(given, places, path, factor, where)
    unit = "1" if factor else first.unit
    plain = _unit(given, unit, where)
    if factor:
        _check_factors(places, where)
    low, high = _bounds(places, factor)
    made: dict[str, Any] = {}
    if given.values is not None:
        read = [_number(one, unit, plain, f"{where}.values.{index}") for index, one in enumerate(given.values)]
        made["levels"] = np.array(read)
    elif given.range is not None:
        made["levels"] = _ranged(given.range, unit, plain, f"{where}.range")
    else:
        assert given.distribution is not None
        number = lambda value, name: _number(value, unit, plain, f"{where}.distribution.{name}")  # noqa: E731
        shown = "1" if factor else first.shown
        made["law"] = law(given.distribution, number, (low, high), shown, f"{where}.distribution")
        made["levels"] = np.zeros(0)
    found = Axis(path, _label(places, factor), "1" if factor else first.shown, tuple(places), factor, **made)
    _check_levels(found, given, where)
    return found


def _label(places: Sequence[Place], factor: bool) -> str:
    """The label of the fields: `Station 1, 2: Dampers in the storey` where labels differ in numbers only."""
    label = places[0].label
    if len({_NUMBER.sub("#", place.label) for place in places}) > 1:
        label = " = ".join(dict.fromkeys(place.label for place in places))
    elif len(places) > 1:
        columns = zip(*(_NUMBER.findall(place.label) for place in places), strict=True)
        numbers = [", ".join(dict.fromkeys(column)) for column in columns]
        label = _NUMBER.sub(lambda _: numbers.pop(0), label)
    return f"Factor of {label}" if factor else label


def _unit(given: Values, unit: str, where: str) -> str:
    """The unit of numbers without a unit."""
    if given.unit is None:
        return unit
    named = units.named(given.unit)
    dimension = units.dimension(unit)
    if named is None or units.dimension(named) != dimension:
        allowed = ", ".join(units.pretty(one) or "1" for one in units.of_dimension(dimension))
        raise PlanError(Issue(f"{where}.unit", f"is not a unit of {dimension}", given.unit, f"give one of {allowed}"))
    return named


def _number(value: Any, unit: str, plain: str, where: str) -> float:
    """A number in SI. Raises PlanError for anything else."""
    if isinstance(value, str):
        try:
            return units.parse(value, unit)
        except RthsError as error:
            raise PlanError(Issue(where, error.issues[0].problem, value)) from None
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise PlanError(Issue(where, "needs a finite number, or text with a unit", value))
    return units.to_si(float(value), plain)


def _ranged(given: Range, unit: str, plain: str, where: str) -> Array:
    start, end = _number(given.from_, unit, plain, f"{where}.from"), _number(given.to, unit, plain, f"{where}.to")
    if given.spacing == "linear":
        return np.linspace(start, end, given.count)
    for name, value, written in (("from", start, given.from_), ("to", end, given.to)):
        if value <= 0:
            problem = "needs a value > 0 where the spacing is log"
            raise PlanError(Issue(f"{where}.{name}", problem, written, "use linear spacing"))
    return np.geomspace(start, end, given.count)


def _check_factors(places: Sequence[Place], where: str) -> None:
    for place in places:
        if not place.value:
            problem = (
                f"multiplies the plan's value, but {place.path} is {'empty' if place.value is None else 'zero'} in the plan"
            )
            raise PlanError(Issue(f"{where}.change", problem, "multiply", "use change: set"))


def _bounds(places: Sequence[Place], factor: bool) -> tuple[float, float]:
    """The numbers that every field takes."""
    pairs = [place.bounds for place in places]
    if factor:
        pairs = [_ordered(low / place.value, high / place.value) for (low, high), place in zip(pairs, places, strict=True)]
    return max(low for low, _ in pairs), min(high for _, high in pairs)


def _ordered(one: float, other: float) -> tuple[float, float]:
    return (one, other) if one <= other else (other, one)


def _check_levels(found: Axis, given: Values, where: str) -> None:
    """Raise PlanError for each level that a field does not take."""
    issues: list[Issue] = []
    for index, level in enumerate(found.levels):
        at = f"{where}.values.{index}" if given.values is not None else f"{where}.range"
        for place in found.places:
            value = float(level * place.value if found.factor else level)
            problem = place.outside(value)
            if problem is None and place.whole and not found.factor and value != round(value):
                problem = "needs a whole number"
            if problem:
                name = f"{place.path} = " if len(found.places) > 1 or found.factor else ""
                issues.append(Issue(at, f"{place.label} {problem}", f"{name}{in_words(value, place.shown)}"))
                break
    if len(issues) > MOST_SAID:
        more = f"{len(issues) - MOST_SAID} more values are out of bounds"
        issues = [*issues[:MOST_SAID], Issue(where, more)]
    if issues:
        raise PlanError(issues)


def _categories(given: Values, places: Sequence[Place], path: str, factor: bool, where: str) -> Axis:
    if given.values is None or factor or given.unit is not None:
        fix = "list the choices as 'values', without a unit and without change: multiply"
        raise PlanError(Issue(where, f"{path} is not a number, so its values are a list", fix=fix))
    several: list[Any] = []
    for one in given.values:
        if one not in several:
            several.append(one)
    levels = np.array([float(several.index(one)) for one in given.values])
    return Axis(path, _label(places, False), "1", tuple(places), False, levels, tuple(several))


def _named(value: Any) -> str:
    """The label of a category: text as it is, and of a part its kind and its fields."""
    if isinstance(value, dict):
        own = ", ".join(
            f"{key} {one:g}" if isinstance(one, float) else f"{key} {one}" for key, one in value.items() if key != "kind"
        )
        value = f"{value.get('kind', '')} ({own})" if own and "kind" in value else own or value.get("kind", "")
    text = str(value)
    return text if len(text) <= MOST_SHOWN else text[: MOST_SHOWN - 1] + "…"
