"""Plans: reading, refusing, digest, YAML and templates."""

from __future__ import annotations

import json
from typing import Any

import pytest

from rths_engine.foundation.errors import MotionError, PlanError
from rths_engine.planning import templates
from rths_engine.planning.model import Model
from rths_engine.planning.reading import plan_from_yaml, plan_to_yaml, read_plan
from rths_engine.running.run import Run
from tests.engine.plans import LIBRARY


def table3() -> dict[str, Any]:
    return templates.template("two-storeys").as_dict()


def changed(path: str, value: Any) -> dict[str, Any]:
    data = table3()
    inner: Any = data
    *parents, last = path.split(".")
    for step in parents:
        inner = inner[int(step) if step.isdigit() else step]
    inner[last] = value
    return data


@pytest.mark.parametrize("name", templates.names())
def test_every_template_survives_yaml_and_json(name: str) -> None:
    plan = templates.template(name)
    assert plan_from_yaml(plan_to_yaml(plan)) == plan
    assert read_plan(json.loads(json.dumps(plan.as_dict()))) == plan
    if plan.test != "client":  # without its client it does not run
        assert Run(plan, LIBRARY).total > 0


def test_yaml_leaves_out_what_another_kind_of_test_would_read() -> None:
    text = plan_to_yaml(templates.template("opensees-client"))
    for key in ("structure", "integrator", "motion", "start", "drive", "couplings"):
        assert f"\n{key}:" not in text
    assert "\nclient:" in text and "\nclient:" not in plan_to_yaml(templates.template("two-storeys"))


def test_yaml_says_the_unit_of_each_number() -> None:
    text = plan_to_yaml(templates.template("two-storeys"))
    assert "stiffness: 36007000.0 # N/m = 36007 kN/m" in " ".join(text.split())


def test_the_two_storeys_stand_on_the_papers_first_period() -> None:
    assert Model(templates.template("two-storeys")).periods[0] == pytest.approx(1.48, rel=1e-9)


@pytest.mark.parametrize(
    ("path", "value", "where", "message"),
    [
        ("structure.storeys.1.mass", -5.0, "structure.storeys.1.mass", "needs a value > 0"),
        ("structure.storeys.0.mass", float("nan"), "structure.storeys.0.mass", "finite"),
        ("stations.0.actuator.alpha", 0.2, "stations.0.actuator.alpha", ">= 1"),
        ("stations.1.compensator.alpha_es", 0.2, "stations.1.compensator.alpha_es", ">= 1"),
        ("stations.1.specimen.kind", "jelly", "stations.1.specimen", "mr_damper"),
        ("stations.1.storey", 3, "stations.1.storey", "2 storeys"),
        ("stations.1.name", "Storey 1 damper", "stations.1.name", "name of another station"),
        ("integrator.dt", 0.01, "integrator.dt", "10 substeps"),
        ("seed", 1.5, "seed", "whole number"),
        ("pace", {"kind": "real_time", "core": True}, "pace.core", "whole number"),
        ("pace", {"kind": "real_time", "priority": "5"}, "pace.priority", "whole number"),
        ("stations.0.compensator", {"kind": "robust", "trust": 1e-9}, "stations.0.compensator.trust", ">= 0.001"),
        ("stations.0.compensator", {"kind": "kalman", "frequency": 1e-9}, "stations.0.compensator.frequency", ">= 0.1"),
        ("surprise", 1, "surprise", "not a field"),
        ("structure", None, "structure", ""),
        ("motion", 3, "motion", ""),
        ("stations", {}, "stations", ""),
    ],
)
def test_a_bad_plan_is_refused_with_the_path_and_the_bound(path: str, value: Any, where: str, message: str) -> None:
    with pytest.raises(PlanError) as caught:
        read_plan(changed(path, value))
    assert [issue.where for issue in caught.value.issues] == [where]
    assert message in str(caught.value)


def test_a_compensator_without_gains_at_the_controller_rate_is_refused_with_its_place() -> None:
    data = changed("stations.0.compensator", {"kind": "kalman", "response_frequency": 100.0})
    data |= {"controller_rate": 100.0, "integrator": data["integrator"] | {"dt": 0.1, "substeps": 10}}
    with pytest.raises(PlanError) as caught:
        read_plan(data)
    (issue,) = caught.value.issues
    assert (issue.where, issue.value) == ("stations.0.compensator", "kalman")
    assert "controller rate of 100 Hz" in issue.problem


def test_a_refused_item_is_not_told_again_as_a_list_too_short() -> None:
    data = table3()
    for storey in data["structure"]["storeys"]:
        storey["mass"] = -1
    with pytest.raises(PlanError) as caught:
        read_plan(data)
    assert [issue.where for issue in caught.value.issues] == ["structure.storeys.0.mass", "structure.storeys.1.mass"]


def test_every_issue_is_listed_at_once() -> None:
    data = changed("structure.storeys.1.mass", -5.0)
    data["stations"][0]["actuator"]["alpha"] = 0
    with pytest.raises(PlanError) as caught:
        read_plan(data)
    assert len(caught.value.issues) == 2


@pytest.mark.parametrize("nothing", [None, 3, "text", [], [1]])
def test_what_is_no_plan_at_all_is_refused(nothing: Any) -> None:
    with pytest.raises(PlanError, match="mapping"):
        read_plan(nothing)


def test_a_singular_structure_is_named() -> None:
    with pytest.raises(PlanError, match="singular"):
        read_plan(changed("structure.storeys.0.stiffness", 1e-9))


def test_an_unknown_record_is_named() -> None:
    with pytest.raises(MotionError, match="nowhere"):
        Run(read_plan(changed("motion.record", "nowhere")), LIBRARY)


def test_a_missing_record_file_is_named() -> None:
    with pytest.raises(MotionError, match=r"missing\.AT2"):
        Run(read_plan(changed("motion", {"kind": "file", "path": "missing.AT2"})), LIBRARY)


def test_a_nan_in_the_motion_is_refused() -> None:
    motion = {"kind": "inline", "dt": 0.01, "acceleration": [0.0, float("nan"), 0.1]}
    with pytest.raises(PlanError, match=r"motion.acceleration.1.*finite"):
        read_plan(changed("motion", motion))


def test_a_test_too_long_to_record_is_refused() -> None:
    data = changed("duration", 3600.0)
    data["controller_rate"], data["integrator"] = 100_000, {"kind": "cr", "dt": 1e-4, "substeps": 10}
    with pytest.raises(PlanError, match="shorten"):
        Run(read_plan(data), LIBRARY)


def test_the_digest_is_of_what_decides_the_result() -> None:
    plan = read_plan(table3())
    assert read_plan(changed("name", "Other")).digest == plan.digest
    assert read_plan(changed("pace", {"kind": "real_time", "factor": 2.0})).digest == plan.digest
    assert read_plan(changed("seed", 99)).digest != plan.digest


@pytest.mark.parametrize("text", ["a: [1", "\t- x", "a: &x 1\nb: *x", "!!python/object:os.system x", "\x00", "a: 1\n---\nb: 2"])
def test_bad_yaml_is_refused(text: str) -> None:
    with pytest.raises(PlanError):
        plan_from_yaml(text)


def test_an_unknown_template_names_those_there_are() -> None:
    with pytest.raises(PlanError, match="table3-01"):
        templates.template("table3-13")
