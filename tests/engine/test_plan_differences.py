"""The fields in which plans differ."""

from __future__ import annotations

import copy
from typing import Any

from rths_engine.planning.differences import NONE, FieldDifference, differences
from rths_engine.planning.templates import template

BASE: dict[str, Any] = template("table3-02").as_dict()


def changed(**paths: Any) -> dict[str, Any]:
    """The base plan with values at dotted paths, written with double underscores."""
    plan = copy.deepcopy(BASE)
    for path, value in paths.items():
        at: Any = plan
        *steps, last = path.split("__")
        for step in steps:
            at = at[int(step) if step.isdecimal() else step]
        at[last] = value
    return plan


def by_path(rows: list[FieldDifference]) -> dict[str, FieldDifference]:
    assert len({row.path for row in rows}) == len(rows)
    return {row.path: row for row in rows}


def test_equal_plans_do_not_differ_and_a_missing_field_has_its_default() -> None:
    bare = copy.deepcopy(BASE)
    del bare["pace"], bare["integrator"], bare["stations"][0]["controller"]
    assert differences([BASE, bare, copy.deepcopy(BASE)]) == []


def test_a_field_has_path_label_unit_and_a_value_for_each_plan() -> None:
    rows = differences([BASE, changed(stations__1__limits__velocity=0.45), BASE])
    assert [row.path for row in rows] == ["stations.1.limits.velocity"]
    assert rows[0].title == "Station 2: Safety limits: Command velocity limit"
    assert (rows[0].unit, rows[0].values, rows[0].texts) == ("mm/s", (0.3, 0.45, 0.3), ("300", "450", "300"))


def test_text_with_a_unit_is_compared_as_a_number() -> None:
    assert differences([BASE, changed(stations__0__limits__velocity="300 mm/s")]) == []
    (row,) = differences([BASE, changed(stations__0__limits__velocity="0.31 m/s")])
    assert row.texts == ("300", "310")


def test_another_kind_of_part_is_one_row_and_its_own_fields_follow() -> None:
    rows = by_path(differences([template("table3-02").as_dict(), template("table3-03").as_dict()], leave_out=("name",)))
    assert rows["stations.0.compensator"].texts == ("Adaptive inverse (AIC)", "Inverse")
    assert rows["stations.0.compensator.kp"].texts == ("0.4", NONE)
    assert rows["stations.0.compensator.alpha_es"].texts == ("1", "30")
    assert "name" not in rows and "template" in rows


def test_a_station_that_one_plan_lacks_is_one_row() -> None:
    one = changed(stations=BASE["stations"][:1])
    two = changed(stations__1__dampers=5)
    rows = by_path(differences([BASE, one, two]))
    assert list(rows) == ["stations.1", "stations.1.dampers"]
    assert rows["stations.1"].texts == ("present", NONE, "present")
    assert rows["stations.1.dampers"].texts == ("4", NONE, "5")


def test_texts_of_unequal_values_differ() -> None:
    mass = BASE["structure"]["storeys"][0]["mass"]
    (row,) = differences([BASE, changed(structure__storeys__0__mass=mass * (1 + 1e-14))])
    assert row.texts[0] != row.texts[1]
    motion: dict[str, Any] = {"kind": "inline", "dt": 0.01, "acceleration": [0.1 * k for k in range(100)]}
    other = {**motion, "acceleration": [0.2, *motion["acceleration"][1:]]}
    (row,) = differences([changed(motion=motion), changed(motion=other)])
    assert all(text.startswith("100 values from 0") for text in row.texts) and row.texts[0] != row.texts[1]


def test_drafts_that_are_not_valid_are_compared_too() -> None:
    draft = changed(motion={"kind": "flood", "depth": 3}, stations__0__limits__velocity="fast", seed=None)
    draft["typo"] = 4
    rows = by_path(differences([BASE, draft]))
    assert rows["motion"].texts == ("Record of the library", "flood (unknown)")
    assert rows["stations.0.limits.velocity"].texts == ("300", "fast")
    assert rows["typo"].label == "typo (not a field of the plan)"
    assert rows["motion.depth"].values == (None, 3)
    assert differences([{}, {}]) == []
    assert differences([{"stations": "none"}, {"stations": 3, "motion": [1, {"kind": 2}], "structure": None}])
