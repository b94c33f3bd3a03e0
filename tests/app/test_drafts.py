"""Drafts: kept as typed, valid or not; two windows never overwrite each other; closed, found again and reopened."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.library import drafts
from rths_engine.foundation.errors import MOST_ISSUES
from rths_engine.planning.differences import titles
from tests.app.conftest import plan
from tests.app.test_library import URL as PLANS
from tests.app.test_library import keep
from tests.app.test_openapi import held

URL = "/api/v1/library/drafts"
ONE = URL + "/{draft_id}"


def put(client: TestClient, typed: Any, revision: int = 0, draft: str = "d1", **more: Any) -> Any:
    answer = client.put(f"{URL}/{draft}", json={"plan": typed, "revision": revision, "owner": "Ana Ruiz", **more})
    held(f"PUT {ONE}", answer)
    return answer


def listed(client: TestClient, **query: Any) -> list[dict[str, Any]]:
    answer = client.get(URL, params=query)
    held(f"GET {URL}", answer)
    found: list[dict[str, Any]] = answer.json()["drafts"]
    return found


def test_an_invalid_plan_is_kept_as_typed_and_says_what_is_wrong(client: TestClient) -> None:
    typed = {
        **plan(),
        "name": " Brace B ",
        "duration": "4o s",
        "stations": [{"actuator": {"alpha": 0.2, "kind": "first_order_delay"}}],
    }
    saved = put(client, typed, origin={"kind": "template", "id": "table3-04"}).json()
    assert (saved["name"], saved["revision"], saved["owner"]) == ("Brace B", 1, "Ana Ruiz")
    (alpha,) = [one for one in saved["problems"] if one["where"] == "stations.0.actuator.alpha"]
    assert (alpha["title"], alpha["value"]) == ("Station 1: Actuator: Delay constant α", "0.2")
    (duration,) = [one for one in saved["problems"] if one["where"] == "duration"]
    assert (duration["title"], duration["unit"], duration["value"]) == ("Duration", "s", "4o s")
    assert saved["origin_title"] == "template table3-04"
    again = client.get(f"{URL}/d1")
    held(f"GET {ONE}", again)
    assert again.json() == {**saved, "plan": typed}
    assert put(client, plan(), 1).json()["problems"] == []


@pytest.mark.parametrize(
    "typed", [{}, {"stations": "not yet"}, {"stations": [1, None, {}]}, {"motion": {"kind": 4}, "known": 3}]
)
def test_any_mapping_is_a_draft_and_its_problems_have_titles(client: TestClient, typed: dict[str, Any]) -> None:
    answer = put(client, typed)
    assert answer.status_code == 200 and all(one["title"] or not one["where"] for one in answer.json()["problems"])


def test_a_save_of_another_window_is_never_overwritten(client: TestClient) -> None:
    put(client, plan(notes="of the first window"), writer="first")
    assert put(client, plan(notes="of the second"), 1, writer="second").json()["revision"] == 2
    refused = put(client, plan(notes="again of the first"), 1, writer="first")
    assert refused.status_code == 409 and "Another window saved this draft" in refused.json()["detail"]
    assert client.get(f"{URL}/d1").json()["plan"]["notes"] == "of the second"
    assert put(client, plan(), 0, writer="third").status_code == 409  # an id that is taken
    assert put(client, plan(notes="of the second"), 1, writer="first").json()["revision"] == 2  # the same is no conflict
    later = put(client, plan(notes="on the way out"), 1, writer="second")  # its own answer never reached it
    assert later.json()["revision"] == 3


def test_a_draft_is_closed_and_reopened_and_nothing_is_lost(client: TestClient) -> None:
    put(client, plan())
    put(client, plan(), draft="d2")
    closed = client.post(f"{URL}/d1/close", json={"closed_as": "queued"})
    held(f"POST {ONE}/close", closed)
    assert (closed.json()["closed_as"], closed.json()["revision"]) == ("queued", 2)
    assert [one["id"] for one in listed(client, owner="Ana Ruiz")] == ["d2"]
    assert [one["id"] for one in listed(client, closed=True)] == ["d1"]
    refused = put(client, plan(), 2)
    assert refused.status_code == 409 and "was closed" in refused.json()["detail"]
    assert client.post(f"{URL}/d1/close").json()["closed_as"] == "queued"
    again = client.post(f"{URL}/d1/reopen")
    held(f"POST {ONE}/reopen", again)
    assert again.json()["closed_at"] is None and put(client, plan(), 3).status_code == 200
    assert [one["id"] for one in listed(client)] == ["d1", "d2"]


def test_drafts_are_listed_by_owner_and_by_the_plan_they_started_from(client: TestClient) -> None:
    kept = keep(client, "Brace")
    put(client, plan(), origin={"kind": "version", "id": kept["id"], "version": 1})
    put(client, plan(), draft="d2", owner="")
    assert [one["id"] for one in listed(client, owner="")] == [one["id"] for one in listed(client, owner="unnamed")] == ["d2"]
    (found,) = listed(client, origin=kept["id"])
    assert (found["origin_title"], found["origin"]["version"]) == ("Brace, version 1", 1)
    assert client.get(f"{PLANS}/{kept['id']}").json()["drafts"] == 1


def test_saving_a_version_closes_its_draft(client: TestClient) -> None:
    kept = keep(client, "Brace")
    for draft, path in (("d1", f"{PLANS}/{kept['id']}/versions"), ("d2", PLANS)):
        put(client, plan(duration=3.0), draft=draft)
        body = {"plan": plan(duration=3.0), "draft": draft, **({"name": "Other"} if path == PLANS else {})}
        assert client.post(path, json=body).status_code == 201
        assert client.get(f"{URL}/{draft}").json()["closed_as"] == "saved"
    answer = client.post(PLANS, json={"plan": plan(), "name": "Third", "draft": "nothing"})
    assert answer.status_code == 404
    assert "Third" not in client.get(PLANS).text


@pytest.mark.parametrize(
    ("typed", "where"),
    [
        ('{"a": NaN}', "a"),
        ('{"a": [1e999]}', "a.0"),
        ('{"a": "\\ud800"}', "a"),
        ('{"a": %s}' % ("[" * 36 + "]" * 36), ""),
        ("[1]", "plan"),
        ("null", "plan"),
    ],
)
def test_what_no_database_can_store_is_refused(serving: TestClient, typed: str, where: str) -> None:
    answer = serving.put(
        f"{URL}/d1", content=f'{{"plan": {typed}, "revision": 0}}', headers={"content-type": "application/json"}
    )
    held(f"PUT {ONE}", answer)
    assert answer.status_code == 422 and answer.json()["errors"][0]["where"].startswith(where)


def test_a_draft_that_is_not_there_is_not_found(client: TestClient) -> None:
    assert client.get(f"{URL}/nothing").status_code == put(client, plan(), 4).status_code == 404
    assert client.post(f"{URL}/nothing/close").status_code == client.post(f"{URL}/nothing/reopen").status_code == 404
    assert put(client, plan(), draft="no~id").status_code == 422


def test_many_unknown_fields_are_titled_once_and_listed_in_part(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[int] = []

    def counted(typed: Any) -> dict[str, tuple[str, str]]:
        calls.append(len(typed))
        return titles(typed)

    monkeypatch.setattr(drafts, "titles", counted)
    typed = plan() | {f"unknown{number}": number for number in range(1500)}
    assert len(put(client, typed).json()["problems"]) == drafts.MOST_PROBLEMS and calls == [len(typed)]
    refused = client.post("/api/v1/plans/check", json=typed)
    errors = refused.json()["errors"]
    assert refused.status_code == 422 and len(errors) == MOST_ISSUES + 1
    assert errors[-1]["problem"] == f"has {1500 - MOST_ISSUES} more errors that are not listed"
