"""The record library and plans by REST."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

from rths_engine.planning.reading import read_plan
from tests.app.conftest import plan
from tests.engine.formats.writers import mseed

MOTIONS = "/api/v1/motions"
COLUMNS = "\n".join(f"{0.01 * i:.2f} {0.2 * np.sin(i / 9):.6f}" for i in range(400))


def upload(client: TestClient, text: str | bytes, filename: str = "mine.txt", path: str = "", **fields: str) -> Any:
    raw = text.encode() if isinstance(text, str) else text
    return client.post(MOTIONS + path, files={"file": (filename, raw)}, data=fields)


def test_the_bundled_records_are_listed_with_their_provenance(client: TestClient) -> None:
    motions = client.get(MOTIONS).json()["motions"]
    assert sum("northridge" in motion["name"] for motion in motions) >= 2
    assert any("el-centro" in motion["name"] for motion in motions)
    assert all(motion["provenance"] for motion in motions)


def test_an_uploaded_record_is_kept_previewed_planned_and_removed(client: TestClient) -> None:
    assert upload(client, COLUMNS, path="/preview", unit="g").json()["pga"] == pytest.approx(0.2 * 9.80665, rel=1e-3)
    assert "mine" not in {motion["name"] for motion in client.get(MOTIONS).json()["motions"]}
    answer = upload(client, COLUMNS, unit="g")
    assert answer.status_code == 201, answer.text
    name = answer.json()["name"]
    shown = client.get(f"{MOTIONS}/{name}/preview").json()
    assert len(shown["spectrum"]["periods"]) == len(shown["spectrum"]["sa"])
    data = plan(motion={"kind": "record", "record": name})
    assert client.post("/api/v1/runs", json={"plan": data}).status_code == 201
    assert upload(client, COLUMNS, unit="g").status_code == 422  # the name is taken
    assert client.delete(f"{MOTIONS}/{name}").status_code == 204
    assert client.get(f"{MOTIONS}/{name}").status_code == 404


def test_a_file_of_several_channels_asks_for_one_by_name_or_number(client: TestClient) -> None:
    text = "\n".join(f"{0.01 * i:.2f} {0.2 * np.sin(i / 9):.6f} {0.1 * np.sin(i / 7):.6f}" for i in range(400))
    asked = upload(client, text, unit="g").json()["errors"][0]
    assert asked["where"] == "channel" and "2: column 3" in asked["fix"]
    for channel in ("2", "Column 3"):
        shown = upload(client, text, path="/preview", unit="g", channel=channel).json()
        assert shown["pga"] == pytest.approx(0.1 * 9.80665, rel=1e-3)


THREE = "\n".join(
    ["time (s),N-S (g),E-W (g)", *(f"{0.01 * k:.2f},{0.2 * np.sin(k / 9):.6f},{0.1 * np.cos(k / 7):.6f}" for k in range(400))]
)


def test_a_file_of_several_channels_says_their_names_and_each_is_added_by_its_number(client: TestClient) -> None:
    found = upload(client, THREE, "site.csv", "/contents").json()
    assert [(one["number"], one["name"], one["dt_s"]) for one in found["channels"]] == [
        (1, found["channels"][0]["name"], 0.01),
        (2, found["channels"][1]["name"], 0.01),
    ]
    assert found["first_rows"] and found["format"]
    refused = upload(client, THREE, "site.csv", "/preview", unit="g")
    assert refused.json()["errors"][0]["where"] == "channel"
    assert upload(client, THREE, "site.csv", "/preview", unit="g", channel="3").status_code == 422
    assert upload(client, THREE, "site.csv", "/preview", unit="g", channel="no").status_code == 422
    peaks = [upload(client, THREE, "site.csv", "/preview", unit="g", channel=str(k)).json()["pga"] / 9.80665 for k in (1, 2)]
    assert peaks == pytest.approx([0.2, 0.1], rel=1e-3)
    added = [upload(client, THREE, "site.csv", unit="g", channel=str(k)).json()["name"] for k in (1, 2)]
    assert len(set(added)) == 2 and all(name.startswith("site-") for name in added)


def test_a_file_says_what_it_does_not_state_and_what_its_header_states(client: TestClient) -> None:
    (channel,) = upload(client, "\n".join(f"{0.1 * np.sin(k / 9):.6f}" for k in range(400)), "bare.txt", "/contents").json()[
        "channels"
    ]
    assert (channel["asks"], channel["samples"], channel["unit"]) == (["unit", "dt"], 400, "")
    values = "\n".join(" ".join(f"{0.1 * np.sin((k + j) / 9):.6f}" for j in range(5)) for k in range(0, 400, 5))
    record = f"PEER\nTITLE\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  400, DT=   .0100 SEC\n{values}"
    found = upload(client, record, "record.AT2", "/contents").json()
    assert found["channels"][0]["asks"] == [] and found["channels"][0]["dt_s"] == 0.01
    assert [(one["stated"], one["read"], one["agrees"]) for one in found["statements"]] == [(400, 400, True)]
    wrong = upload(client, record.replace("NPTS=  400", "NPTS=  500"), "record.AT2", "/contents").json()["errors"][0]
    assert "500" in wrong["problem"] and "400" in wrong["problem"]
    assert wrong["lines"][-3]["text"].startswith("NPTS")


def test_a_record_in_counts_asks_for_the_acceleration_of_one_count(client: TestClient) -> None:
    raw = mseed.written(mseed.Channel("BK.VALB.40.HN1", [round(1e5 * np.sin(k / 9)) for k in range(1000)]))
    (channel,) = upload(client, raw, "valb.mseed", "/contents").json()["channels"]
    assert (channel["asks"], channel["dt_s"]) == (["count"], 0.005)
    assert upload(client, raw, "valb.mseed", "/preview").json()["errors"][0]["where"] == "unit"
    shown = upload(client, raw, "valb.mseed", "/preview", unit="1e-5 m/s^2").json()
    assert shown["pga"] == pytest.approx(1.0, rel=0.02)  # the mean is removed


@pytest.mark.parametrize(
    ("text", "filename"),
    [
        ("a letter to a friend\n" * 20, "friend.AT2"),
        (b"\x00\x01\x02" * 400, "noise.AT2"),
        ("", "empty.AT2"),
        ("0.1\nnan\n0.2\n" * 40, "gap.txt"),
    ],
)
def test_what_is_no_record_is_refused_and_not_stored(serving: TestClient, text: str | bytes, filename: str) -> None:
    before = serving.get(MOTIONS).json()
    answer = upload(serving, text, filename, unit="g", dt="0.01")
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["problem"]
    assert serving.get(MOTIONS).json() == before


def test_a_bundled_record_cannot_be_removed(client: TestClient) -> None:
    name = client.get(MOTIONS).json()["motions"][0]["name"]
    assert client.delete(f"{MOTIONS}/{name}").status_code == 422
    assert client.get(f"{MOTIONS}/{name}").status_code == 200


def test_templates_hold_the_papers_row(client: TestClient) -> None:
    names = [one["name"] for one in client.get("/api/v1/templates").json()["templates"]]
    assert [f"table3-{n:02d}" in names for n in range(1, 13)] == [True] * 12
    assert client.get("/api/v1/templates/table3-02").json()["paper"]["mte_mm"] == [2.0, 3.2]


def test_the_schema_says_label_unit_and_bounds_of_every_number(client: TestClient) -> None:
    alpha = client.get("/api/v1/schema").json()["$defs"]["FirstOrderDelay"]["properties"]["alpha"]
    assert (alpha["minimum"], alpha["unit"]) == (1, "1")
    limit = client.get("/api/v1/schema").json()["$defs"]["Limits"]["properties"]["displacement"]
    assert (limit["unit"], limit["shown"], limit["factor"]) == ("m", "mm", 1e-3)


def test_a_checked_plan_comes_back_with_digest_periods_and_warnings(client: TestClient) -> None:
    checked = client.post("/api/v1/plans/check", json=plan()).json()
    assert checked["summary"]["periods_s"][0] == pytest.approx(1.48)
    assert checked["summary"]["steps"] == 205
    assert checked["digest"] == read_plan(checked["plan"]).digest
    (run,) = client.post("/api/v1/runs", json={"plan": plan()}).json()["runs"]
    assert run["digest"] == checked["digest"]
    assert any("before the end of its record" in warning for warning in checked["warnings"])


def test_yaml_goes_out_and_comes_back(client: TestClient) -> None:
    text = client.post("/api/v1/plans/write", json=plan()).text
    assert "# N/m" in text
    answer = client.post("/api/v1/plans/read", content=text.encode(), headers={"content-type": "application/yaml"})
    assert read_plan(answer.json()) == read_plan(plan())


@pytest.mark.parametrize("body", [b"a: [", b"\xff\xfe", b"a: &a 1\nb: *a", b"[" * 5000])
def test_bad_yaml_is_refused(serving: TestClient, body: bytes) -> None:
    answer = serving.post("/api/v1/plans/read", content=body)
    assert answer.status_code == 422
