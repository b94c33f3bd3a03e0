"""Requests that the service refuses: the response is always a problem, never a server error, and nothing is stored."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from app import db
from app.config import Settings
from tests.app.conftest import ADDRESS, app_of, plan

RUNS, CHECK, READ, MOTIONS = "/api/v1/runs", "/api/v1/plans/check", "/api/v1/plans/read", "/api/v1/motions"
JSON = {"content-type": "application/json"}
EXAMPLES = hypothesis_settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


def inline(samples: list[float], **scale: Any) -> dict[str, Any]:
    return plan(motion={"kind": "inline", "dt": 0.01, "acceleration": samples, **({"scale": scale} if scale else {})})


def stored(client: TestClient) -> int:
    count: int = client.get(RUNS).json()["total"]
    return count


def test_checking_a_plan_never_reads_a_file_of_the_server(client: TestClient, tmp_path: Path) -> None:
    secret = tmp_path / "secret.txt"
    secret.write_text("the combination is 1234")
    answer = client.post(CHECK, json=plan(motion={"kind": "file", "path": str(secret)}))
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["where"] == "motion.kind"
    assert "combination" not in answer.text


@pytest.mark.parametrize(
    ("data", "where", "message"),
    [
        (inline([0.0] * 20, kind="pga", pga=1.0), "motion.scale", "zero throughout"),
        (inline([0.0] * 20, kind="sa_t1", sa=1.0), "motion.scale", "zero throughout"),
        (inline([1e308, -1e308] * 20, kind="factor", factor=100.0), "motion", "above 100 g"),
        (inline([900.0, -900.0] * 20, kind="factor", factor=2.0), "motion.scale", "above 100 g"),
        (plan(duration=3600.0, controller_rate=1e5, integrator={"kind": "cr", "dt": 1e-4, "substeps": 10}), "duration", "2 GB"),
        (plan(name="half \ud800 pair"), "name", "can't be stored"),
        (plan(notes="nul \0"), "notes", "can't be stored"),
        (plan(**{"\ud800": 1}), "\ud800", "can't be stored"),
        (plan(motion={"kind": "record", "record": "\ud800"}), "motion.record", "can't be stored"),
    ],
)
@pytest.mark.parametrize("path", [CHECK, RUNS])
def test_a_plan_that_could_not_be_run_is_refused_when_checked_and_when_submitted(
    serving: TestClient, path: str, data: dict[str, Any], where: str, message: str
) -> None:
    body = {"plan": data} if path == RUNS else data
    answer = serving.post(path, content=json.dumps(body), headers=JSON)
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["where"] == where
    assert message in answer.json()["detail"]
    assert stored(serving) == 0


def test_a_record_of_zeros_can_be_run_as_it_is(client: TestClient) -> None:
    checked = client.post(CHECK, json=inline([0.0] * 20)).json()
    assert (checked["summary"]["pga"], checked["summary"]["scale_factor"]) == (0.0, 1.0)


@pytest.mark.parametrize(
    ("method", "path", "body", "kind", "status", "message"),
    [
        ("POST", RUNS, b"{}", "text/plain", 415, "application/json"),
        ("POST", RUNS, b"plan=x", "application/x-www-form-urlencoded", 415, "application/json"),
        ("POST", CHECK, b"name: x", "application/yaml", 415, "application/json"),
        ("POST", MOTIONS, b"{}", "application/json", 415, "multipart/form-data"),
        ("POST", MOTIONS, b"rubbish", "multipart/form-data", 400, "boundary"),
        ("POST", RUNS, b'{"plan": ', "application/json", 400, "character 9"),
        ("POST", RUNS, b'{"plan": "\xff"}', "application/json", 400, "UTF-8"),
        ("POST", RUNS, b"[" * 100_000, "application/json", 400, "nested too deeply"),
        ("POST", RUNS, b'{"plan": {"seed": ' + b"9" * 6000 + b"}}", "application/json", 400, "digits"),
        ("POST", RUNS, b"[]", "application/json", 422, "dictionary"),
        ("POST", RUNS, b'{"plans": []}', "application/json", 422, "at least one plan"),
        ("POST", RUNS, json.dumps({"plans": [1] * 501}).encode(), "application/json", 422, "500"),
        ("POST", RUNS, b'{"plan": {}, "submitted_by": "\\u0000"}', "application/json", 422, "can't be stored"),
        ("POST", READ, b'name: "\\0"', "application/yaml", 422, "can't be stored"),
        ("POST", READ, b'name: "\\ud800"', "application/yaml", 422, "invalid Unicode character"),
        ("POST", READ, b"# long\n" * 200_000, "application/yaml", 422, "the limit is 1000000 bytes"),
        ("PUT", RUNS, b"", "application/json", 405, "GET, HEAD, POST"),
        ("GET", "/api/v1/nothing", b"", "", 404, "/api/v1/nothing"),
        ("GET", f"{RUNS}/a%00b", b"", "", 400, "NUL"),
        ("GET", f"{RUNS}?q=%00", b"", "", 400, "NUL"),
        ("GET", f"{RUNS}?since=0001-01-01T00:00:00%2B23:59", b"", "", 422, "year from 1 to 9999"),
        ("GET", f"{RUNS}?sort=mte_mm:²", b"", "", 422, "a station number from 1"),
        ("GET", f"{RUNS}?sort=name:", b"", "", 422, "not a column"),
        ("GET", f"{RUNS}?colour=red", b"", "", 422, "colour"),
    ],
)
def test_a_request_that_cannot_be_taken_is_a_problem_that_says_why(
    serving: TestClient, method: str, path: str, body: bytes, kind: str, status: int, message: str
) -> None:
    answer = serving.request(method, path, content=body, headers={"content-type": kind} if kind else {})
    assert answer.status_code == status
    assert answer.headers["content-type"] == "application/problem+json"
    told = answer.json()
    assert told["status"] == status and told["title"] and message in told["detail"]
    assert stored(serving) == 0


def test_a_method_that_is_not_possible_is_told_which_are(client: TestClient) -> None:
    assert client.put(RUNS).headers["allow"] == "GET, HEAD, POST"
    assert client.post(f"{RUNS}/one").headers["allow"] == "DELETE, GET, HEAD, PATCH"
    assert client.post("/runs").headers["allow"] == "GET, HEAD"  # a page


def test_empty_filters_are_none_and_a_time_without_zone_is_utc(client: TestClient) -> None:
    client.post(RUNS, json={"plan": plan()}).raise_for_status()
    empty = "state=&q=&submitted_by=&template=&since=&until=&sort=&order=&limit=&offset="
    assert client.get(f"{RUNS}?{empty}").json()["total"] == 1
    submitted = client.get(RUNS).json()["runs"][0]["submitted_at"].removesuffix("Z")
    assert client.get(RUNS, params={"since": submitted}).json()["total"] == 1
    assert client.get(RUNS, params={"until": submitted}).json()["total"] == 0


@pytest.mark.parametrize(
    ("origin", "host", "status"),
    [
        (None, "127.0.0.1:8000", 200),
        (ADDRESS, "127.0.0.1:8000", 200),
        ("http://[::1]:8000", "[::1]:8000", 200),
        ("http://127.0.0.1:9999", "127.0.0.1:8000", 403),
        ("http://elsewhere.example", "127.0.0.1:8000", 403),
        ("http://elsewhere.example", "elsewhere.example", 421),  # a foreign name that resolves to this machine
        ("null", "127.0.0.1:8000", 403),
        ("http://[::1", "127.0.0.1:8000", 403),
    ],
)
def test_changes_are_taken_from_programs_and_from_the_services_own_pages(
    client: TestClient, origin: str | None, host: str, status: int
) -> None:
    headers = {"host": host, **({"origin": origin} if origin else {})}
    answer = client.post("/api/v1/abort", headers=headers)
    assert answer.status_code == status
    assert client.get("/api/v1/queue").json()["held"] is (status == 200)


def test_an_upload_of_unknown_length_is_counted_and_leaves_nothing(client: TestClient, settings: Settings) -> None:
    sent = 0

    def endless() -> Iterator[bytes]:
        nonlocal sent
        yield b'--b\r\nContent-Disposition: form-data; name="file"; filename="a.txt"\r\n\r\n'
        for _ in range(200):
            sent += 1_000_000
            yield b"0.1\n" * 250_000

    answer = client.post(MOTIONS, content=endless(), headers={"content-type": "multipart/form-data; boundary=b"})
    assert answer.status_code == 413
    assert "20 MB" in answer.json()["detail"]
    assert list(settings.motions.iterdir()) == []


def test_a_database_that_does_not_answer_is_told_as_that(client: TestClient, tmp_path: Path) -> None:
    engine = db.connect(f"sqlite:///{tmp_path / 'nowhere' / 'rths.sqlite'}")
    app_of(client).state.sessions = db.sessions(engine)
    answer = client.get(RUNS)
    assert (answer.status_code, answer.headers["content-type"]) == (503, "application/problem+json")
    assert "database" in answer.json()["detail"]
    assert client.get("/healthz").json()["database"] == "silent"
    engine.dispose()


def leaves(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Paths of the numbers in a plan."""
    pairs = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in pairs:
        if isinstance(value, int | float):
            yield (*path, key)
        yield from leaves(value, (*path, key))


@EXAMPLES
@given(path=st.sampled_from(list(leaves(plan()))), value=st.floats() | st.integers())
def test_no_number_in_a_plan_causes_a_server_error(client: TestClient, path: tuple[Any, ...], value: float) -> None:
    data = copy.deepcopy(plan())
    inner: Any = data
    for step in path[:-1]:
        inner = inner[step]
    inner[path[-1]] = value
    answer = client.post(CHECK, content=json.dumps(data), headers=JSON)
    assert answer.status_code in {200, 422}, answer.text


@EXAMPLES
@given(name=st.sampled_from(["state", "q", "submitted_by", "template", "since", "sort", "order", "limit"]), text=st.text())
def test_no_query_causes_a_server_error(client: TestClient, name: str, text: str) -> None:
    assert client.get(RUNS, params={name: text}).status_code in {200, 400, 422}
