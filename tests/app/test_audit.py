"""The audit log: what is recorded, that it is one chain, and that a broken chain is found."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.routing import APIRoute
from fastapi.testclient import TestClient
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.accounts import keys
from app.accounts.service import AccountService
from app.audit import actions, given
from app.audit.chain import EMPTY, Head, canonical
from app.audit.check import check
from app.audit.log import Acting, AuditLog, acts
from app.audit.recorder import MOST_REFUSALS, SAME_S, Recorder, Waiting
from app.audit.tables import AuditEntry, AuditHead
from app.cli.main import main
from app.config import Settings
from app.events.log import EventLog
from app.events.tables import EventKind
from app.main import create_app
from tests.app.conftest import ADDRESS, HERE, app_of, plan

ANA = Acting("Ana", "engineer", "password")


@pytest.fixture
def maker(settings: Settings) -> Iterator[sessionmaker[Session]]:
    engine = db.connect(settings.url)
    yield db.sessions(engine)
    engine.dispose()


def filled(maker: sessionmaker[Session], count: int = 5) -> None:
    for number in range(count):
        with db.unit_of_work(maker) as session:
            AuditLog(session).add(
                ANA, "runs.submit", f"run:{number}", {"ü": number, "share": 0.1, "deep": [{"b": 1, "a": None}]}
            )


def stored(maker: sessionmaker[Session]) -> list[AuditEntry]:
    with maker() as session:
        return list(session.scalars(sa.select(AuditEntry).order_by(AuditEntry.number)))


def asked(client: TestClient, **query: Any) -> list[dict[str, Any]]:
    """The entries of the list, once the recorder has stored all that waited."""
    recorder: Recorder = app_of(client).state.audit
    recorder.waiting.join()
    found: list[dict[str, Any]] = client.get("/api/v1/audit", params=query).json()["entries"]
    return found


def test_entries_make_one_chain_from_the_first_on(maker: sessionmaker[Session]) -> None:
    filled(maker)
    found = stored(maker)
    assert [one.number for one in found] == [1, 2, 3, 4, 5]
    assert found[0].previous == EMPTY.hash and [one.previous for one in found[1:]] == [one.hash for one in found[:-1]]
    with maker() as session:
        log = AuditLog(session)
        assert log.head() == Head(5, found[-1].hash)
        assert check(log)._asdict() == {"entries": 5, "head": log.head(), "broken": None}


def test_an_entry_is_stored_with_its_transaction_or_not_at_all(maker: sessionmaker[Session]) -> None:
    with pytest.raises(ZeroDivisionError), db.unit_of_work(maker) as session:
        AuditLog(session).add(ANA, "runs.submit")
        raise ZeroDivisionError
    assert stored(maker) == []
    filled(maker, 1)
    assert [one.number for one in stored(maker)] == [1]


@pytest.mark.parametrize("change", ["update audit_entry set who = 'Bea' where number = 2", "delete from audit_entry"])
def test_the_database_refuses_to_change_or_delete_an_entry(maker: sessionmaker[Session], change: str) -> None:
    filled(maker)
    with pytest.raises(sa.exc.IntegrityError, match="append-only"), db.unit_of_work(maker) as session:
        session.execute(sa.text(change))
    assert [one.who for one in stored(maker)] == ["Ana"] * 5


def without_triggers(maker: sessionmaker[Session], *changes: str) -> None:
    """Change the table as somebody who owns the database can."""
    with db.unit_of_work(maker) as session:
        for name in ("update", "delete"):
            session.execute(sa.text(f"drop trigger if exists audit_entry_no_{name}"))
        for change in changes:
            session.execute(sa.text(change))


@pytest.mark.parametrize(
    ("change", "number", "problem"),
    [
        ("update audit_entry set who = 'Bea' where number = 3", 3, "was changed"),
        ("update audit_entry set details = '{}' where number = 1", 1, "was changed"),
        ("update audit_entry set at = '2020-01-01 00:00:00.000000' where number = 4", 4, "was changed"),
        ("delete from audit_entry where number = 2", 2, "is missing"),
        ("delete from audit_entry where number = 1", 1, "is missing"),
        ("delete from audit_entry where number > 3", 4, "is missing"),
        ("update audit_entry set previous = hash where number = 5", 5, "does not follow"),
        ("update audit_head set hash = 'f' where id = 1", 5, "another hash than the head"),
    ],
)
def test_the_first_broken_entry_is_named(maker: sessionmaker[Session], change: str, number: int, problem: str) -> None:
    filled(maker)
    without_triggers(maker, change)
    with maker() as session:
        broken = check(AuditLog(session)).broken
    assert broken is not None and broken.number == number and problem in broken.problem


def test_a_tail_that_was_cut_off_with_its_head_is_found_by_a_head_that_was_noted(maker: sessionmaker[Session]) -> None:
    filled(maker)
    with maker() as session:
        noted = AuditLog(session).head()
    cut = "update audit_head set number = 3, hash = (select hash from audit_entry where number = 3)"
    without_triggers(maker, "delete from audit_entry where number > 3", cut)
    with maker() as session:
        log = AuditLog(session)
        assert check(log).broken is None
        broken = check(log, noted).broken
        assert broken is not None and broken.number == 5 and "was noted" in broken.problem
        assert check(log, Head(2, "0" * 64)).broken is not None


def write_from_threads(maker: sessionmaker[Session], threads: int = 5, each: int = 4) -> None:
    def write(name: str) -> None:
        for number in range(each):
            with db.unit_of_work(maker) as session:
                EventLog(session).add(EventKind.HELD, f"{name} {number}", "queue")
                AuditLog(session).add(Acting(name), "queue.hold", details={"number": number})

    writers = [threading.Thread(target=write, args=(f"writer {n}",)) for n in range(threads)]
    for one in writers:
        one.start()
    for one in writers:
        one.join()
    with maker() as session:
        found = check(AuditLog(session))
    assert found.broken is None and found.entries == 2 * threads * each


def test_concurrent_writers_make_one_chain(maker: sessionmaker[Session]) -> None:
    write_from_threads(maker)


def test_postgresql_keeps_one_chain_of_concurrent_writers_and_refuses_changes(database: str) -> None:
    db.migrate(database)
    engine = db.connect(database)
    maker = db.sessions(engine)
    write_from_threads(maker)
    for change in ("update audit_entry set who = 'Bea'", "delete from audit_entry", "truncate audit_entry"):
        with pytest.raises(sa.exc.DatabaseError, match="append-only"), db.unit_of_work(maker) as session:
            session.execute(sa.text(change))
    engine.dispose()


def test_a_request_that_changes_something_is_recorded_in_its_transaction(client: TestClient) -> None:
    run = client.post("/api/v1/runs", json={"plan": plan(), "submitted_by": "Ana"}).json()["runs"][0]
    client.post(f"/api/v1/runs/{run['id']}/cancel", json={"by": "Bea"})
    cancelled, submitted = asked(client, action="runs.")
    assert (submitted["who"], submitted["action"], submitted["about"]) == ("Ana", "runs.submit", "")
    assert submitted["details"]["made"] == [
        {"is": f"run:{run['id']}", "number": 1, "digest": run["digest"], "submitted_by": "Ana"}
    ]
    assert (submitted["role"], submitted["signed_in"]) == ("administrator", "local")
    assert (cancelled["who"], cancelled["action"], cancelled["about"]) == ("Bea", "runs.cancel", f"run:{run['id']}")
    assert cancelled["run"] == {"id": run["id"], "number": 1, "name": run["name"]}
    of_run = asked(client, run="1")
    assert [one["action"] for one in of_run] == ["runs.cancel", "runs.submit"] and of_run == asked(client, run=run["id"])
    assert [one["number"] for one in asked(client, who="bea")] == [cancelled["number"]]


def test_refused_requests_and_calculations_leave_no_change(client: TestClient) -> None:
    client.post("/api/v1/runs", json={"plans": []})
    client.post("/api/v1/runs/nowhere/cancel")
    client.post("/api/v1/plans/write", json={})
    client.get("/api/v1/runs")
    assert [one["action"] for one in asked(client)] == ["service.started"]


def test_changes_of_files_are_recorded_after_their_answer(client: TestClient) -> None:
    client.put("/api/v1/laboratory", json={"name": "Laboratory", "address": "", "signatures": []})
    entry = asked(client)[0]
    assert (entry["action"], entry["details"]["path"]) == ("laboratory.save", "/api/v1/laboratory")


def test_abort_is_recorded(client: TestClient) -> None:
    assert client.post("/api/v1/abort", json={"by": "Ana"}).status_code == 200
    assert "Ana" in {one["who"] for one in asked(client, action="abort")}


def test_what_a_worker_does_is_recorded_with_its_event(maker: sessionmaker[Session]) -> None:
    acts(maker, Acting("worker-1", "worker"))
    with db.unit_of_work(maker) as session:
        EventLog(session).add(EventKind.STARTED, "Run 7: Started.", "run", "the-id", "damper")
    (entry,) = stored(maker)
    assert (entry.who, entry.role, entry.action, entry.about) == ("worker-1", "worker", "run.started", "run:the-id")


def test_a_refusal_is_recorded_but_not_a_page_that_reads_without_signing_in(settings: Settings) -> None:
    settings = replace(settings, local_sign_in=False)
    with TestClient(create_app(settings), ADDRESS, client=HERE) as client:
        assert client.post("/api/v1/queue/hold", json={"by": "Ana"}).status_code == 401
        assert client.get("/api/v1/runs").status_code == 401
        assert client.get("/api/v1/queue", headers={"Authorization": "Bearer wrong"}).status_code == 401
        app_of(client).state.audit.waiting.join()
        with app_of(client).state.sessions() as session:
            refused = [one for one in session.scalars(sa.select(AuditEntry)) if one.action.startswith("refused")]
    assert [(one.action, one.who, json.loads(one.details)["method"]) for one in refused] == [
        ("refused.queue", "", "POST"),
        ("refused.queue", "", "GET"),
    ]


def test_secrets_never_reach_the_log(client: TestClient) -> None:
    client.post("/api/v1/webhooks", json={"url": "http://127.0.0.1:9/hush", "secret": "hush", "by": "Ana"})
    assert asked(client, action="webhooks")[0]["details"]["given"] == {"by": "Ana"}
    with app_of(client).state.sessions() as session:
        assert not [one for one in session.scalars(sa.select(AuditEntry)) if "hush" in one.details]


def test_a_key_in_an_address_never_reaches_the_log(client: TestClient) -> None:
    key, token = keys.new_key(), keys.new_key(keys.PREFIX)
    stranger = TestClient(app_of(client), ADDRESS, client=("192.0.2.7", 1))
    for path in (
        f"/x/{token}",
        f"/sign-in/link/{key}",
        f"/api/v1/{token}",
        f"/api/v1/runs/{token}/cancel",
        f"/api/v1/rigs/{key}",
    ):
        assert stranger.post(path).status_code in {401, 405}
        client.delete(path)
    client.post(f"/api/v1/control/{token}/release", json={})
    found = asked(client, action="refused")
    assert {one["details"]["path"] for one in found} == {
        "unknown address",
        "/api/v1/runs/left out/cancel",
        "/api/v1/rigs/left out",
    }
    assert {one["action"] for one in found} == {"refused.unknown", "refused.runs", "refused.rigs"}
    with app_of(client).state.sessions() as session:
        for one in session.scalars(sa.select(AuditEntry)):
            assert (
                key not in f"{one.details} {one.about} {one.action}"
                and token[9:] not in f"{one.details} {one.about} {one.action}"
            )


def test_a_request_that_changed_no_row_says_so_and_a_link_that_is_looked_at_is_not_recorded(client: TestClient) -> None:
    run = client.post("/api/v1/runs", json={"plan": plan(), "submitted_by": "Ana"}).json()["runs"][0]["id"]
    for runs in (["none"], [run]):
        client.post("/api/v1/runs/bulk", json={"action": "tag", "tags": ["damper"], "runs": runs}).raise_for_status()
    done, nothing = asked(client, action="runs.bulk")
    assert nothing["details"]["rows_changed"] == 0 and "rows_changed" not in done["details"]
    assert all("rows_changed" not in one["details"] for one in asked(client, action="runs.submit"))
    for path, body in (("cancel", {"runs": [run]}), ("cancel", {"runs": [run]}), ("release", {})):
        client.post(f"/api/v1/queue/{path}", json=body).raise_for_status()
    again, cancelled = asked(client, action="queue.cancel")
    (released,) = asked(client, action="queue.release")  # the queue was not held
    assert "rows_changed" not in cancelled["details"]
    assert again["details"]["rows_changed"] == released["details"]["rows_changed"] == 0
    with db.unit_of_work(app_of(client).state.sessions) as session:
        key = AccountService(session).link()[0].partition("#")[2]
    assert client.post("/api/v1/sign-in/link/read", json={"key": key}).status_code == 200
    assert not asked(client, action="sign-in")


@pytest.mark.parametrize(
    ("area", "body", "kept"),
    [
        ("queue", {"by": "Ana", "reason": "oil"}, {"by": "Ana", "reason": "oil"}),
        (
            "queue",
            {"password": "x", "deep": [{"api_token": "x", "a": 1}]},
            {"password": "left out", "deep": [{"api_token": "left out", "a": 1}]},
        ),
        ("accounts", {"name": "ana", "role": "viewer", "anything": "x"}, {"name": "ana", "role": "viewer"}),
        ("unknown", {"note": "x"}, {}),
        ("runs", {"notes": "n" * 400}, {"notes": "n" * 300 + "…"}),
    ],
)
def test_the_kept_part_of_a_request(area: str, body: dict[str, Any], kept: dict[str, Any]) -> None:
    assert given.kept(area, json.dumps(body).encode()) == kept


def test_a_large_body_is_kept_as_its_checksum(client: TestClient) -> None:
    large = given.kept("runs", json.dumps({"by": "Ana", "plans": ["x" * 90] * 100}).encode())
    assert large["by"] == "Ana" and large["fields"] == ["by", "plans"] and len(large["sha256"]) == 64
    assert set(given.kept("runs", b"[" * 100_000)) == {"bytes", "sha256"}
    assert given.kept("accounts", b"x" * 100) == {}


def test_equal_refusals_within_a_minute_make_one_entry(client: TestClient) -> None:
    recorder: Recorder = app_of(client).state.audit
    for address in ("10.0.0.1", "10.0.0.2"):
        for _ in range(3):
            recorder.refused(Waiting(Acting("", ""), "refused.sessions.sign_in", details={"address": address}))
    assert [one["details"]["address"] for one in asked(client, action="refused")] == ["10.0.0.2", "10.0.0.1"]


def api_routes(router: Any) -> Iterator[APIRoute]:
    for route in router.routes:
        inner = getattr(route, "original_router", None)
        if inner is not None:
            yield from api_routes(inner)
        elif isinstance(route, APIRoute):
            yield route


def test_every_recorded_action_has_a_name_of_its_own(client: TestClient) -> None:
    routes = list(api_routes(app_of(client)))
    paths = {route.path for route in routes if "POST" in (route.methods or ())}
    assert paths >= actions.CALCULATIONS
    changing = [(route, method) for route in routes for method in route.methods or () if actions.changes(method, route)]
    named = [actions.action(route, route.path) for route, _ in changing if route.path.startswith(actions.PREFIX)]
    assert len(set(named)) == len(named) > 40
    assert {"runs.submit", "runs.cancel", "queue.hold", "abort"} <= set(named)


def test_the_command_line_checks_exports_and_is_recorded(
    settings: Settings, maker: sessionmaker[Session], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    filled(maker, 2)
    data = ["--data", str(settings.data)]
    assert main(["migrate", *data]) == 0
    assert [one.action for one in stored(maker)] == ["runs.submit", "runs.submit", "rths migrate"]
    capsys.readouterr()
    assert main(["audit", "head", *data]) == 0
    head = capsys.readouterr().out.strip()
    assert main(["audit", "check", "--head", head, *data]) == 0
    assert "3 entries" in capsys.readouterr().out
    assert main(["audit", "export", "--out", str(tmp_path / "audit.jsonl"), *data]) == 0
    assert len((tmp_path / "audit.jsonl").read_text(encoding="utf-8").splitlines()) == 3
    without_triggers(maker, "update audit_entry set action = 'x' where number = 2")
    assert main(["audit", "check", *data]) == 1
    assert "entry 2 was changed" in capsys.readouterr().out


def test_canonical_json_has_no_number_that_programs_write_differently() -> None:
    assert canonical({"b": 0.1, "a": [1e-7, True, None, 10**20]}) == '{"a":["1e-07",true,null,100000000000000000000],"b":"0.1"}'


def test_the_recorder_waits_for_a_database_that_does_not_answer(client: TestClient, maker: sessionmaker[Session]) -> None:
    asked(client)
    recorder: Recorder = app_of(client).state.audit
    with maker() as other, other.begin():
        other.execute(sa.update(AuditHead).values(number=AuditHead.number))  # holds the only write lock of SQLite
        recorder.put(Waiting(ANA, "abort"))
        assert client.get("/api/v1/runs").status_code == 200
    assert asked(client)[0]["action"] == "abort"


def test_refusals_of_strangers_never_hide_those_of_a_person_and_are_counted(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    recorder: Recorder = app_of(client).state.audit
    now = 1000.0
    monkeypatch.setattr("app.audit.recorder.time", SimpleNamespace(monotonic=lambda: now, sleep=lambda _: None))
    for number in range(2 * MOST_REFUSALS):
        recorder.refused(Waiting(Acting("", ""), f"refused.made-up-{number}"))
    recorder.refused(Waiting(Acting("Vera Viewer", "viewer"), "refused.queue"))
    now += SAME_S
    recorder.refused(Waiting(Acting("Vera Viewer", "viewer"), "refused.queue"))
    assert len(recorder._refusals) == 1
    told = asked(client, action="refused", limit=500)
    assert [one["who"] for one in told].count("Vera Viewer") == 2
    assert [one["details"] for one in told if "others_later" in one["details"]] == [{"others_later": MOST_REFUSALS - 1}]
