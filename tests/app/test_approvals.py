"""Another person approves a submission before it queues, where the laboratory has this rule."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from hashlib import sha256
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
    assert client.put("/api/v1/rules", json={"approvals": True, "approvers": ["Bea"], "one_driver": False}).status_code == 200
    return client


def submitted(client: TestClient, by: str = "Ana") -> dict[str, Any]:
    answer = client.post("/api/v1/runs", json={"plan": plan(), "submitted_by": by})
    assert answer.status_code == 201, answer.text
    run: dict[str, Any] = answer.json()["runs"][0]
    return run


def decide(client: TestClient, run: dict[str, Any], what: str, by: str, **given: Any) -> Any:
    body = {"by": by, **({"digest": asked(client, run)} if what == "approve" else {"reason": "too fast"}), **given}
    return client.post(f"/api/v1/approvals/{run['id']}/{what}", json=body)


def asked(client: TestClient, run: dict[str, Any]) -> str:
    """The digest of what waits."""
    waits = client.get("/api/v1/approvals").json()["approvals"]
    return next((str(one["digest"]) for one in waits if one["id"] == run["id"]), "0" * 64)


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
    assert (waits["about"], waits["id"], waits["refusal"], waits["own"]) == ("run", run["id"], None, False)
    whole = json.dumps(ruled.get(f"/api/v1/runs/{run['id']}").json()["plan"], sort_keys=True, separators=(",", ":"))
    assert waits["digest"] == sha256(whole.encode()).hexdigest()
    assert (waits["duration_s"], waits["pace"], waits["points"]) == (2.0, None, None)
    own = decide(ruled, run, "approve", "Ana")
    assert own.status_code == 403 and "own submission" in own.json()["detail"]
    assert decide(ruled, run, "approve", "Bea", digest="0" * 64).status_code == 409
    assert decide(ruled, run, "approve", "Bea").json()["decided_by"] == "Bea"
    assert state(ruled, run) == "queued" and ruled.get("/api/v1/approvals").json()["approvals"] == []
    assert decide(ruled, run, "approve", "Bea").status_code == 409
    order = start(ruled, run["id"])
    assert order is not None and order.approved == waits["digest"]
    actions = [one["action"] for one in ruled.get("/api/v1/audit", params={"run": "1"}).json()["entries"]]
    assert "approvals.approve" in actions
    kinds = [one["kind"] for one in ruled.get("/api/v1/events").json()["events"]]
    assert kinds == ["started", "approved", "to approve"]


def test_the_plan_that_was_approved_is_the_plan_that_runs(ruled: TestClient) -> None:
    run = submitted(ruled)
    with app_of(ruled).state.sessions.begin() as session:
        stored = session.scalars(sa.select(RunPlan)).one()
        original = stored.plan
        stored.plan = {**original, "pace": {"kind": "real_time", "factor": 2.0}}  # which the digest of the run leaves out
    assert decide(ruled, run, "approve", "Bea").status_code == 409
    with app_of(ruled).state.sessions.begin() as session:
        session.scalars(sa.select(RunPlan)).one().plan = original
    assert decide(ruled, run, "approve", "Bea").status_code == 200
    order = start(ruled, run["id"])
    assert order is not None
    _check_approved(order)
    order.plan["pace"] = {"kind": "real_time", "factor": 2.0}
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


def test_nobody_else_withdraws_a_submission(ruled: TestClient) -> None:
    run = submitted(ruled)
    sweep = ruled.post("/api/v1/sweeps", json={"sweep": SWEEP, "submitted_by": "Ana"}).json()
    for path in (f"runs/{run['id']}/cancel", f"sweeps/{sweep['id']}/cancel"):
        refused = ruled.post(f"/api/v1/{path}", json={"by": "Cem"})
        assert refused.status_code == 409 and "only Ana withdraws it" in refused.json()["detail"], path
    left = ruled.post("/api/v1/queue/cancel", json={"runs": [run["id"]], "by": "Cem"}).json()
    assert left["cancelled"] == [] and "only Ana withdraws it" in left["refused"][0]["reason"]
    assert len(ruled.get("/api/v1/approvals").json()["approvals"]) == 2
    assert ruled.post(f"/api/v1/sweeps/{sweep['id']}/cancel", json={"by": "ana"}).json()["state"] == "cancelled"


def test_nothing_that_the_approver_reads_changes_while_it_waits(ruled: TestClient) -> None:
    run = submitted(ruled)
    for change in ({"name": "harmless"}, {"tags": ["checked"]}, {"notes": "checked by Bea"}, {"archived": True}):
        refused = ruled.patch(f"/api/v1/runs/{run['id']}", json=change)
        assert refused.status_code == 409 and "waits for approval" in refused.json()["detail"], change
    for action in ("tag", "untag", "archive", "delete"):
        given = {"action": action, "runs": [run["id"]], "tags": ["checked"]}
        assert ruled.post("/api/v1/runs/bulk", json=given).json()["changed"] == [], action
    note = {"from_s": 1.0, "text": "checked by Bea"}
    assert ruled.post(f"/api/v1/runs/{run['id']}/annotations", json=note).status_code == 409
    assert ruled.delete(f"/api/v1/runs/{run['id']}").status_code == 409
    assert decide(ruled, run, "approve", "Bea").status_code == 200
    assert ruled.patch(f"/api/v1/runs/{run['id']}", json={"name": "Brace"}).status_code == 200


def test_an_undone_cancel_asks_for_the_approval_that_nobody_gave(client: TestClient) -> None:
    run = submitted(client)
    cancel = f"/api/v1/runs/{run['id']}/cancel"
    undo = f"/api/v1/runs/{run['id']}/undo-cancel"
    assert client.post(cancel, json={"by": "Ana"}).status_code == 200
    assert client.put("/api/v1/rules", json={"approvals": True, "approvers": ["Bea"], "one_driver": False}).status_code == 200
    assert client.post(undo, json={"by": "Bea"}).json()["state"] == "to approve"
    for own in ("Bea", "Ana"):  # who put it back, and who submitted it
        assert decide(client, run, "approve", own).status_code == 403
    assert client.post(cancel, json={"by": "Ana"}).status_code == 200
    assert client.post(undo, json={"by": "Ana"}).json()["state"] == "to approve"
    assert decide(client, run, "approve", "Bea").status_code == 200
    assert start(client, "any turn") is not None


def test_an_approver_reads_the_name_of_the_plan_and_not_one_given_to_the_run_meanwhile(ruled: TestClient) -> None:
    run = submitted(ruled)
    shown = ruled.get("/api/v1/approvals").json()["approvals"][0]["name"]
    assert ruled.post(f"/api/v1/runs/{run['id']}/cancel", json={"by": "Ana"}).status_code == 200
    assert ruled.patch(f"/api/v1/runs/{run['id']}", json={"name": "harmless"}).status_code == 200
    assert ruled.post(f"/api/v1/runs/{run['id']}/undo-cancel", json={"by": "Ana"}).json()["state"] == "to approve"
    assert ruled.get("/api/v1/approvals").json()["approvals"][0]["name"] == shown != "harmless"


def test_an_undo_is_offered_only_where_it_can_be_done(ruled: TestClient) -> None:
    rejected, withdrawn = submitted(ruled), submitted(ruled)
    assert decide(ruled, rejected, "reject", "Bea").status_code == 200
    assert ruled.post(f"/api/v1/runs/{withdrawn['id']}/cancel", json={"by": "Ana"}).status_code == 200
    assert [one["id"] for one in ruled.get("/api/v1/queue").json()["undoable"]] == [withdrawn["id"]]
    until = {one["id"]: ruled.get(f"/api/v1/runs/{one['id']}").json()["undo_until"] for one in (rejected, withdrawn)}
    assert until[rejected["id"]] is None and until[withdrawn["id"]] is not None
    assert ruled.patch(f"/api/v1/runs/{withdrawn['id']}", json={"archived": True}).status_code == 200
    assert ruled.get("/api/v1/queue").json()["undoable"] == []
    assert ruled.get(f"/api/v1/runs/{withdrawn['id']}").json()["undo_until"] is None


def test_what_an_earlier_build_approved_starts(ruled: TestClient) -> None:
    run = submitted(ruled)
    with app_of(ruled).state.sessions.begin() as session:
        session.scalars(sa.select(Approval)).one().digest = run["digest"]
    assert decide(ruled, run, "approve", "Bea").status_code == 200
    order = start(ruled, run["id"])
    assert order is not None and order.approved == run["digest"]
    _check_approved(order)


def test_a_submission_whose_row_is_lost_hides_no_other(ruled: TestClient) -> None:
    run = submitted(ruled)
    with app_of(ruled).state.sessions.begin() as session:
        lost = Approval(about="sweep", about_id="lost", digest="0", asked_by="Ana", asked_at=datetime.now(UTC))
        session.add(lost)
    assert [one["id"] for one in ruled.get("/api/v1/approvals").json()["approvals"]] == [run["id"]]


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
