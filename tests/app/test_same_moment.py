"""Two requests that change the same rows at the same moment: the later one is refused in words, and never fails.

Each changing route is sent, and just before its first write another request is answered as a whole: the same one again, or
the one that deletes its row. SQLite gives no lock before the first write, so that the first request has read earlier rows.
"""

from __future__ import annotations

import json
import logging
import uuid
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

import pytest
import sqlalchemy as sa
from argon2 import PasswordHasher
from fastapi import APIRouter
from fastapi.testclient import TestClient
from pydantic import BaseModel

from app import logs
from app.access import Role, allowed
from app.accounts import passwords
from app.accounts.service import AccountService
from app.accounts.throttle import Throttle
from app.calculations.orders import Here
from app.config import Settings
from app.db import unit_of_work
from app.dependencies import OneSession
from app.main import create_app
from app.models import Approval, Diagnosis, DiagnosisInput, MeasuredRecording, RunView, SavedMapping, Sweep
from app.observing import HEADER
from app.openapi_examples import MAPPING, RECORDING, REQUESTS, RUN, SHA256, WAITING
from app.sweeps.service import digest
from tests.app.conftest import ADDRESS, HERE, app_of, plan, unpack_earlier
from tests.app.people import PASSWORD, V1, sign_in
from tests.app.test_openapi import ROUTES, held

FIRST = "the-first-of-two"  # its X-Request-ID
UNKNOWN = "0" * 64  # the digest in an example
COMPUTES = {
    f"POST {V1}/{path}"
    for path in (
        "plans/check", "plans/drive", "plans/read", "plans/write", "plans/preflight", "plans/identify", "stability",
        "sweeps/preview", "sweeps/fields", "motions/preview", "motions/contents", "recordings/preview",
        "runs/{run_id}/designsafe/check", "runs/{run_id}/designsafe.zip", "sign-in/link/read",
    )
}  # fmt: skip
ANNOTATION = f"{V1}/runs/{{run_id}}/annotations/{{annotation_id}}"
FILES = {
    *(f"POST {V1}/{path}" for path in ("motions", "recordings/files", "recordings/batches")),
    *(f"{method} {V1}/laboratory/logo" for method in ("PUT", "DELETE")),
    f"DELETE {V1}/motions/{{name}}",
}
"""What changes files of the store: test_equal_uploads.py."""
WRITE_NO_ROWS = {f"POST {V1}/abort", f"PUT {V1}/laboratory", f"POST {V1}/sign-in", f"POST {V1}/account/password"}
"""As their examples are sent here: the latch, a file, and passwords that are refused."""
CHANGING = [one for one in ROUTES if not one.startswith("GET ") and one not in COMPUTES | FILES]


def rivals(route: str) -> list[str]:
    """The requests that come between the reading and the writing of another: itself, and what deletes its row."""
    _, path = route.split(" ")
    row = path[: path.rfind("}") + 1]
    return [route, *(one for one in CHANGING if row and one == f"DELETE {row}" and one != route)]


PAIRS = [(route, rival) for route in CHANGING for rival in rivals(route)]


@dataclass
class Laboratory:
    """A control room with rows of every kind, and an administrator who is signed in."""

    client: TestClient
    recorded: str = ""  # a run with a recording
    rows: dict[str, str] = field(default_factory=dict)  # of a route, by the name in its address
    shown: dict[str, str] = field(default_factory=dict)  # by the id in an example, one of this laboratory
    fresh: str = ""  # part of the names that a request gives

    def post(self, path: str, **given: Any) -> Any:
        answer = self.client.post(V1 + path, json=given)
        assert answer.is_success, answer.text
        return answer.json()

    def copied(self, table: Any, *where: Any, **changed: Any) -> str:
        """The id of a new row with the columns of one that is there."""
        with unit_of_work(app_of(self.client).state.sessions) as session:
            row = session.scalars(sa.select(table).where(*where).limit(1)).one()
            columns = [one.key for one in sa.inspect(table).column_attrs if one.key not in {"number", "id"}]
            new = table(id=str(uuid.uuid4()), **{**{one: getattr(row, one) for one in columns}, **changed})
            session.add(new)
            return str(new.id)

    def prepare(self, route: str) -> None:
        """New rows for the names in the address of a route and in its example."""
        makers: dict[str, Callable[[], str]] = {
            "run_id": lambda: self._run(route),
            "about_id": self._asked,
            "annotation_id": lambda: self.post(f"/runs/{self.rows['run_id']}/annotations", from_s=0.1, text="noise")["id"],
            "sweep_id": lambda: self.copied(Sweep),
            "point": lambda: "1",
            "rig_id": lambda: self.post("/rigs", name=str(uuid.uuid4()), kind="emulated", actuators=[])["id"],
            "webhook_id": lambda: self.post("/webhooks", url="http://127.0.0.1:9/rths", kinds=["failed"])["id"],
            "view_id": lambda: str(self.post("/runs/views", name=str(uuid.uuid4()), query="q=1")["id"]),
            "plan_id": lambda: self.post("/library/plans", plan=plan(), name=str(uuid.uuid4()))["id"],
            "draft_id": self._draft,
            "mapping_id": self._mapping,
            "diagnosis_id": self._diagnosis,
            "recording_id": lambda: self.copied(MeasuredRecording),
            "account_id": lambda: self._account(route),
            "session_id": self._session,
            "token_id": self._token,
        }
        self.rows, self.fresh = {}, uuid.uuid4().hex[:8]
        for name in [part.partition("}")[0] for part in route.split("{")[1:]]:
            self.rows[name] = makers[name]()
        if any(one in json.dumps(REQUESTS.get(route, dict)()) for one in (RUN, WAITING)):
            self.shown[RUN] = self.shown[WAITING] = self._run(route)

    def send(self, route: str, **headers: str) -> Any:
        """The answer to the example of a route about the present rows."""
        method, path = route.split(" ")
        body = REQUESTS.get(route, lambda: None)()
        if isinstance(body, dict) and "name" in body and "sign-in" not in path:
            body = {**body, "name": f"{body['name']} {self.fresh}"}
        content = body if isinstance(body, str) else json.dumps(body)
        for shown, own in self.shown.items():
            content = content.replace(shown, own)
        kind = "application/yaml" if isinstance(body, str) else "application/json"
        return self.client.request(
            method,
            path.format_map(self.rows),
            content=content.encode() if body is not None else None,
            headers={**headers, **({"content-type": kind} if body is not None else {})},
        )

    def together(self, route: str, rival: str) -> list[Any]:
        """The answers to a request about new rows and, where it writes, to a rival that came just before its first write."""
        app_of(self.client).state.throttle = Throttle()
        if not self.client.get(f"{V1}/account").is_success:
            assert sign_in(self.client, "Ada").status_code == 204
        self.prepare(route)
        with just_before_the_first_write(self.client, lambda: self.send(rival)) as answered:
            first = self.send(route, **{HEADER: FIRST})
        return [first, *answered]

    def _run(self, route: str) -> str:
        if "annotations" in route or route.endswith("/diagnoses"):
            return self.recorded
        run: str = self.post("/runs", plan=plan())["runs"][0]["id"]
        if route.endswith(("undo-cancel", "retry", "restore")) or route.startswith(("DELETE", "PATCH")):
            self.post(f"/runs/{run}/cancel")
        return run

    def _draft(self) -> str:
        draft = str(uuid.uuid4())
        assert self.client.put(f"{V1}/library/drafts/{draft}", json={"plan": plan(), "revision": 0}).is_success
        return draft

    def _mapping(self) -> str:
        made = {"id": str(uuid.uuid4()), "name": str(uuid.uuid4()), "layout": "0" * 64, "format": "CSV", "columns": []}
        with unit_of_work(app_of(self.client).state.sessions) as session:
            session.add(SavedMapping(**made, mapping=MAPPING, saved_by="Ada", saved_at=datetime.now(UTC)))
        return str(made["id"])

    def _asked(self) -> str:
        sweep = self.copied(Sweep, to_approve=True, submitted_by="Bea")
        with unit_of_work(app_of(self.client).state.sessions) as session:
            self.shown[UNKNOWN] = digest(session.scalars(sa.select(Sweep).where(Sweep.id == sweep)).one())
            asked = {"about": "sweep", "about_id": sweep, "digest": self.shown[UNKNOWN], "asked_by": "Bea"}
            session.add(Approval(**asked, asked_at=datetime.now(UTC)))
        return sweep

    def _diagnosis(self) -> str:
        made = self.copied(Diagnosis, Diagnosis.verdict.is_not(None))
        with unit_of_work(app_of(self.client).state.sessions) as session:
            number = session.scalars(sa.select(Diagnosis.number).where(Diagnosis.id == made)).one()
            session.add(DiagnosisInput(diagnosis_number=number, place=0, name="Brace", run_id=self.recorded))
        return made

    def _account(self, route: str) -> str:
        accounts = self.client.get(f"{V1}/accounts").json()["accounts"]
        if "token_id" in route:
            return str(next(one["id"] for one in accounts if one["name"] == "Ada"))
        self.post("/accounts", name=f"Ana {uuid.uuid4().hex}"[:40], role="viewer")
        return str(self.client.get(f"{V1}/accounts").json()["accounts"][-1]["id"])

    def _session(self) -> str:
        other = TestClient(app_of(self.client), ADDRESS, client=HERE, raise_server_exceptions=False)
        assert sign_in(other, "Ada").status_code == 204
        sessions = self.client.get(f"{V1}/account/sessions").json()["sessions"]
        return str(next(one["id"] for one in sessions if not one["present"]))

    def _token(self) -> str:
        return str(self.post("/account/tokens", name="sweeps", scopes=["read"], days=1)["id"])


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Laboratory]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(passwords, "HASHER", PasswordHasher(time_cost=1, memory_cost=8, parallelism=1))
        settings = Settings(data=unpack_earlier(tmp_path_factory.mktemp("moment")), embedded_worker=False)
        patch.setattr("app.calculations.answer.Calculator", lambda _: Here())
        app = create_app(settings)
        with TestClient(app, ADDRESS, client=HERE, raise_server_exceptions=False) as client:
            with unit_of_work(app_of(client).state.sessions) as session:
                AccountService(session).add("Ada", Role.ADMINISTRATOR, PASSWORD)
            assert sign_in(client, "Ada").status_code == 204
            run = next(one for one in client.get(f"{V1}/runs").json()["runs"] if one["name"] == "Damper with play")
            recording = client.get(f"{V1}/recordings").json()["recordings"][0]
            assert client.post(f"{V1}/sweeps", json=REQUESTS[f"POST {V1}/sweeps"]()).status_code == 201
            yield Laboratory(client, run["id"], shown={RECORDING: recording["id"], SHA256: recording["raw_sha256"]})


@contextmanager
def just_before_the_first_write(client: TestClient, act: Callable[[], Any]) -> Iterator[list[Any]]:
    """Do something when the request FIRST has read and is about to write; gives what came of it."""
    engine = app_of(client).state.sessions.kw["bind"]
    done: list[Any] = []

    def writes(_: Any, __: Any, statement: str, *___: Any) -> None:
        of_first = logs.fields(logging.makeLogRecord({})).get("request_id") == FIRST
        if of_first and not done and statement.lstrip()[:6].upper() in {"INSERT", "UPDATE", "DELETE"}:
            done.append(None)
            done[0] = act()

    sa.event.listen(engine, "before_cursor_execute", writes)
    try:
        yield done
    finally:
        sa.event.remove(engine, "before_cursor_execute", writes)


@pytest.mark.parametrize(("route", "rival"), PAIRS, ids=[f"{route} beside {rival}" for route, rival in PAIRS])
def test_a_change_of_rows_that_another_request_changed_first_is_no_server_error(
    laboratory: Laboratory, route: str, rival: str
) -> None:
    first, *answered = laboratory.together(route, rival)
    assert answered or route in WRITE_NO_ROWS
    for one, answer in ((route, first), *((rival, answer) for answer in answered)):
        assert answer.status_code < 500, answer.text
        held(one, answer)


class Saved(BaseModel):
    number: int


@pytest.mark.parametrize(
    ("names", "status"), [(["Damper", "Damper"], 409), ([None], 500)], ids=["a name that is taken", "a name that is missing"]
)
def test_only_rows_that_another_request_changed_are_a_conflict_and_the_log_says_where(
    settings: Settings, names: list[str | None], status: int, caplog: pytest.LogCaptureFixture
) -> None:
    app, router = create_app(settings), APIRouter()

    @router.post("/views")
    @allowed(Role.VIEWER)
    def views(session: OneSession) -> Saved:
        for name in names:
            session.add(RunView(name=name, query="", saved_by="Ana", saved_at=datetime.now(UTC)))
        session.flush()
        return Saved(number=len(names))

    app.include_router(router)
    with TestClient(app, ADDRESS, client=HERE, raise_server_exceptions=False) as client:
        answer = client.post("/views")
    assert answer.status_code == status
    (told,) = [one for one in caplog.records if one.exc_info and one.levelno >= logging.WARNING]
    assert told.levelno == (logging.WARNING if status == 409 else logging.ERROR)
    assert status == 500 or "by somebody else at the same moment" in answer.json()["detail"]


def test_each_of_two_people_gets_the_answer_that_fits(laboratory: Laboratory) -> None:
    """The later of two gets the reason with the name; a view with a taken name is replaced."""
    for route, rival, status, reason in (
        (f"POST {V1}/rigs", f"POST {V1}/rigs", 409, "There is already a rig with the name Shaker"),
        (f"POST {V1}/runs/views", f"POST {V1}/runs/views", 201, ""),
        (f"DELETE {V1}/sweeps/{{sweep_id}}", f"DELETE {V1}/sweeps/{{sweep_id}}", 404, "There is no sweep"),
        (f"PATCH {V1}/webhooks/{{webhook_id}}", f"DELETE {V1}/webhooks/{{webhook_id}}", 404, "There is no webhook"),
        (f"POST {V1}/webhooks/{{webhook_id}}/test", f"DELETE {V1}/webhooks/{{webhook_id}}", 404, "There is no webhook"),
        (f"PUT {ANNOTATION}", f"DELETE {ANNOTATION}", 404, "The run has no annotation"),
    ):
        first, second = laboratory.together(route, rival)
        assert second.is_success and first.status_code == status, (route, first.text, second.text)
        assert reason in first.text, route
