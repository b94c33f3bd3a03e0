"""The field that an error names is the field that is wrong, in every part of a plan and at every depth."""

from __future__ import annotations

import copy
import math
from collections.abc import Iterator
from typing import Any

import pytest

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.part import validated
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured import Mapping

SCHEMA = Plan.model_json_schema()
WRONG: tuple[Any, ...] = ("three parsecs", math.nan, [])
Path = tuple[int | str, ...]


def instances(schema: dict[str, Any]) -> Iterator[tuple[Any, Path]]:
    """Values of the schema that hold every number of every kind, each with the path to what it has and no earlier one has."""
    schema = {**schema, **SCHEMA["$defs"].get(schema.get("$ref", "").rpartition("/")[2], {})}
    one_of = schema.get("oneOf") or [one for one in schema.get("anyOf", []) if one.get("type") != "null"]
    if one_of:
        for one in one_of:
            yield from instances(one)
    elif "const" in schema or "enum" in schema:
        yield schema.get("const", schema.get("enum", [None])[0]), ()
    elif "properties" in schema:
        inside = {name: list(instances(one)) for name, one in schema["properties"].items()}
        first = {name: found[0][0] for name, found in inside.items()}
        for name, found in inside.items():
            yield from (({**first, name: value}, (name, *path)) for value, path in found)
    elif schema.get("type") == "array":
        items = schema.get("prefixItems") or [schema["items"]] * max(1, schema.get("minItems", 1))
        yield from (([copy.deepcopy(value) for _ in items], (0, *path)) for value, path in instances(items[0]))
    else:
        yield plain(schema), ()


def plain(schema: dict[str, Any]) -> Any:
    """A number within its bounds, or a text."""
    if schema["type"] in ("number", "integer"):
        lowest = schema.get("minimum", schema.get("exclusiveMinimum", 0))
        highest = schema.get("maximum", schema.get("exclusiveMaximum", lowest + 2))
        middle = schema.get("default", (lowest + highest) / 2)
        return int(middle) if schema["type"] == "integer" else middle
    return {"boolean": False, "string": "a" * 64, "object": {}}[schema["type"]]


def at(data: Any, path: Path) -> Any:
    for step in path:
        data = data[step]
    return data


def changed(data: Any, path: Path, value: Any) -> Any:
    data = copy.deepcopy(data)
    at(data, path[:-1])[path[-1]] = value
    return data


def numbers() -> dict[str, tuple[Any, Path]]:
    """Every number of a plan by its path and the kinds that it lies in."""
    found = {}
    for data, path in instances(SCHEMA):
        if isinstance(at(data, path), int | float) and not isinstance(at(data, path), bool):
            around = [at(data, path[:depth]) for depth in range(len(path))]
            kinds = [one.get("kind", "") + one.get("channel", "") for one in around if isinstance(one, dict)]
            found[".".join(map(str, path)) + " of " + "/".join(kinds)] = data, path
    return found


NUMBERS = numbers()


def refused(data: Any) -> set[str]:
    with pytest.raises(PlanError) as raised:
        validated(Plan, data)
    return {issue.where for issue in raised.value.issues}


def test_the_walk_meets_every_kind_of_every_union_with_a_number() -> None:
    assert len(NUMBERS) > 200
    for kind in ("pga", "sa_t1", "band_noise", "ats", "mr_damper", "offset", "gap_contact", "low_pass", "real_time"):
        assert any(kind in name for name in NUMBERS), kind


@pytest.mark.parametrize("name", NUMBERS)
def test_a_wrong_number_alone_is_named_by_its_path_in_the_plan(name: str) -> None:
    data, path = NUMBERS[name]
    for wrong in WRONG:
        assert refused(changed(data, path, wrong)) == {".".join(map(str, path))}, wrong


def test_a_tag_that_equals_a_field_is_no_step_of_the_path() -> None:
    motion = {"kind": "record", "record": "kobe", "scale": {"kind": "pga", "pga": -1.0}}
    assert refused({"motion": motion}) == {"motion.scale.pga"}
    assert refused({"motion": {**motion, "scale": {"kind": "factor", "factor": -1.0}}}) == {"motion.scale.factor"}


def test_an_unknown_kind_is_named_where_it_stands_and_a_kind_without_field_by_the_field_it_lacks() -> None:
    effects = [{"kind": "offset", "channel": "nowhere"}, {"kind": "nothing"}, {"kind": "offset", "channel": "x_meas", "x": 1}]
    station = "stations.0.sensor_physics"
    assert {f"{station}.0", f"{station}.1", f"{station}.2.x"} <= refused({"stations": [{"sensor_physics": effects}]})
    assert refused({"motion": {"kind": "record", "scale": {"kind": "pga"}}}) == {"motion.record"}


def test_a_union_of_plain_types_is_no_step_of_the_path() -> None:
    channel = {"column": [1], "role": "x_meas", "unit": "mm"}
    with pytest.raises(PlanError) as raised:
        validated(Mapping, {"channels": [channel]})
    assert {issue.where for issue in raised.value.issues} == {"channels.0.column"}
