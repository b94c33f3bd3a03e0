"""Another person approves a submission before it queues, where the laboratory has this rule."""

from __future__ import annotations

from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app.db import unit_of_work
from app.jobs.service import JobService
from app.models import Approval, Run, RunPlan
from app.runs.job import RUNS
from app.runs.order import Outcome, RunOrder
from app.worker.child import Refused
from app.worker.engine import _check_approved
from tests.app.conftest import app_of, plan

FIELDS = [{"path": "stations.0.compensator.alpha_es", "values": [20, 30]}]
SWEEP = {"name": "Delay", "plan": plan(duration=0.2), "fields": FIELDS}


@pytest.fixture
def ruled(client: TestClient) -> TestClient:
    """The service of a laboratory in which another person approves each submission."""
    assert client.put("/api/v1/rules", json={"approvals": True, "approvers": ["Bea"]}).status_code == 200
    return client


def submitted(client: TestClient, by: str = "Ana") -> dict[str, Any]:
    answer = client.post("/api/v1/runs", json={"plan": plan(), "submitted_by": by})
    assert answer.status_code == 201, answer.text
    run: dict[str, Any] = answer.json()["runs"][0]
    return run


def decide(client: TestClient, run: dict[str, Any], what: str, by: str, **given: Any) -> Any:
    body = {"by": by, **({"digest": run["digest"]} if what == "approve" else {"reason": "too fast"}), **given}
    return client.post(f"/api/v1/approvals/{run['id']}/{what}", json=body)


def state(client: TestClient, run: dict[str, Any]) -> str:
    found: str = client.get(f"/api/v1/runs/{run['id']}").json()["state"]
    return found


def start(client: TestClient, turn: str) -> RunOrder | None:
    """The order of the run that a worker starts in this turn."""
    with unit_of_work(app_of(client).state.sessions) as session:
        jobs: JobService[Run, Outcome] = JobService(session, RUNS)
        taken = jobs.start(turn, "worker").started
        return RUNS.order(taken, app_of(client).state.settings) if taken else None


def test_a_submission_waits_outside_of_the_queue_until_another_person_approves_it(ruled: TestClient) -> None:
    run = submitted(ruled)
    queue = ruled.get("/api/v1/queue").json()
    assert run["state"] == "to approve" and queue["queued"] == 0 and queue["waiting"] == []
    assert start(ruled, run["id"]) is None
    (waits,) = ruled.get("/api/v1/approvals", params={"by": "Bea"}).json()["approvals"]
    assert (waits["about"], waits["id"], waits["digest"], waits["refusal"]) == ("run", run["id"], run["digest"], None)
    own = decide(ruled, run, "approve", "Ana")
    assert own.status_code == 403 and "own submission" in own.json()["detail"]
    assert decide(ruled, run, "approve", "Bea", digest="0" * 64).status_code == 409
    assert decide(ruled, run, "approve", "Bea").json()["decided_by"] == "Bea"
    assert state(ruled, run) == "queued" and ruled.get("/api/v1/approvals").json()["approvals"] == []
    assert decide(ruled, run, "approve", "Bea").status_code == 409
    order = start(ruled, run["id"])
    assert order is not None and order.approved == run["digest"]
    actions = [one["action"] for one in ruled.get("/api/v1/audit", params={"run": "1"}).json()["entries"]]
    assert "approvals.approve" in actions
    kinds = [one["kind"] for one in ruled.get("/api/v1/events").json()["events"]]
    assert kinds == ["started", "approved", "to approve"]


def test_the_plan_that_was_approved_is_the_plan_that_runs(ruled: TestClient) -> None:
    run = submitted(ruled)
    with app_of(ruled).state.sessions.begin() as session:
        stored = session.scalars(sa.select(RunPlan)).one()
        original = stored.plan
        stored.plan = {**original, "duration": 3.0}
    assert decide(ruled, run, "approve", "Bea").status_code == 409
    with app_of(ruled).state.sessions.begin() as session:
        session.scalars(sa.select(RunPlan)).one().plan = original
    assert decide(ruled, run, "approve", "Bea").status_code == 200
    order = start(ruled, run["id"])
    assert order is not None
    _check_approved(order)
    order.plan["duration"] = 3.0
    with pytest.raises(Refused, match="not the one that was approved"):
        _check_approved(order)


def test_a_rejection_ends_the_run_with_its_reason_and_is_not_undone(ruled: TestClient) -> None:
    run = submitted(ruled)
    assert decide(ruled, run, "reject", "Bea", reason=" ").status_code == 422
    assert decide(ruled, run, "reject", "Bea").status_code == 200
    found = ruled.get(f"/api/v1/runs/{run['id']}").json()
    assert (found["state"], found["reason"]) == ("cancelled", "Rejected by Bea: too fast")
    assert ruled.post(f"/api/v1/runs/{run['id']}/undo-cancel", json={"by": "Ana"}).status_code == 409
    again = ruled.post(f"/api/v1/runs/{run['id']}/retry", json={"by": "Ana"}).json()
    assert again["state"] == "to approve"


def test_a_submitter_withdraws_a_submission_by_cancelling_it(ruled: TestClient) -> None:
    run, other = submitted(ruled), submitted(ruled)
    assert ruled.post(f"/api/v1/runs/{run['id']}/cancel", json={"by": "Ana"}).json()["state"] == "cancelled"
    assert ruled.post("/api/v1/queue/cancel", json={"runs": [other["id"]], "by": "Ana"}).json()["cancelled"] == [other["id"]]
    assert ruled.get("/api/v1/approvals").json()["approvals"] == []
    assert decide(ruled, run, "approve", "Bea").status_code == 409


def test_a_sweep_waits_for_approval_too(ruled: TestClient) -> None:
    sweep = ruled.post("/api/v1/sweeps", json={"sweep": SWEEP, "submitted_by": "Ana"})
    assert sweep.status_code == 201, sweep.text
    found = sweep.json()
    assert found["state"] == "to approve"
    (waits,) = ruled.get("/api/v1/approvals", params={"by": "Bea"}).json()["approvals"]
    assert (waits["about"], waits["points"]) == ("sweep", 2)
    assert ruled.delete(f"/api/v1/sweeps/{found['id']}").status_code == 409  # it would leave a submission without its sweep
    assert decide(ruled, waits, "approve", "Bea").status_code == 200
    assert ruled.get(f"/api/v1/sweeps/{found['id']}").json()["state"] == "queued"
    with app_of(ruled).state.sessions() as session:
        assert session.scalars(sa.select(Approval)).one().decided_by == "Bea"


def test_without_the_rule_nothing_waits(client: TestClient) -> None:
    assert submitted(client)["state"] == "queued"
    assert client.get("/api/v1/approvals").json() == {"approvals": []}
    assert client.post("/api/v1/approvals/nowhere/approve", json={"digest": "x"}).status_code == 404
