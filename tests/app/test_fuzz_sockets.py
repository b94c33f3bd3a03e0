"""Garbage over the websockets closes that socket and nothing else; a longer run: `python -m tests.fuzz --only sockets`."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.live import uplink
from tests.app.conftest import app_of
from tests.fuzz.sockets import FRAME, HELLO, MESSAGES, RUN, faults


def test_garbage_of_a_worker_and_odd_requests_of_viewers_disturb_nobody(client: TestClient) -> None:
    found = list(faults(client, 25, seed=1))
    assert found == [], "\n".join(found)


MALFORMED: list[tuple[Any, str]] = [
    (b"short", "has 5 bytes; the header of a frame has 40"),
    (b"\xff" * 60, "run id"),
    ("{", "not valid JSON"),
    ("[" * 2000, "not valid JSON"),
    ("9" * 5000, "not valid JSON"),
    ("[1]", "not a JSON object"),
    ({"run_id": RUN}, "attempt"),
    ({**MESSAGES[1], "attempt": "1"}, "attempt"),
    ({**MESSAGES[1], "attempt": 2**40}, "attempt"),
    ({**MESSAGES[1], "message": {**MESSAGES[1]["message"], "channels": []}}, "channels"),
    ({**MESSAGES[1], "message": {**MESSAGES[1]["message"], "bucket": 0}}, "bucket"),
    ({**MESSAGES[1], "message": {"type": "other"}}, "message"),
    ({**HELLO, "latch": {"presses": [{"id": "p", "by": "Ana", "at": "2026-05-06"}], "released": []}}, "time zone"),
    ({"worker": "w"}, "latch"),
    ({"contact": {"number": 1, "tests_at_a_time": 1, "executing": [{"kind": "run", "id": RUN, "attempt": -1}]}}, "attempt"),
]


def test_a_malformed_message_closes_the_socket_with_its_reason(client: TestClient) -> None:
    token = {"Authorization": f"Bearer {app_of(client).state.settings.worker_token}"}
    for message, told in MALFORMED:
        with client.websocket_connect("/api/v1/worker", headers=token) as socket, pytest.raises(WebSocketDisconnect) as closed:
            if isinstance(message, bytes):
                socket.send_bytes(message)
            else:
                socket.send_text(message if isinstance(message, str) else json.dumps(message))
            while True:
                socket.receive_text()
        assert closed.value.code == 4400 and told in closed.value.reason, (message, closed.value.reason)


def test_what_a_worker_says_is_taken_as_it_is_sent() -> None:
    assert [uplink.message(json.dumps(one)) for one in MESSAGES] == MESSAGES
    later = {**HELLO, "version": "99"}
    assert uplink.message(json.dumps(later)) == later
    assert uplink.frame(FRAME) == (RUN, 1, FRAME[40:])
