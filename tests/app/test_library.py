"""The library of plans: versions that never change, tags, archive, copies, YAML and the runs of a version."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from fastapi.testclient import TestClient

from rths_engine.planning.reading import plan_from_yaml
from tests.app.conftest import plan
from tests.app.test_openapi import held

URL = "/api/v1/library/plans"
ONE, VERSIONS, VERSION = URL + "/{plan_id}", URL + "/{plan_id}/versions", URL + "/{plan_id}/versions/{version}"


def keep(client: TestClient, name: str = "Brace", tags: tuple[str, ...] = (), **changes: Any) -> dict[str, Any]:
    answer = client.post(URL, json={"plan": plan(**changes), "name": name, "tags": list(tags), "saved_by": "Ana Ruiz"})
    held(f"POST {URL}", answer)
    assert answer.status_code == 201, answer.text
    saved: dict[str, Any] = answer.json()
    return saved


def more(client: TestClient, kept: dict[str, Any], comment: str = "", by: str = "Ben", **changes: Any) -> Any:
    body = {"plan": plan(**changes), "comment": comment, "saved_by": by}
    answer = client.post(f"{URL}/{kept['id']}/versions", json=body)
    held(f"POST {VERSIONS}", answer)
    return answer.json()


def names(client: TestClient, **query: Any) -> list[str]:
    answer = client.get(URL, params=query)
    held(f"GET {URL}", answer)
    return [one["name"] for one in answer.json()["plans"]]


def test_versions_are_numbered_kept_unchanged_and_each_has_author_time_and_comment(client: TestClient) -> None:
    kept = keep(client)
    first = client.get(f"{URL}/{kept['id']}/versions/1").json()
    second = more(client, kept, "Longer", duration=3.0)
    assert (second["created"], second["version"]["number"], second["version"]["comment"]) == (True, 2, "Longer")
    assert second["version"]["digest"] != first["digest"]
    answer = client.get(f"{URL}/{kept['id']}")
    held(f"GET {ONE}", answer)
    shown = answer.json()
    assert [(one["number"], one["saved_by"]) for one in shown["history"]] == [(2, "Ben"), (1, "Ana Ruiz")]
    assert shown["changed_at"] == shown["history"][0]["saved_at"] and shown["newest"] == shown["history"][0]
    for number, duration in ((1, 2.0), (2, 3.0)):
        version = client.get(f"{URL}/{kept['id']}/versions/{number}")
        held(f"GET {VERSION}", version)
        assert version.json()["plan"]["duration"] == duration
    assert client.get(f"{URL}/{kept['id']}/versions/1").json() == first


def test_equal_content_makes_no_new_version_and_a_new_note_does(client: TestClient) -> None:
    kept = keep(client)
    assert more(client, kept)["created"] is False
    noted = more(client, kept, notes="Pump serviced before the test.")
    assert (noted["created"], noted["version"]["number"]) == (True, 2)  # equal digest, other content
    assert noted["version"]["digest"] == kept["version"]["digest"]
    again = more(client, kept)
    assert (again["created"], again["version"]["number"]) == (False, 1)
    assert client.get(f"{URL}/{kept['id']}").json()["versions"] == 2


def test_versions_saved_at_the_same_moment_each_get_a_number(client: TestClient) -> None:
    kept = keep(client)
    saves = [threading.Thread(target=more, args=(client, kept), kwargs={"duration": 3.0 + n}) for n in range(4)]
    for one in saves:
        one.start()
    for one in saves:
        one.join()
    assert [one["number"] for one in client.get(f"{URL}/{kept['id']}").json()["history"]] == [5, 4, 3, 2, 1]


def test_the_list_is_searched_by_name_tag_and_comment_sorted_and_paged(client: TestClient) -> None:
    brace, damper = keep(client, "Brace", ("steel", "spring 2027")), keep(client, "damper 100 %", ("MR",))
    more(client, brace, "Stiffer gusset", duration=3.0)
    assert names(client) == ["Brace", "damper 100 %"]  # last changed first
    assert names(client, sort="name", order="desc") == ["damper 100 %", "Brace"]
    assert names(client, q="GUSSET") == names(client, q="steel") == names(client, tag="spring 2027") == ["Brace"]
    assert names(client, q="100 %") == names(client, q="mr") == ["damper 100 %"]
    assert names(client, q="100 _") == names(client, tag="spring") == names(client, saved_by="Zoe") == []
    assert names(client, limit=1, offset=1) == ["damper 100 %"]
    assert client.get(URL).json()["tags"] == [{"tag": one, "plans": 1} for one in ("MR", "spring 2027", "steel")]
    refused = client.get(URL, params={"sort": "names"})
    assert refused.status_code == 422 and "try name" in refused.text
    assert damper["version"]["runs"] == 0


def test_a_plan_is_renamed_tagged_archived_and_brought_back(client: TestClient) -> None:
    kept, other = keep(client, tags=("a",)), keep(client, "Other")
    path = f"{URL}/{kept['id']}"
    changed = client.patch(path, json={"name": " Brace, 100 kN ", "tags": ["b", "a", "b"]})
    held(f"PATCH {ONE}", changed)
    assert (changed.json()["name"], changed.json()["tags"]) == ("Brace, 100 kN", ["a", "b"])
    assert client.patch(path, json={"tags": []}).json()["tags"] == []
    taken = client.patch(path, json={"name": "Other"})
    held(f"PATCH {ONE}", taken)
    assert taken.status_code == 409 and "'Other' is already that of a plan" in taken.text
    archived = client.post(f"{path}/archive", json={"by": "Ben"})
    held(f"POST {ONE}/archive", archived)
    assert archived.json()["archived_by"] == "Ben"
    assert names(client) == ["Other"] and names(client, archived=True) == ["Brace, 100 kN"]
    assert "archived plan" in client.post(URL, json={"plan": plan(), "name": "Brace, 100 kN"}).json()["detail"]
    back = client.post(f"{path}/unarchive")
    held(f"POST {ONE}/unarchive", back)
    assert back.json()["archived_at"] is None and len(names(client)) == 2
    assert client.delete(path).status_code == 405  # nothing is lost
    assert other["name"] == "Other"


def test_a_copy_starts_a_plan_of_its_own(client: TestClient) -> None:
    kept = keep(client, tags=("a",))
    more(client, kept, duration=3.0)
    path = f"{URL}/{kept['id']}/duplicate"
    first = client.post(path, json={"version": 1, "saved_by": "Ben"})
    held(f"POST {ONE}/duplicate", first)
    assert (first.json()["name"], client.post(path, json={}).json()["name"]) == ("Brace (copy)", "Brace (copy 2)")
    shown = client.get(f"{URL}/{first.json()['id']}").json()
    assert (shown["tags"], shown["newest"]["comment"]) == (["a"], "Copy of Brace, version 1.")
    assert client.get(f"{URL}/{first.json()['id']}/versions/1").json()["plan"]["duration"] == 2.0
    assert client.post(path, json={"name": "Brace"}).status_code == 409
    assert client.post(path, json={"version": 9}).status_code == 404


def test_a_plan_comes_from_yaml_and_goes_to_yaml(client: TestClient) -> None:
    text = client.get(f"{URL}/{keep(client)['id']}/versions/1/plan.yaml")
    held(f"GET {VERSION}/plan.yaml", text)
    query = {"name": "From a file", "saved_by": "Ben"}
    answer = client.post(
        "/api/v1/library/import", params=query, content=text.content, headers={"content-type": "application/yaml"}
    )
    held("POST /api/v1/library/import", answer)
    again = client.get(f"{URL}/{answer.json()['id']}/versions/1").json()
    assert again["plan"] == plan_from_yaml(text.text).as_dict() and again["saved_by"] == "Ben"
    assert client.post("/api/v1/library/import", params=query, content=b"a: [").status_code == 422


def test_an_invalid_plan_is_no_version(client: TestClient) -> None:
    answer = client.post(URL, json={"plan": plan(duration=-1), "name": "x"})
    held(f"POST {URL}", answer)
    assert answer.status_code == 422 and answer.json()["errors"][0]["where"] == "plan.duration"
    assert names(client) == []


def test_runs_name_the_version_that_they_were_queued_from(client: TestClient) -> None:
    kept = keep(client)
    more(client, kept, duration=3.0)
    for version, duration in ((1, 2.0), (2, 2.5)):
        body = {"plan": plan(duration=duration), "library": {"id": kept["id"], "version": version}}
        run = client.post("/api/v1/runs", json=body).json()["runs"][0]
        assert (run["library_id"], run["library_version"]) == (kept["id"], version)
    answer = client.get(f"{URL}/{kept['id']}/runs")
    held(f"GET {ONE}/runs", answer)
    assert [(one["version"], one["changed"]) for one in answer.json()["runs"]] == [(2, True), (1, False)]
    shown = client.get(f"{URL}/{kept['id']}").json()
    assert (shown["runs"], [one["runs"] for one in shown["history"]]) == (2, [1, 1])
    deleted = answer.json()["runs"][0]["id"]
    client.post(f"/api/v1/runs/{deleted}/cancel")
    assert client.delete(f"/api/v1/runs/{deleted}").is_success
    assert client.get(f"{URL}/{kept['id']}/runs").json()["total"] == client.get(f"{URL}/{kept['id']}").json()["runs"] == 1
    other = client.post("/api/v1/runs", json={"plan": plan(), "library": {"id": kept["id"], "version": 9}})
    assert other.status_code == 422 and other.json()["errors"][0]["where"] == "library"
    assert client.post("/api/v1/runs", json={"plan": plan()}).json()["runs"][0]["library_id"] is None


def test_two_plans_are_compared_field_by_field_in_the_units_shown(client: TestClient) -> None:
    kept = keep(client)
    stations = [dict(one) for one in plan()["stations"]]
    stations[0]["limits"] = {**stations[0]["limits"], "velocity": 0.25}
    more(client, kept, stations=stations)
    run = client.post("/api/v1/runs", json={"plan": plan(stations=stations, seed=5)}).json()["runs"][0]
    client.put("/api/v1/library/drafts/d1", json={"plan": {**plan(), "duration": "long"}, "revision": 0})

    def between(first: str, second: str) -> Any:
        answer = client.get("/api/v1/library/differences", params={"first": first, "second": second})
        held("GET /api/v1/library/differences", answer)
        return answer.json()

    old, new = (f"version:{kept['id']}:{number}" for number in (1, 2))
    found = between(old, new)
    assert [one["title"] for one in found["items"]] == ["Brace, version 1", "Brace, version 2"]
    (row,) = found["differences"]
    assert (row["path"], row["unit"], row["texts"][1]) == ("stations.0.limits.velocity", "mm/s", "250")
    assert [one["path"] for one in between(new, f"run:{run['id']}")["differences"]] == ["seed"]
    assert [one["path"] for one in between(old, "draft:d1")["differences"]] == ["duration"]
    assert [one["path"] for one in between("template:two-storeys", old)["differences"]] == ["duration"]
    assert between(old, old)["differences"] == []
    for wrong in ("version:x", f"version:{kept['id']}:9", "run:x", "draft:x", "template:x", "x", f"version:{kept['id']}:a"):
        assert "status" in between(wrong, old), wrong


def test_plans_run_before_the_library_was_there_can_be_kept(earlier: TestClient) -> None:
    run = earlier.get("/api/v1/runs").json()["runs"][0]
    assert (run["library_id"], run["library_version"]) == (None, None)
    stored = earlier.get(f"/api/v1/runs/{run['id']}").json()["plan"]
    assert earlier.post(URL, json={"plan": stored, "name": "Of an earlier run"}).status_code == 201


@pytest.mark.parametrize("path", ["", "/versions/1", "/versions/1/plan.yaml", "/runs"])
def test_a_plan_that_is_not_there_is_not_found(serving: TestClient, path: str) -> None:
    answer = serving.get(f"{URL}/nothing{path}")
    assert answer.status_code == 404 and "There is no plan nothing" in answer.json()["detail"]


def test_a_name_or_tag_of_spaces_is_refused_and_spaces_around_one_are_not_kept(client: TestClient) -> None:
    kept = keep(client)
    path = f"{URL}/{kept['id']}"
    for answer, where in (
        (client.post(URL, json={"plan": plan(), "name": "   "}), "name"),
        (client.post(URL, json={"plan": plan(name=" ")}), "plan.name"),
        (client.post(URL, json={"plan": plan(), "name": "Other", "tags": ["a", "  "]}), "tags.1"),
        (client.patch(path, json={"name": " \t"}), "name"),
        (client.post(f"{path}/duplicate", json={"name": "   "}), "name"),
    ):
        assert answer.status_code == 422
        (error,) = answer.json()["errors"]
        assert (error["where"], error["problem"]) == (where, "is blank")
    long = f"  {'x' * 200}  "
    assert client.patch(path, json={"name": long, "tags": [" a "]}).json()["name"] == long.strip()
