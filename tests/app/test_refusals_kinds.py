"""Bad input in plans of every kind of test: refused with the path of the field, quickly, never a server error."""

from __future__ import annotations

import copy
import json
from typing import Any

import pytest
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from rths_engine.planning import templates
from rths_engine.planning.examples import EXAMPLES
from tests.app.test_refusals import CHECK, JSON, RUNS, leaves, stored

DRIVE, STABILITY = "/api/v1/plans/drive", "/api/v1/stability"
EXAMPLES_TRIED = hypothesis_settings(
    max_examples=50, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
)
PLANS = {name: templates.template(name).as_dict() for name in EXAMPLES}
SAMPLES = {"kind": "samples", "dt": 0.1, "values": [0.0, 1.0]}
SHAPES = [{"kind": "band_noise"}, {"kind": "step"}, {"kind": "triangle"}, SAMPLES]
LEAVES = [(name, path) for name, plan in PLANS.items() for path in leaves(plan)]
RUBBISH: Any = st.recursive(
    st.none() | st.booleans() | st.floats() | st.text(), lambda some: st.lists(some) | st.dictionaries(st.text(), some)
)


def changed(name: str, path: tuple[Any, ...], value: Any) -> dict[str, Any]:
    plan = copy.deepcopy(PLANS[name])
    inner: Any = plan
    for step in path[:-1]:
        inner = inner[step]
    inner[path[-1]] = value
    return plan


def post(client: TestClient, path: str, data: Any) -> Any:
    return client.post(path, content=json.dumps(data), headers=JSON)


@EXAMPLES_TRIED
@given(leaf=st.sampled_from(LEAVES), value=st.floats() | st.integers() | RUBBISH, path=st.sampled_from([CHECK, STABILITY]))
def test_no_value_in_a_plan_of_any_kind_causes_a_server_error(
    client: TestClient, leaf: tuple[str, tuple[Any, ...]], value: Any, path: str
) -> None:
    answer = post(client, path, changed(*leaf, value))
    assert answer.status_code in {200, 422}, answer.text


@EXAMPLES_TRIED
@given(
    shape=st.sampled_from([templates.template(name).drive.shape.model_dump() for name in EXAMPLES] + SHAPES),
    field=st.sampled_from(["frequency", "cycles", "duration", "levels", "values", "dt", "rise", "amplitude", "rate", "kind"]),
    value=st.floats() | st.integers() | st.lists(st.floats()) | RUBBISH,
)
def test_no_drive_causes_a_server_error(client: TestClient, shape: dict[str, Any], field: str, value: Any) -> None:
    drive = {"amplitude": 0.02, "shape": {**shape, field: value}} if field != "amplitude" else {field: value, "shape": shape}
    rate = value if field == "rate" else 1024.0
    assert post(client, DRIVE, {"drive": drive, "controller_rate": rate}).status_code in {200, 422}
    plan = {**PLANS["specimen-mr-damper"], "drive": drive}
    assert post(client, CHECK, plan).status_code in {200, 422}


def structure(**more: Any) -> dict[str, Any]:
    plan = PLANS["structure-matrices"]
    return {**plan, "structure": {**plan["structure"], **more}}


SPECIMEN = PLANS["specimen-mr-damper"]
NAN = float("nan")


@pytest.mark.parametrize(
    ("plan", "where", "told"),
    [
        (structure(mass=[[1.0, NAN], [NAN, 1.0]]), "structure.mass.0.1", "finite number"),
        (structure(mass=[["heavy"]]), "structure.mass.0.0", "heavy"),
        (structure(mass=[[[1.0]]]), "structure.mass.0.0", "number"),
        (structure(mass=[[0.0] * 2001]), "structure.mass", "at most 2000 rows of 2000 numbers"),
        (structure(stiffness=[[0.0]] * 3000), "structure.stiffness", "at most 2000 rows of 2000 numbers"),
        (structure(damping=[[1.0]]), "structure.damping", "needs 3 rows of 3 numbers"),
        (structure(stiffness=[[1e7, 0, 0], [1, 1e7, 0], [0, 0, 1e7]]), "structure.stiffness", "not symmetric"),
        (structure(mass=[[1e5, 0, 0], [0, 1e-300, 0], [0, 0, 1e5]]), "structure", "almost no mass"),
        (structure(floors=[4]), "structure.floors", "from 1 to 3"),
        ({**PLANS["structure-matrices"], "forces": [{"floor": 4}]}, "forces.0.floor", "3 floors"),
        ({**PLANS["structure-matrices"], "forces": [{"floor": 1}] * 33}, "forces", "at most 32"),
        (
            {**PLANS["structure-free-vibration"], "start": {"displacement": [0.1]}},
            "start.displacement",
            "for 3 floors",
        ),
        ({**PLANS["structure-free-vibration"], "start": {"velocity": [NAN] * 3}}, "start.velocity.0", "finite number"),
        ({**SPECIMEN, "drive": {"amplitude": 0.09, "shape": SPECIMEN["drive"]["shape"]}}, "drive.amplitude", "limit of 80 mm"),
        ({**SPECIMEN, "drive": {"amplitude": "x" * 1_000_000, "shape": {"kind": "sine"}}}, "drive.amplitude", "xxx…"),
        ({**SPECIMEN, "drive": {"shape": {**SAMPLES, "values": [0.0, 1e300]}}}, "drive.shape.values.1", "<= 1e+06"),
        ({**SPECIMEN, "drive": {"shape": {"kind": "sine", "frequency": 1e-300}}}, "drive.shape", "the maximum is 3600 s"),
        ({**SPECIMEN, "drive": {"shape": {"kind": "wave"}}}, "drive.shape", "wave"),
        ({**SPECIMEN, "stations": SPECIMEN["stations"] * 2}, "stations", "exactly one"),
        ({**SPECIMEN, "stations": [{**SPECIMEN["stations"][0], "storey": 3}]}, "stations.0.storey", "not used"),
        ({**SPECIMEN, "test": "wall"}, "test", "hybrid"),
    ],
)
@pytest.mark.parametrize("path", [CHECK, RUNS])
def test_a_mistake_is_refused_with_the_path_of_its_field_and_nothing_is_stored(
    serving: TestClient, path: str, plan: dict[str, Any], where: str, told: str
) -> None:
    answer = post(serving, path, {"plan": plan} if path == RUNS else plan)
    assert answer.status_code == 422
    found = answer.json()["errors"]
    assert any(one["where"] == where and told in str(one) for one in found), found
    assert stored(serving) == 0
    assert len(answer.content) < 10_000
