"""Every way that changes what is queued, walked for the three rules: approval, control of a rig, and plans of the library."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import pytest
from fastapi.dependencies.utils import get_dependant
from fastapi.routing import iter_route_contexts
from fastapi.testclient import TestClient
from sqlalchemy import select, update

from app.access import Access, Role, declared
from app.db import unit_of_work
from app.models import EMULATED, Diagnosis
from tests.app.conftest import app_of, plan
from tests.app.test_diagnoses_refusals import PICTURES, queued, recording
from tests.app.test_diagnosis_forms import EARLIER

__all__ = ["recording"]
V1 = "/api/v1"
SERVICES = {f"{name}_service" for name in ("run", "queue", "sweep", "approval", "diagnosis", "table4")} | {"editing"}
"""Dependencies whose services change tests, sweeps or their queue."""
FIELDS = [{"path": "stations.0.compensator.alpha_es", "values": [20, 30]}]
SWEEP = {"name": "Delay", "plan": plan(duration=0.2), "fields": FIELDS}


@dataclass(frozen=True)
class Way:
    """A request that changes something, and what the rules say about it.

    `asks`: it puts a test or a sweep into the queue, so that it asks for approval. `drives`: it needs the control of a rig.
    `told`: keys of its body beside the person; `{waits}`, `{cancelled}` ... in address and body are ids of the laboratory.
    """

    path: str
    told: dict[str, Any] = field(default_factory=dict)
    asks: bool = False
    drives: bool = False
    who: str = "by"


WAYS = {
    ("POST", "/runs"): Way("/runs", {"plan": plan()}, asks=True, drives=True, who="submitted_by"),
    ("POST", "/runs/{run_id}/retry"): Way("/runs/{cancelled}/retry", asks=True, drives=True),
    ("POST", "/runs/{run_id}/undo-cancel"): Way("/runs/{cancelled}/undo-cancel", asks=True, drives=True),
    ("POST", "/sweeps"): Way("/sweeps", {"sweep": SWEEP}, asks=True, who="submitted_by"),
    ("POST", "/sweeps/{sweep_id}/resume"): Way("/sweeps/{sweep}/resume", asks=True),
    ("POST", "/sweeps/{sweep_id}/points/{point}/run"): Way("/sweeps/{sweep}/points/1/run", asks=True, drives=True),
    ("POST", "/diagnoses/{diagnosis_id}/simulations"): Way("/diagnoses/{diagnosis}/simulations", asks=True, drives=True),
    ("POST", "/table4"): Way("/table4", asks=True, drives=True),
    ("POST", "/runs/{run_id}/cancel"): Way("/runs/{waits}/cancel", drives=True),
    ("POST", "/queue/order"): Way("/queue/order", {"runs": ["{last}"], "to": "top"}, drives=True),
    ("POST", "/queue/priority"): Way("/queue/priority", {"runs": ["{last}"], "priority": 2}, drives=True),
    ("POST", "/queue/hold"): Way("/queue/hold", {"reason": "oil"}, drives=True),
    ("POST", "/queue/release"): Way("/queue/release", drives=True),
}
REFUSES_EACH = ("POST", "/queue/cancel")  # it answers 200 with the reason of each run that it leaves
APPROVING = {("POST", f"/approvals/{{about_id}}/{what}") for what in ("approve", "reject")}  # tests/app/test_approvals.py
NEITHER = {
    ("PATCH", "/runs/{run_id}"), ("POST", "/runs/bulk"), ("DELETE", "/runs/{run_id}"), ("POST", "/runs/{run_id}/restore"),
    ("POST", "/runs/{run_id}/annotations"), ("PUT", "/runs/{run_id}/annotations/{annotation_id}"),
    ("DELETE", "/runs/{run_id}/annotations/{annotation_id}"),
    ("POST", "/runs/{run_id}/designsafe/check"), ("POST", "/runs/{run_id}/designsafe.zip"),
    ("POST", "/sweeps/preview"), ("POST", "/sweeps/{sweep_id}/cancel"), ("DELETE", "/sweeps/{sweep_id}"),
    ("POST", "/diagnoses"), ("POST", "/diagnoses/{diagnosis_id}/cancel"), ("DELETE", "/diagnoses/{diagnosis_id}"),
}  # fmt: skip
"""What queues and orders no test: a diagnosis computes; a cancelled sweep moves no rig; a row that is deleted has ended."""


@dataclass
class Laboratory:
    """A control room with two tests that wait, one that was cancelled, a cancelled sweep, and a diagnosis with its plan."""

    client: TestClient
    ids: dict[str, str]

    def send(self, way: Way, by: str) -> Any:
        body = {**way.told, way.who: by}
        given = {name: [one.format_map(self.ids) for one in value] if name == "runs" else value for name, value in body.items()}
        return self.client.post(V1 + way.path.format_map(self.ids), json=given)

    def rules(self, **changed: Any) -> None:
        every = {"approvals": False, "one_driver": False, "approvers": [], **changed}
        assert self.client.put(f"{V1}/rules", json=every).status_code == 200

    def waiting(self) -> list[tuple[str, int]]:
        return [(one["id"], one["priority"]) for one in self.client.get(f"{V1}/queue").json()["waiting"]]


@pytest.fixture
def laboratory(client: TestClient, recording: str) -> Laboratory:
    """Everything was submitted before any rule was switched on."""
    runs = [client.post(f"{V1}/runs", json={"plan": plan(), "submitted_by": "Ana"}).json()["runs"][0]["id"] for _ in range(3)]
    sweep = client.post(f"{V1}/sweeps", json={"sweep": SWEEP, "submitted_by": "Ana"}).json()["id"]
    for path in (f"runs/{runs[1]}/cancel", f"sweeps/{sweep}/cancel"):
        assert client.post(f"{V1}/{path}", json={"by": "Ana"}).status_code == 200
    diagnosis = queued(client, recording)["id"]
    with unit_of_work(app_of(client).state.sessions) as session:
        extended = {**EARLIER, "extended_plan": session.scalar(select(Diagnosis.plan).where(Diagnosis.id == diagnosis))}
        session.execute(update(Diagnosis).where(Diagnosis.id == diagnosis).values(verdict=extended, pictures=PICTURES))
    ids = {"waits": runs[0], "cancelled": runs[1], "last": runs[2], "sweep": sweep, "diagnosis": diagnosis}
    return Laboratory(client, ids)


def routes(client: TestClient) -> Iterator[tuple[tuple[str, str], Access | None]]:
    """Every route with a changing method and a service that changes tests, sweeps or their queue."""
    for route in iter_route_contexts(app_of(client).routes):
        methods = set(route.methods or ()) - {"GET", "HEAD", "OPTIONS"}
        if route.endpoint and methods and SERVICES & set(_calls(get_dependant(path=route.path or "", call=route.endpoint))):
            for method in methods:
                yield (method, str(route.path).removeprefix(V1)), declared(route.endpoint)


def _calls(needed: Any) -> Iterator[str]:
    yield getattr(needed.call, "__name__", "")
    for one in needed.dependencies:
        yield from _calls(one)


def test_every_route_that_could_queue_or_order_a_test_says_which_rules_hold_for_it(serving: TestClient) -> None:
    assert {way for way, _ in routes(serving)} == {*WAYS, REFUSES_EACH, *APPROVING, *NEITHER}


def test_every_way_into_the_queue_asks_for_approval(laboratory: Laboratory, monkeypatch: pytest.MonkeyPatch) -> None:
    laboratory.rules(approvals=True)
    turns: list[str] = []
    monkeypatch.setattr(app_of(laboratory.client).state.queue, "enqueue", lambda session, kind, ids: turns.extend(ids))
    before = laboratory.waiting()
    for way in (one for one in WAYS.values() if one.asks):
        asked = len(laboratory.client.get(f"{V1}/approvals").json()["approvals"])
        answer = laboratory.send(way, "Ana")
        assert answer.is_success, (way.path, answer.text)
        assert len(laboratory.client.get(f"{V1}/approvals").json()["approvals"]) > asked, way.path
        assert laboratory.waiting() == before and not turns, way.path


def test_only_who_drives_the_rig_queues_orders_and_stops_its_tests(laboratory: Laboratory) -> None:
    laboratory.rules(one_driver=True)
    assert laboratory.client.post(f"{V1}/control/{EMULATED}/take", json={"by": "Ana"}).status_code == 200
    before = laboratory.waiting()
    for way in (one for one in WAYS.values() if one.drives):
        refused = laboratory.send(way, "Bea")
        assert refused.status_code == 409 and "Ana drives Emulated laboratory" in refused.json()["detail"], way.path
    left = laboratory.send(Way("/queue/cancel", {"runs": ["{waits}", "{last}"]}), "Bea").json()
    assert left["cancelled"] == [] and all("Ana drives" in one["reason"] for one in left["refused"])
    assert laboratory.waiting() == before and not laboratory.client.get(f"{V1}/queue").json()["held"]
    for way in (one for one in WAYS.values() if one.drives and not one.asks):
        assert laboratory.send(way, "Ana").status_code == 200, way.path


def test_an_operator_queues_only_what_is_in_the_library_or_was_queued_before(serving: TestClient) -> None:
    """`POST /runs` compares with the library (test_credentials.py); retry and undo queue the plan of a run as it is stored."""
    roles = {way: access.who for way, access in routes(serving) if access}
    allowed = {way for way, role in roles.items() if isinstance(role, Role) and role <= Role.OPERATOR}
    assert {way for way in allowed & WAYS.keys() if WAYS[way].asks} == {
        ("POST", "/runs"),
        ("POST", "/runs/{run_id}/retry"),
        ("POST", "/runs/{run_id}/undo-cancel"),
    }
