"""The queue by REST: order, priority, hold, undo, retry, reasons and expected times."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app import db
from app.jobs.service import JobService
from app.jobs.workers import Workers
from app.models import Run
from app.queue.expected import Span, schedule
from app.runs.job import RUNS
from app.runs.order import Outcome
from tests.app.conftest import app_of, plan
from tests.app.test_run_states import SUMMARY


class Lab:
    """The service with runs that are named by a letter, and a worker of two places that beats but takes nothing."""

    def __init__(self, client: TestClient):
        self.client, self.maker = client, app_of(client).state.sessions
        self.ids: dict[str, str] = {}
        with db.unit_of_work(self.maker) as session:
            Workers(session).beat("one", 2)

    def submit(self, names: str, **more: Any) -> None:
        plans = [plan(name=name, seed=ord(name)) for name in names]
        runs = self.post("/runs", plans=plans, submitted_by="Ana", **more)["runs"]
        self.ids |= {run["name"]: run["id"] for run in runs}

    def post(self, path: str, **body: Any) -> Any:
        return self.client.post(f"/api/v1{path}", json=body).raise_for_status().json()

    def refused(self, path: str, **body: Any) -> tuple[int, str]:
        answer = self.client.post(f"/api/v1{path}", json=body)
        return answer.status_code, answer.json()["detail"]

    def queue(self) -> Any:
        return self.client.get("/api/v1/queue").json()

    def line(self) -> str:
        return "".join(one["name"] for one in self.queue()["waiting"])

    def move(self, names: str, **place: str) -> str:
        place = {how: self.ids.get(where, where) for how, where in place.items()}
        self.post("/queue/order", runs=[self.ids[name] for name in names], **place)
        return self.line()

    def start(self, turn: str) -> str:
        with db.unit_of_work(self.maker) as session:
            started = JobService(session, RUNS).start(turn, "one").started
            return started.name if started else ""

    def end(self, name: str, took_s: float = 10.0) -> None:
        with db.unit_of_work(self.maker) as session:
            run = session.scalars(sa.select(Run).where(Run.id == self.ids[name])).one()
            run.started_at = datetime.now(UTC) - timedelta(seconds=took_s)
            assert JobService(session, RUNS).finish(run.id, run.attempt, Outcome(SUMMARY, "0" * 64, 1))


@pytest.fixture
def lab(client: TestClient) -> Lab:
    return Lab(client)


def test_runs_are_moved_alone_and_as_a_block_and_start_in_that_order(lab: Lab) -> None:
    lab.submit("ABCDE")
    assert lab.move("E", before="B") == "AEBCD"
    assert lab.move("A", after="C") == "EBCAD"
    assert lab.move("DC", to="top") == "DCEBA"
    assert lab.move("DC", to="bottom") == "EBADC"
    lab.submit("F")
    assert lab.line() == "EBADCF"
    for _ in range(60):  # more halvings than a double has digits: positions are numbered anew
        lab.move("F", before="B")
        lab.move("A", before="F")
    assert lab.line() == "EAFBDC"
    assert [lab.start(str(turn)) for turn in range(6)] == [*"EAFBDC"]


def test_a_priority_goes_first_and_a_move_takes_that_of_the_neighbour(lab: Lab) -> None:
    lab.submit("ABCD")
    lab.post("/queue/priority", runs=[lab.ids["C"], lab.ids["D"]], priority=2)
    assert lab.line() == "CDAB"
    assert lab.move("B", after="D") == "CDBA"
    assert [one["priority"] for one in lab.queue()["waiting"]] == [2, 2, 2, 0]
    assert lab.move("C", to="bottom") == "DBAC"
    lab.submit("E", priority=1)
    assert lab.line() == "DBEAC"


def test_a_move_that_makes_no_sense_is_refused_with_the_reason(lab: Lab) -> None:
    lab.submit("AB")
    lab.start("1")
    a, b = lab.ids["A"], lab.ids["B"]
    assert lab.refused("/queue/order", runs=[a], to="top") == (
        409,
        "Run 1, A, does not wait in the queue any more: it is running.",
    )
    assert lab.refused("/queue/order", runs=[b], before=b)[0] == 422
    assert "one of 'before', 'after' and 'to'" in lab.refused("/queue/order", runs=[b])[1]
    assert lab.refused("/queue/order", runs=["none"], to="top") == (404, "There is no run none.")
    for value in (3, True, "1", 1.5):
        assert lab.refused("/queue/priority", runs=[b], priority=value)[0] == 422
    found = lab.post("/queue/cancel", runs=[a, b, "none"], by="Bo")
    assert found == {"cancelled": [a, b], "refused": [{"id": "none", "reason": "There is no run none."}]}


def test_the_queue_is_held_with_a_reason_while_tests_go_on(lab: Lab) -> None:
    lab.submit("AB")
    lab.start("1")
    held = lab.post("/queue/hold", by="Ana", reason="oil leak")
    assert (held["held_by"], held["held_reason"], [run["name"] for run in held["running"]]) == ("Ana", "oil leak", ["A"])
    assert [one["waits"] for one in held["waiting"]] == ["queue held by Ana: oil leak"]
    assert held["running"][0]["state"] == "running" and lab.start("2") == ""
    assert lab.post("/queue/release", by="Bo")["held"] is False
    assert lab.start("2") == "B"


def test_each_test_says_why_it_waits(lab: Lab) -> None:
    rig = lab.post("/rigs", name="Shaker", actuators=[{"stroke": 1}] * 2)["id"]
    lab.submit("AB", rig=rig)
    lab.submit("CDEF")
    assert [lab.start("1"), lab.start("2")] == ["A", "C"]
    assert [one["waits"] for one in lab.queue()["waiting"]] == [
        "waits for rig Shaker: run 1 is running", "1 test is before it", "2 tests are before it", "3 tests are before it"
    ]  # fmt: skip
    lab.post("/queue/cancel", runs=[lab.ids["B"]])
    assert lab.queue()["waiting"][0]["waits"] == "waits for a free place: runs 1 and 3 are running"


def test_a_cancel_in_the_queue_is_undone_to_the_same_place(lab: Lab) -> None:
    lab.submit("ABC")
    lab.move("C", before="B")
    lab.post(f"/runs/{lab.ids['C']}/cancel", by="Bo")
    assert lab.line() == "AB"
    back = lab.post(f"/runs/{lab.ids['C']}/undo-cancel", by="Ana")
    assert (back["state"], back["reason"], lab.line()) == ("queued", None, "ACB")
    assert [lab.start(turn) for turn in "1234"] == ["A", "C", "B", ""]
    path = f"/runs/{lab.ids['A']}/undo-cancel"
    assert lab.refused(path) == (409, "The test is running, not cancelled. There is no cancel to undo.")
    with db.unit_of_work(lab.maker) as session:
        run = session.scalars(sa.select(Run).where(Run.name == "A")).one()
        run.cancel_requested_by = "Bo"
        JobService(session, RUNS).finish(run.id, 1, Outcome({**SUMMARY, "status": "cancelled"}, "0" * 64, 1))
    assert "was running when it was cancelled. Retry it" in lab.refused(path)[1]
    lab.submit("D")
    lab.post(f"/runs/{lab.ids['D']}/cancel")
    with db.unit_of_work(lab.maker) as session:
        run = session.scalars(sa.select(Run).where(Run.name == "D")).one()
        run.finished_at = datetime.now(UTC) - timedelta(minutes=11)
    assert "more than 10 minutes old" in lab.refused(f"/runs/{lab.ids['D']}/undo-cancel")[1]


def test_an_ended_run_is_retried_on_its_rig_and_linked_to_the_first(lab: Lab) -> None:
    rig = lab.post("/rigs", name="Shaker", actuators=[{"stroke": 1}] * 2)["id"]
    lab.submit("A", rig=rig)
    path = f"/runs/{lab.ids['A']}/retry"
    assert "has not ended: it is queued" in lab.refused(path)[1]
    lab.start("1")
    lab.end("A")
    again = lab.post(path, by="Bo")
    first = lab.client.get(f"/api/v1/runs/{lab.ids['A']}").json()
    assert (again["retry_of"], again["rig_name"], again["digest"]) == (first["id"], "Shaker", first["digest"])
    assert (again["name"], again["submitted_by"], again["state"]) == ("A", "Bo", "queued")


def test_expected_times_follow_from_the_pace_and_from_earlier_tests(lab: Lab) -> None:
    lab.submit("A")
    waiting = lab.queue()["waiting"][0]
    assert (waiting["expected_s"], waiting["expected_from"]) == (None, "no earlier test alike has ended")
    lab.start("1")
    lab.end("A", took_s=8.0)
    real = {**plan(name="R"), "pace": {"kind": "real_time", "factor": 0.5}}
    same = plan(name="S", seed=ord("A"))
    twice = plan(name="T", duration=4.0)
    lab.post("/runs", plans=[real, same, twice])
    line = lab.queue()["waiting"]
    around = 8.0 - SUMMARY["elapsed_s"]  # what a test took beside its execution
    assert [one["expected_s"] for one in line] == pytest.approx([2.0 / 0.5 + around, 8.0, 16.0], rel=0.02)
    assert [one["expected_from"] for one in line] == [
        "the planned pace", "earlier tests of this plan", "the speed of earlier tests of this size"
    ]  # fmt: skip
    start = datetime.fromisoformat(line[0]["expected_start"])
    ends = [(datetime.fromisoformat(one["expected_end"]) - start).total_seconds() for one in line]
    assert ends == pytest.approx([4 + around, 8.0, 24.0], rel=0.02)  # two places: the third follows the second
    assert lab.queue()["total_s"] == pytest.approx(24.0, rel=0.02)


def test_the_schedule_keeps_a_rig_to_one_test_and_lets_others_pass() -> None:
    spans = schedule(
        [("shaker", 5.0)], [("shaker", 10.0), ("emulated", 3.0), ("emulated", 3.0)], 2, {"shaker": 1, "emulated": None}
    )
    assert spans == [Span(5, 15), Span(0, 3), Span(3, 6)]
    assert schedule([("emulated", None)], [("emulated", 1.0)], 2, {}) == [Span(None, None)]
    assert schedule([], [("emulated", None), ("emulated", 1.0)], 1, {}) == [Span(0, None), Span(None, None)]
