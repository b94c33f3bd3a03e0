"""Stability over REST, on its page, in the form's warnings and on the command line."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from app.cli.main import main
from rths_engine.planning import templates
from rths_engine.planning.reading import plan_to_yaml
from tests.app.conftest import plan
from tests.engine.plans import two_storeys


def test_a_stable_plan_has_a_radius_modes_margins_and_a_map(client: TestClient) -> None:
    found = client.post("/api/v1/stability", json=plan()).json()
    assert found["stable"] and 0.9 < found["radius"] < 1
    assert found["least_damped"] == found["modes"][0]
    first = found["stations"][0]
    assert first["delay_margin_s"] == pytest.approx(first["delay_margin_steps"] / 1024)
    assert [axis["present"] for axis in found["map"]["axes"]] == [30.0, 45.0]
    assert len(found["map"]["radius"]) == len(found["map"]["axes"][1]["values"])
    assert "initial tangent" in found["notes"][0]


def test_one_station_has_no_map(client: TestClient) -> None:
    found = client.post("/api/v1/stability", json=templates.template("linear-damper").as_dict()).json()
    assert found["map"] is None and len(found["stations"]) == 1


def test_a_plan_with_mistakes_is_refused_with_each_of_them(client: TestClient) -> None:
    answer = client.post("/api/v1/stability", json={**plan(), "controller_rate": -1})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["where"] == "controller_rate"


def test_the_check_warns_of_an_unstable_loop_for_small_amplitudes_only(client: TestClient) -> None:
    unstable = two_storeys((1, 1)).as_dict()
    (found,) = [one for one in client.post("/api/v1/plans/check", json=unstable).json()["warnings"] if "unstable" in one]
    assert "oscillates at 3.89 Hz" in found and "initial tangent" in found
    stable = client.post("/api/v1/plans/check", json=plan()).json()["warnings"]
    assert not any("unstable" in one for one in stable)


@pytest.mark.parametrize("name", ["two-storeys", "linear-damper"])
def test_the_page_of_a_template_names_its_source_and_allows_styles_alone(client: TestClient, name: str) -> None:
    answer = client.get(f"/stability/{name}")
    assert answer.status_code == 200
    assert f'data-source="/templates/{name}"' in answer.text
    policy = answer.headers["content-security-policy"]
    assert "style-src 'self' 'unsafe-inline'" in policy and "script-src 'self';" in policy
    assert "unsafe" not in client.get("/new").headers["content-security-policy"]


def test_the_page_of_a_run_reads_the_run(client: TestClient) -> None:
    run = client.post("/api/v1/runs", json={"plan": plan(), "submitted_by": "Ana Ruiz"}).json()["runs"][0]["id"]
    assert f'data-source="/runs/{run}"' in client.get(f"/stability/{run}").text


def test_an_unknown_name_is_a_page_that_says_so(client: TestClient) -> None:
    answer = client.get("/stability/nothing")
    assert answer.status_code == 404 and "There is no run or template nothing." in answer.text


def test_plotly_comes_from_this_service(client: TestClient) -> None:
    answer = client.get("/static/plotly.min.js")
    assert answer.status_code == 200 and answer.headers["content-type"].startswith("text/javascript")
    assert b"plotly.js" in answer.content[:200]


def test_the_command_prints_the_prediction(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "plan.yaml"
    path.write_text(plan_to_yaml(two_storeys((30, 1))))
    assert main(["stability", str(path)]) == 0
    assert "UNSTABLE" in capsys.readouterr().out
    assert main(["stability", str(path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["radius"] > 1


def test_the_command_without_a_plan_prints_the_published_limit(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stability", "--json"]) == 0
    limit = json.loads(capsys.readouterr().out)["limit"]
    assert limit[0]["alpha1"] == 1.0 and limit[0]["alpha2"] > 1.5
    assert all(one["alpha2"] > other["alpha2"] for one, other in pairwise(limit))


def test_the_command_refuses_a_file_that_is_not_there(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stability", "nowhere.yaml"]) == 2
    assert "nowhere.yaml" in capsys.readouterr().err
