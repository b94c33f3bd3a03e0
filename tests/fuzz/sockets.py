"""Garbage over the websockets: a worker with a good token that follows no protocol, and odd requests of viewers."""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Iterator
from typing import Any
from urllib.parse import quote

from fastapi.testclient import TestClient
from hypothesis import strategies as st
from starlette.websockets import WebSocketDisconnect

from app.live.messages import progress, schema
from app.live.uplink import FRAME_HEADER
from rths_engine.results.channels import Channel
from tests.app.conftest import app_of
from tests.fuzz import trying
from tests.fuzz.mutations import damaged

MOST_S = 30.0  # until a good message is heard
RUN = "0" * 36  # a run that the worker tells of, of which no database knows
CHANNEL = Channel("x_cmd", 1, "Command")
HELLO = {
    "worker": "w",
    "latch": {"presses": [{"id": "p", "by": "Ana", "at": "2026-05-06T07:08:09+00:00"}], "released": ["p"]},
    "acknowledged": ["p"],
    "stopping": [],
}


def _told(message: dict[str, Any]) -> dict[str, Any]:
    return {"run_id": RUN, "attempt": 1, "message": message}


MESSAGES = [
    HELLO,
    _told(schema(1, 0.01, 1, 100, (CHANNEL,))),
    _told(progress("running", 0.5, 0.5, 1.0)),
    _told({"type": "end"}),
]
FRAME = FRAME_HEADER.pack(RUN.encode(), 1) + b"\0\0\0\0\1\0\0\0" + bytes(12)
VALUES: Any = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.sampled_from(["", "x", "\0", RUN, "9" * 100, "2026"]),
    lambda some: st.lists(some, max_size=3) | st.dictionaries(st.sampled_from(["id", "by", "at", "type", "key"]), some),
    max_leaves=6,
)


@st.composite
def _messages(draw: st.DrawFn) -> str | bytes:
    """A valid message with a value lost or replaced, or damaged as bytes or text."""
    how = draw(st.sampled_from(["value", "value", "text", "bytes", "short"]))
    if how == "short":
        return draw(st.binary(max_size=60))
    if how == "bytes":
        return draw(damaged(FRAME))
    whole = json.loads(json.dumps(draw(st.sampled_from(MESSAGES))))
    if how == "text":
        return draw(damaged(json.dumps(whole).encode())).decode("utf-8", "replace")
    inner: Any = whole
    while True:
        key = draw(st.sampled_from(list(inner) if isinstance(inner, dict) else list(range(len(inner)))))
        if isinstance(inner[key], dict | list) and inner[key] and draw(st.integers(0, 3)):
            inner = inner[key]
            continue
        if draw(st.booleans()):
            del inner[key]
        else:
            inner[key] = draw(VALUES)
        return json.dumps(whole)


_ODD = st.sampled_from(["-1", "1e9", "٣", "9" * 400, "", "NaN", "\0", "0x10", "½", "../..", "%", "\ud7ff", "²"])
REQUESTS = st.tuples(_ODD | st.sampled_from([RUN, "none"]), _ODD, st.sampled_from(["from", "From", "from[]", "x"]))


class _Errors(logging.Handler):
    """Errors that the service logs."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.found: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.found.append(record.getMessage())


def faults(client: TestClient, examples: int, seed: int) -> Iterator[str]:
    """What is wrong with the websockets over `examples` messages of a worker, and as many requests of viewers."""
    errors = _Errors()
    logging.getLogger().addHandler(errors)
    try:
        yield from trying.faults(st.lists(_messages(), min_size=1, max_size=4), _Worker(client, errors).wrong, examples, seed)
        yield from trying.faults(REQUESTS, _Viewer(client, errors).wrong, examples, seed)
    finally:
        logging.getLogger().removeHandler(errors)


class _Worker:
    """Messages of a worker: the service takes them or closes this socket, and goes on to serve viewers and other workers."""

    def __init__(self, client: TestClient, errors: _Errors):
        self.client, self.errors = client, errors
        self.token = {"Authorization": f"Bearer {app_of(client).state.settings.worker_token}"}

    def wrong(self, messages: list[str | bytes]) -> str | None:
        self.errors.found.clear()
        with self.client.websocket_connect("/api/v1/worker", headers=self.token) as socket:
            for one in messages:
                if isinstance(one, bytes):
                    socket.send_bytes(one)
                else:
                    socket.send_text(one)
        return self._not_served() or _logged(self.errors)

    def _not_served(self) -> str | None:
        """A good worker tells of a run, and a viewer hears of it."""
        hub = app_of(self.client).state.hub
        hub.runs.pop(RUN, None)
        with self.client.websocket_connect("/api/v1/worker", headers=self.token) as socket:
            for one in MESSAGES[:3]:
                socket.send_json(one)
            socket.send_bytes(FRAME)
            end = time.monotonic() + MOST_S
            while (RUN not in hub.runs or not hub.runs[RUN].store.count) and time.monotonic() < end:
                time.sleep(0.001)
            with self.client.websocket_connect(f"/api/v1/runs/{RUN}/live") as viewer:
                got = viewer.receive()
                while got.get("text") and json.loads(got["text"])["type"] == "progress":
                    got = viewer.receive()
        heard = got.get("text") and json.loads(got["text"])["type"] == "schema"
        return None if heard else f"a viewer is not served afterwards: {got}"


class _Viewer:
    """Requests of viewers with odd parameters, and what a viewer sends: ignored, or the socket is closed with a reason."""

    def __init__(self, client: TestClient, errors: _Errors):
        self.client, self.errors = client, errors

    def wrong(self, asked: tuple[str, str, str]) -> str | None:
        self.errors.found.clear()
        run, value, name = (quote(one) for one in asked)
        try:
            with self.client.websocket_connect(f"/api/v1/runs/{run}/live?{name}={value}&from={value}") as viewer:
                viewer.send_text(value)
                viewer.send_bytes(value.encode())
                viewer.receive()
        except WebSocketDisconnect as closed:
            if closed.code in {1000, 1011} and not closed.reason:
                return f"a viewer is refused without a reason: {asked} {closed.code}"
        return _logged(self.errors)


def _logged(errors: _Errors) -> str | None:
    return f"an error in the log: {errors.found[0]}" if errors.found else None
