"""Bodies of requests are bounded in size and shape, and answers to bad ones in length, before anything slow reads them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app import bodies
from app.bodies import fault_of
from tests.app.conftest import plan

JSON = {"content-type": "application/json"}
CHECK = "/api/v1/plans/check"


@pytest.mark.parametrize("depth", [41, 500, 700, 900, 5000])
@pytest.mark.parametrize("shape", ["[%s]", '{"a":%s}', '{"plan":[%s]}'])
def test_json_that_is_nested_too_deeply_is_refused(serving: TestClient, depth: int, shape: str) -> None:
    before, after = shape.split("%s")
    body = before * depth + "1" + after * depth
    answer = serving.post(CHECK, content=body, headers=JSON)
    assert (answer.status_code, answer.headers["content-type"]) == (400, "application/problem+json")
    assert "nested too deeply" in answer.json()["detail"]


@pytest.mark.parametrize(
    ("body", "fault"),
    [
        (b'{"a": "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["}', None),
        (rb'{"a": "\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[\\"}', None),
        (b'{"a": "' + b"9" * 1000 + b'"}', None),
        (b'{"a": 1.' + b"9" * 401 + b"}", "digits"),
        (b'{"a": ' + b"9" * 5000 + b"}", "digits"),
        (json.dumps({"a": [[1]] * 5}).encode("utf-16"), "UTF-8"),
        (b'{"a": "' + b"x" * 100_000, None),  # the parser says what is wrong
    ],
)
def test_a_glance_at_json_sees_its_shape_and_not_what_texts_hold(body: bytes, fault: str | None) -> None:
    found = fault_of(body)
    assert found is None if fault is None else fault in str(found)


def test_the_number_of_texts_and_of_objects_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bodies, "MOST_TEXTS", 10)
    monkeypatch.setattr(bodies, "MOST_CONTAINERS", 60)
    monkeypatch.setattr(bodies, "MOST_KEYS", 3)
    assert fault_of(b'{"a": "b", "c": 1}') is None
    assert "keys and texts" in str(fault_of(json.dumps({f"k{one}": 1 for one in range(11)}).encode()))
    assert fault_of(b'[{"a": 1, "b": 2, "c": {"d": 1}}, {"a": 1}]') is None
    assert "too many keys" in str(fault_of(b'[{"a": 1, "b": {"e": 1}, "c": 1, "d": 1}]'))
    assert "objects and lists" in str(fault_of(json.dumps([[]] * 60).encode()))


def test_a_plan_needs_no_more_than_the_limit_of_json(serving: TestClient) -> None:
    large = json.dumps({"plan": "x" * 8_000_000}).encode()
    assert serving.post("/api/v1/runs", content=large, headers=JSON).status_code == 413

    def endless() -> Iterator[bytes]:
        for _ in range(9):
            yield b"x" * 1_000_000

    answer = serving.post("/api/v1/runs", content=endless(), headers=JSON)
    assert answer.status_code == 413 and "8 MB" in answer.json()["detail"]


def with_long_names(count: int, length: int) -> dict[str, Any]:
    return plan(**{f"{'k' * length}{one}": 1 for one in range(count)})


@pytest.mark.parametrize(
    "body",
    [
        {f"key{one}": one for one in range(1_900)},
        with_long_names(150, 3_000),
        plan(motion={"kind": "z" * 200_000}),
        plan(motion={"kind": "inline", "dt": 0.01, "acceleration": ["x"] * 20_000}),
        plan(**{"\ud800" * 300 + str(one): "\ud800" * 300 for one in range(300)}),
        [1] * 50_000,
    ],
)
def test_the_answer_to_a_bad_request_stays_short(serving: TestClient, body: Any) -> None:
    for path in (CHECK, "/api/v1/runs", "/api/v1/sweeps/preview", "/api/v1/mappings"):
        sent = {"plan": body} if path == "/api/v1/runs" and isinstance(body, dict) else body
        answer = serving.post(path, content=json.dumps(sent), headers=JSON)
        assert answer.status_code in {400, 422}
        assert len(answer.content) < 250_000
        assert len(answer.json()["errors"]) <= 102
