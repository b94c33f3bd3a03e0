"""Two people change the state of a test, sweep or rig at once: what allowed a change still holds when it is stored."""

from __future__ import annotations

import uuid
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.annotations import service
from app.db import unit_of_work
from app.jobs.service import JobService
from app.jobs.states import State
from app.models import Run, Sweep, SweepShard
from app.runs import views
from app.runs.job import RUNS
from tests.app.conftest import app_of, plan
from tests.app.test_contention import at_once

V1 = "/api/v1"
ROUNDS = 15
FIELDS = [{"path": "stations.0.compensator.alpha_es", "values": [20, 30]}]
SWEEP = {"name": "Delay", "plan": plan(duration=0.2), "fields": FIELDS}
RULES = {"one_driver": False, "approvals": True, "approvers": []}


def cancelled(client: TestClient, name: str = "As submitted") -> str:
    run: str = client.post(f"{V1}/runs", json={"plan": plan(name=name), "submitted_by": "Ana"}).json()["runs"][0]["id"]
    assert client.post(f"{V1}/runs/{run}/cancel", json={"by": "Ana"}).status_code == 200
    return run


def together(*asks: Callable[[], Any]) -> list[int]:
    """The status of each of these requests, which start together."""
    return [answer.status_code for answer in at_once(len(asks), lambda number: asks[number]())]


def undo(client: TestClient, run: str) -> Callable[[], Any]:
    return partial(client.post, f"{V1}/runs/{run}/undo-cancel", json={"by": "Ana"})


def shown(client: TestClient, run: str) -> dict[str, Any]:
    found: dict[str, Any] = client.get(f"{V1}/runs/{run}").json()
    return found


def test_a_test_is_never_both_deleted_or_archived_and_in_the_queue(client: TestClient) -> None:
    for number in range(ROUNDS):
        run = cancelled(client)
        hidden: list[Callable[[], Any]] = [
            partial(client.delete, f"{V1}/runs/{run}"),
            partial(client.post, f"{V1}/runs/bulk", json={"action": "delete", "runs": [run]}),
            partial(client.post, f"{V1}/runs/bulk", json={"action": "archive", "runs": [run]}),
            partial(client.patch, f"{V1}/runs/{run}", json={"archived": True}),
        ]
        pair = [undo(client, run), hidden[number % 4]]
        assert set(together(*(pair if number % 2 else pair[::-1]))) <= {200, 204, 409}
        now = shown(client, run)
        hides = now["archived"] or now["deleted_at"] is not None
        assert (now["state"] == "cancelled") == hides, now
    waiting = [one["id"] for one in client.get(f"{V1}/queue").json()["waiting"]]
    assert not [run for run in waiting if shown(client, run)["deleted_at"]]


def test_no_worker_starts_a_test_that_is_deleted(client: TestClient) -> None:
    """As earlier versions of the program could leave one in the queue."""
    run = client.post(f"{V1}/runs", json={"plan": plan()}).json()["runs"][0]["id"]
    with unit_of_work(app_of(client).state.sessions) as session:
        session.execute(sa.update(Run).where(Run.id == run).values(deleted_at=sa.func.current_timestamp()))
    with unit_of_work(app_of(client).state.sessions) as session:
        assert JobService(session, RUNS).start(run, "worker").started is None
    assert client.post(f"{V1}/runs/{run}/restore").status_code == 200
    with unit_of_work(app_of(client).state.sessions) as session:
        assert JobService(session, RUNS).start(run, "worker").started is not None


def test_what_waits_for_approval_has_the_name_of_its_plan(client: TestClient) -> None:
    runs = [cancelled(client, "DANGER full scale") for _ in range(ROUNDS)]
    other = cancelled(client, "DANGER full scale")
    assert client.patch(f"{V1}/runs/{other}", json={"name": "harmless small test"}).status_code == 200
    again = client.post(f"{V1}/runs/{other}/retry", json={"by": "Ana"}).json()
    assert (again["state"], again["name"]) == ("queued", "harmless small test")
    assert client.put(f"{V1}/rules", json=RULES).status_code == 200
    again = client.post(f"{V1}/runs/{other}/retry", json={"by": "Ana"}).json()
    assert (again["state"], again["name"]) == ("to approve", "DANGER full scale")
    assert undo(client, other)().json()["name"] == "DANGER full scale"
    for run in runs:
        assert set(together(undo(client, run), partial(client.patch, f"{V1}/runs/{run}", json={"name": "calm"}))) <= {200, 409}
        now = shown(client, run)
        assert (now["state"], now["name"]) == ("to approve", "DANGER full scale")
    waits = client.get(f"{V1}/approvals").json()["approvals"]
    assert {one["name"] for one in waits} == {"DANGER full scale"} and len(waits) == ROUNDS + 2


def test_a_cancel_beside_an_undo_leaves_nothing_to_approve_of_a_test_that_was_cancelled(client: TestClient) -> None:
    assert client.put(f"{V1}/rules", json=RULES).status_code == 200
    for _ in range(ROUNDS):
        run = cancelled(client)
        cancel = partial(client.post, f"{V1}/runs/{run}/cancel", json={"by": "Ana"})
        several = partial(client.post, f"{V1}/queue/cancel", json={"runs": [run], "by": "Ana"})
        assert set(together(undo(client, run), cancel, several)) <= {200, 409}
        asked = run in {one["id"] for one in client.get(f"{V1}/approvals").json()["approvals"]}
        assert asked == (shown(client, run)["state"] == "to approve")


def test_a_sweep_is_deleted_or_resumed_and_never_half_of_both(client: TestClient) -> None:
    first = client.post(f"{V1}/sweeps", json={"sweep": SWEEP, "submitted_by": "Ana"}).json()["id"]
    assert client.post(f"{V1}/sweeps/{first}/cancel", json={"by": "Ana"}).status_code == 200
    for number in range(6):
        at = f"{V1}/sweeps/{_copied(client, first)}"
        what = ("resume", "cancel")[number % 2]
        removed, other = together(partial(client.delete, at), partial(client.post, f"{at}/{what}", json={"by": "Ana"}))
        assert (removed, other) in {(204, 404), (204, 409), (409, 200)}
        assert client.get(at).status_code == (404 if removed == 204 else 200)
    with unit_of_work(app_of(client).state.sessions) as session:
        waiting = session.scalars(sa.select(SweepShard.sweep_number).where(SweepShard.state == State.QUEUED)).all()
    assert len(set(waiting)) == client.get(f"{V1}/sweeps").json()["total"] - 1


def _copied(client: TestClient, sweep: str) -> str:
    """A copy of a cancelled sweep: it costs less than the check of a definition."""
    with unit_of_work(app_of(client).state.sessions) as session:
        found = session.scalars(sa.select(Sweep).where(Sweep.id == sweep)).one()
        row = {one.key: getattr(found, one.key) for one in sa.inspect(Sweep).column_attrs if one.key != "number"}
        session.add(Sweep(**{**row, "id": str(uuid.uuid4())}))
        return str(session.scalars(sa.select(Sweep.id).order_by(Sweep.number.desc())).first())


def test_no_test_waits_for_a_rig_that_is_gone(client: TestClient) -> None:
    for number in range(ROUNDS):
        given: dict[str, Any] = {
            "name": f"Rig {number}",
            "kind": "emulated",
            "tests_at_a_time": None,
            "actuators": [],
            "retired": False,
        }
        rig = client.post(f"{V1}/rigs", json=given).json()["id"]
        submit = partial(client.post, f"{V1}/runs", json={"plan": plan(), "rig": rig})
        submitted, removed = together(submit, partial(client.delete, f"{V1}/rigs/{rig}"))
        assert (submitted, removed) in {(201, 409), (422, 204)}
    known = {one["id"] for one in client.get(f"{V1}/rigs").json()["rigs"]}
    assert {one["rig_id"] for one in client.get(f"{V1}/queue").json()["waiting"]} <= known


def test_a_limit_holds_for_requests_that_come_together(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service, "MOST", 3)
    monkeypatch.setattr(views, "MOST_VIEWS", 3)
    run = client.post(f"{V1}/runs", json={"plan": plan()}).json()["runs"][0]["id"]
    with unit_of_work(app_of(client).state.sessions) as session:
        JobService(session, RUNS).start(run, "worker")
    note = {"from_s": 1.0, "text": "Oil", "by": "Ana"}
    written = at_once(8, lambda _: client.post(f"{V1}/runs/{run}/annotations", json=note))
    saved = at_once(8, lambda number: client.post(f"{V1}/runs/views", json={"name": f"View {number}", "query": "?sort=name"}))
    for answers in (written, saved):
        assert sorted(answer.status_code for answer in answers) == [201] * 3 + [409] * 5
