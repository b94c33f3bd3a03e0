"""The points of a sweep: their number without making them, and the inputs and the plan of each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from pydantic import ValidationError

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.foundation.part import Value, validated
from rths_engine.parts.ground_motions import scaling
from rths_engine.planning import templates
from rths_engine.planning.connections import external
from rths_engine.planning.plan import Plan
from rths_engine.sweeps.axes import Axis, axis
from rths_engine.sweeps.definition import MOST_POINTS, Definition, Scales, Varied
from rths_engine.sweeps.places import Keys, Place, resolve, with_values
from rths_engine.sweeps.sampling import shares

RECORD, SCALE = "motion.record", "motion.scale"
SCALES: dict[str, type[Value]] = {"factor": scaling.Factor, "pga": scaling.ToPga, "sa_t1": scaling.ToSpectralAcceleration}
NUMBER_OF = {"factor": "factor", "pga": "pga", "sa_t1": "sa"}


@dataclass(frozen=True)
class Design:
    """A definition read against its plan. Points count from 0 here; people count them from 1.

    The order of the points: records are the slowest, then scales, then the fields, of which the last varies fastest.
    """

    definition: Definition
    plan: Plan
    records: tuple[str, ...]
    scales: Axis | None
    axes: tuple[Axis, ...]

    @cached_property
    def rows(self) -> int:
        """Number of points of one record at one scale."""
        lengths = [len(one.levels) for one in self.axes]
        if self.definition.sampled:
            return self.definition.samples or 0
        if self.definition.method == "list":
            return lengths[0] if lengths else 1
        if self.definition.method == "one_at_a_time":
            return 1 + sum(lengths)
        return math.prod(lengths)

    @cached_property
    def count(self) -> int:
        """Number of points."""
        return max(1, len(self.records)) * (len(self.scales.levels) if self.scales else 1) * self.rows

    @cached_property
    def base(self) -> dict[str, Any]:
        """The plan in JSON form, with the kind of scale that the sweep varies."""
        data = self.plan.as_dict()
        if self.records and data["motion"]["kind"] != "record":
            data = with_values(data, [(("motion",), {"kind": "record", "record": self.records[0]})])
        if self.records:
            data["motion"] = {key: value for key, value in data["motion"].items() if key != "sha256"}
        if self.scales is not None:
            scale = self.definition.scales
            assert scale is not None
            data = with_values(data, [(("motion", "scale"), {"kind": scale.kind})])
        return data

    def inputs(self, point: int) -> list[float]:
        """The place of the record, the scale in SI, and the level of each field; only those that the sweep varies."""
        if not 0 <= point < self.count:
            raise IndexError(point)
        around, row = divmod(point, self.rows)
        record, scale = divmod(around, len(self.scales.levels) if self.scales else 1)
        first = [float(record)] if self.records else []
        second = [float(self.scales.levels[scale])] if self.scales else []
        return [*first, *second, *self._levels(row)]

    def data(self, point: int) -> dict[str, Any]:
        """The plan of a point in JSON form. It may break a rule between fields: `reading.read_model` checks it."""
        return self.with_inputs(self.inputs(point))

    def with_inputs(self, inputs: list[float]) -> dict[str, Any]:
        """The plan with these inputs, in JSON form."""
        left = list(inputs)
        changes: list[tuple[Keys, Any]] = []
        if self.records:
            changes.append((("motion", "record"), self.records[int(left.pop(0))]))
        if self.scales is not None:
            changes += self.scales.values(left.pop(0))
        for one, level in zip(self.axes, left, strict=True):
            if not math.isnan(level) and not (self.definition.method == "one_at_a_time" and level == one.planned):
                changes += one.values(level)
        return with_values(self.base, changes)

    def named(self, point: int) -> dict[str, Any]:
        """The plan of a point, under the name of the sweep and the number of the point."""
        data, ending = self.data(point), f", point {point + 1}"
        return {**data, "name": f"{self.definition.name[: 200 - len(ending)]}{ending}"}

    def values_of(self, axis: int) -> Array:
        """Every value of one field among the points: its levels, or its samples."""
        return self._samples[:, axis] if self.definition.sampled else self.axes[axis].levels

    @property
    def notes(self) -> list[str]:
        """What the definition does not state itself: truncated distributions and rounded samples."""
        found = [f"{one.label}: {one.law.note}." for one in self.axes if one.law and one.law.note]
        rounded = [one for one in self.axes if one.law and one.places[0].whole]
        return [*found, *(f"{one.label}: samples are rounded to whole numbers." for one in rounded)]

    def _levels(self, row: int) -> list[float]:
        method = self.definition.method
        if self.definition.sampled:
            return [float(value) for value in self._samples[row]]
        if method == "list":
            return [float(one.levels[row]) for one in self.axes]
        if method == "one_at_a_time":
            return self._alone(row)
        found = []
        for one in reversed(self.axes):
            row, place = divmod(row, len(one.levels))
            found.append(float(one.levels[place]))
        return found[::-1]

    def _alone(self, row: int) -> list[float]:
        found, row = [one.planned for one in self.axes], row - 1
        for place, one in enumerate(self.axes):
            if 0 <= row < len(one.levels):
                found[place] = float(one.levels[row])
            row -= len(one.levels)
        return found

    @cached_property
    def _samples(self) -> Array:
        """(samples, fields) in SI."""
        definition = self.definition
        share = shares(definition.method, self.rows, len(self.axes), definition.seed)
        columns = [one.sampled(share[:, place]) for place, one in enumerate(self.axes)]
        return np.column_stack(columns) if columns else np.zeros((self.rows, 0))


def read_design(data: Any) -> Design:
    """The design of a definition in JSON form. Raises PlanError with every issue."""
    if not isinstance(data, Mapping):
        raise PlanError(Issue("", "a sweep is a mapping with 'plan' and 'fields'", fix="see docs/sweeps.md"))
    definition = validated(Definition, data)
    plan = _plan(definition)
    issues: list[Issue] = []
    axes = list(_collected(((f"fields.{place}", one) for place, one in enumerate(definition.fields)), plan, issues))
    scales = _scales(definition, plan, issues)
    issues += _fit(definition, plan, axes)
    if issues:
        raise PlanError(issues)
    design = Design(definition, plan, definition.records, scales, tuple(axes))
    _check_count(design)
    _check_categories(design)
    return design


def _plan(definition: Definition) -> Plan:
    """The plan of a definition: its fields are checked, the rules between them at each point."""
    try:
        if isinstance(definition.plan, str):
            return templates.template(definition.plan)
        return validated(Plan, definition.plan)
    except RthsError as error:
        found = (Issue(".".join(filter(None, ("plan", one.where))), one.problem, one.value, one.fix) for one in error.issues)
        raise PlanError(found) from None


def _collected(given: Iterator[tuple[str, Varied]], plan: Plan, issues: list[Issue]) -> Iterator[Axis]:
    """The axis of each varied field. Issues are collected instead of raised."""
    met: dict[str, str] = {}
    for where, one in given:
        try:
            places = [place for path in one.paths for place in resolve(plan, path, f"{where}.path")]
            for place in places:
                if met.setdefault(place.path, where) != where:
                    problem = f"{place.path} is varied by {met[place.path]} too"
                    raise PlanError(Issue(f"{where}.path", problem, one.paths[0], "name a field once"))
            _check_alike(places, where)
            yield axis(one, places, " = ".join(one.paths), one.change == "multiply", where)
        except PlanError as error:
            issues += error.issues


def _check_alike(places: list[Place], where: str) -> None:
    """Raise PlanError unless fields that get one value have one unit."""
    first = places[0]
    for place in places:
        if place.unit != first.unit or place.whole != first.whole:
            problem = (
                f"gives one value to fields of different units: {first.path} in {first.unit}, {place.path} in {place.unit}"
            )
            raise PlanError(Issue(f"{where}.path", problem, fix="vary them as two fields"))


def _scales(definition: Definition, plan: Plan, issues: list[Issue]) -> Axis | None:
    if definition.scales is None:
        return None
    given: Scales = definition.scales
    kind = SCALES[given.kind]
    name = NUMBER_OF[given.kind]
    place = Place(
        ("motion", "scale", name), f"Ground motion: Scaling: {kind.model_fields[name].title}", kind.model_fields[name], None
    )
    try:
        if given.distribution is not None:
            fix = f"vary the field motion.scale.{name} by this distribution"
            raise PlanError(Issue("scales.distribution", "scales are a list or a range", given.distribution.kind, fix))
        return axis(given, [place], SCALE, False, "scales")
    except PlanError as error:
        issues += error.issues
        return None


def _fit(definition: Definition, plan: Plan, axes: list[Axis]) -> Iterator[Issue]:
    """Issues between the parts of a definition."""
    if definition.sampled:
        if definition.samples is None:
            yield Issue("samples", f"is required by the method {definition.method}", fix="give the number of samples")
        for place, one in enumerate(definition.fields):
            if one.distribution is None:
                fix = "give it a distribution, for example uniform, or choose the method grid"
                yield Issue(f"fields.{place}", f"needs a distribution: the method is {definition.method}", fix=fix)
        if not definition.fields:
            yield Issue("fields", f"needs at least one field for the method {definition.method}", fix="add a field")
    else:
        if definition.samples is not None:
            yield Issue("samples", f"is not used by the method {definition.method}", definition.samples, "remove it")
        for place, one in enumerate(definition.fields):
            if one.distribution is not None:
                fix = "choose the method latin_hypercube or monte_carlo, or give values or a range"
                yield Issue(f"fields.{place}.distribution", f"is not used by the method {definition.method}", fix=fix)
    lengths = {one.path: len(one.levels) for one in axes}
    if definition.method == "list" and len(set(lengths.values())) > 1:
        said = ", ".join(f"{path} {length}" for path, length in lengths.items())
        yield Issue(
            "fields", f"the method list needs as many values for each field: {said}", fix="give each field as many values"
        )
    if not (definition.fields or definition.records or definition.scales):
        yield Issue("fields", "nothing varies", fix="add a field, records or scales")
    yield from _shaken(definition, plan)
    for index, connection in external(plan).items():
        problem = f"is an external rig, {connection.peer}: a sweep runs many tests at a time, and would move it unattended"
        yield Issue(f"plan.stations.{index}.connection", problem, fix="emulate the station by its models")


def _shaken(definition: Definition, plan: Plan) -> Iterator[Issue]:
    """Issues of the excitation: of a client, and of the ground motion."""
    if plan.test == "client":
        fix = "choose another kind of test"
        yield Issue("plan.test", "follows a client, so that its points cannot run alone", plan.test, fix)
    paths = [path for one in definition.fields for path in one.paths]
    for name, path in (("records", RECORD), ("scales", SCALE)):
        if not getattr(definition, name):
            continue
        if plan.driven:
            yield Issue(name, f"are not used: a test of the kind '{plan.test}' follows its drive", fix="remove them")
        if any(one == "motion" or one == path or one.startswith(f"{path}.") for one in paths):
            yield Issue(name, f"varies {path}, which a field varies too", fix="keep one of the two")
    if definition.scales and not definition.records and plan.motion.kind == "none":
        yield Issue("scales", "need a ground motion, but the plan has none", fix="give records, or a plan with a ground motion")
    for place, one in enumerate(definition.records):
        if one in definition.records[:place]:
            yield Issue(f"records.{place}", "is listed twice", one, "list a record once")


def _check_count(design: Design) -> None:
    if design.count > MOST_POINTS:
        problem = f"makes {design.count:,} points; a sweep has at most {MOST_POINTS:,}"
        raise PlanError(Issue("", problem, fix="give fewer values, or divide it into several sweeps"))


def _check_categories(design: Design) -> None:
    """Raise PlanError for choices that the plan does not take, such as a part with a wrong field."""
    issues: list[Issue] = []
    for number, one in enumerate(design.axes):
        for level in range(len(one.categories)):
            try:
                Plan.model_validate(with_values(design.base, one.values(level)))
            except ValidationError:
                issues += _of_category(design, one, level, number)
    if issues:
        raise PlanError(issues)


def _of_category(design: Design, one: Axis, level: int, number: int) -> Iterator[Issue]:
    try:
        validated(Plan, with_values(design.base, one.values(level)))
    except PlanError as error:
        given = design.definition.fields[number].values or ()
        where = f"fields.{number}.values.{given.index(one.categories[level])}"
        yield from (Issue(where, f"{issue.where}: {issue.problem}", issue.value, issue.fix) for issue in error.issues)
