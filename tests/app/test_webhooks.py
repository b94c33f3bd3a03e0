"""Webhooks: signed deliveries of events, again after a failure, with a log; and no run waits for an address."""

from __future__ import annotations

import hashlib
import hmac
import json
import threading
from collections.abc import Iterator
from datetime import UTC, datetime
from http.server import BaseHTTPRequestHandler, HTTPServer
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient

from app import db
from app.events.tables import WebhookDelivery
from app.notifications.sending import BACK_OFF
from tests.app.conftest import app_of, plan
from tests.browser.service import until

HOOKS = "/api/v1/webhooks"


class Heard:
    """An address that keeps what it is told, and answers with the statuses it is given, then with 204."""

    def __init__(self) -> None:
        self.requests: list[tuple[dict[str, str], bytes]] = []
        self.statuses: list[int] = []
        heard = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["Content-Length"]))
                heard.requests.append((dict(self.headers), body))
                self.send_response(heard.statuses.pop(0) if heard.statuses else 204)
                self.end_headers()

            def log_message(self, *_: Any) -> None: ...

        self.server = HTTPServer(("127.0.0.1", 0), Handler)
        self.url = f"http://127.0.0.1:{self.server.server_port}/rths"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()


@pytest.fixture
def heard() -> Iterator[Heard]:
    one = Heard()
    yield one
    one.server.shutdown()
    one.server.server_close()


def log(client: TestClient, hook: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = client.get(f"{HOOKS}/{hook}/deliveries").json()["deliveries"]
    return found


def test_events_are_sent_signed_and_again_after_a_failure(client: TestClient, heard: Heard) -> None:
    added = client.post(HOOKS, json={"url": heard.url, "kinds": ["cancelled"], "by": "Ana"}).json()
    hook, secret = added["id"], added["secret"]
    heard.statuses = [500]
    client.post("/api/v1/queue/hold", json={"by": "Ana"})  # a kind that was not asked for
    run = client.post("/api/v1/runs", json={"plan": plan(name="Brace")}).json()["runs"][0]["id"]
    client.post(f"/api/v1/runs/{run}/cancel", json={"by": "Bo"})
    (failed,) = until(lambda: log(client, hook), lambda found: found[0]["attempts"] == 1)
    assert (failed["state"], failed["status"]) == ("waiting", 500)
    assert failed["problem"] == "The address answered with the HTTP status 500."
    assert datetime.fromisoformat(failed["next_at"]) - datetime.fromisoformat(failed["last_at"]) == BACK_OFF[0]

    with db.unit_of_work(app_of(client).state.sessions) as session:
        session.execute(sa.update(WebhookDelivery).values(next_at=datetime.now(UTC)))
    (sent,) = until(lambda: log(client, hook), lambda found: found[0]["state"] != "waiting")
    assert (sent["state"], sent["attempts"], sent["status"], sent["problem"]) == ("delivered", 2, 204, None)
    headers, body = heard.requests[1]
    told = json.loads(body)
    assert (told["event"]["kind"], told["event"]["run_id"]) == ("cancelled", run)
    assert told["event"]["sentence"] == "Run 1, Brace: Cancelled by Bo before it started."
    signed = headers["X-RTHS-Timestamp"].encode() + b"." + body
    digest = hmac.new(secret.encode(), signed, hashlib.sha256).hexdigest()
    assert headers["X-RTHS-Signature"] == f"sha256={digest}" and headers["X-RTHS-Event"] == "cancelled"
    assert secret not in client.get(HOOKS).text


def test_a_test_is_sent_and_a_silent_address_is_told_in_the_log(client: TestClient, heard: Heard) -> None:
    hook = client.post(HOOKS, json={"url": heard.url, "secret": "known"}).json()["id"]
    assert client.post(f"{HOOKS}/{hook}/test").json()["state"] == "waiting"
    nobody = client.post(HOOKS, json={"url": "http://127.0.0.1:9/"}).json()["id"]
    client.post(f"{HOOKS}/{nobody}/test")
    (sent,) = until(lambda: log(client, hook), lambda found: found[0]["attempts"] == 1)
    assert (sent["kind"], sent["state"]) == ("test", "delivered")
    (failed,) = until(lambda: log(client, nobody), lambda found: found[0]["attempts"] == 1)
    assert failed["state"] == "waiting" and failed["status"] is None and "ConnectError" in failed["problem"]
    paused = client.patch(f"{HOOKS}/{nobody}", json={"enabled": False, "kinds": ["failed"]}).json()
    assert (paused["enabled"], paused["kinds"], paused["last"]["attempts"]) == (False, ["failed"], 1)
    assert client.delete(f"{HOOKS}/{nobody}").status_code == 204
    assert [one["id"] for one in client.get(HOOKS).json()["webhooks"]] == [hook]


@pytest.mark.parametrize(
    "url", ["ftp://lab/", "file:///etc/passwd", "lab.example", "http://", "http://a b/", "http://x:99999/"]
)
def test_an_address_that_is_no_web_address_is_refused(serving: TestClient, url: str) -> None:
    answer = serving.post(HOOKS, json={"url": url})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["problem"] == "needs an address that begins with http:// or https://"
