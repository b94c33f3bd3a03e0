"""A test with a client on its page: the rig waits, the client connects, its steps are seen live, and its warnings stay."""

from __future__ import annotations

import re
from types import SimpleNamespace
from typing import Any, cast

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from rths_engine.client.session import Session
from rths_engine.wire.generic import Action
from tests.browser.conftest import Opener
from tests.browser.service import Service
from tests.engine.clients import Generic, led, station


def connected(port: int) -> Generic:
    """A client of the rig that listens at this port."""
    plan = SimpleNamespace(client=SimpleNamespace(transport="tcp"))
    return Generic(cast(Session, SimpleNamespace(address=f"127.0.0.1:{port}", run=SimpleNamespace(plan=plan))))


def test_a_waiting_rig_tells_what_to_put_into_the_script_and_shows_its_client(idle: Service, opened: Opener) -> None:
    plan: Any = led([station()]).model_dump(mode="json", by_alias=True) | {"name": "Damper under OpenSees"}
    run = idle.post("/runs", {"plan": plan, "submitted_by": "Ana Ruiz"})["runs"][0]["id"]
    page = opened(f"/runs/{run}")
    client = page.get_by_role("status", name="Client")
    expect(client.get_by_role("heading", name="Waiting for client")).to_be_visible()
    expect(page.locator("#clock")).to_have_text("Waiting for client")
    script = client.get_by_text(re.compile(r"ops\.element\('genericClient', TAG, '-node', NODE, '-dof', 1, '-server', \d+"))
    port = int(re.findall(r"\d+", script.inner_text())[1])
    expect(client.get_by_text(f"element genericClient TAG -node NODE -dof 1 -server {port} 127.0.0.1")).to_be_visible()
    expect(client.get_by_role("button", name="Copy the line for OpenSeesPy")).to_be_visible()
    assert not Axe().run(page).response["violations"]
    peer = connected(port)
    peer.say(Action.SET_TRIAL, (0.0,), 0.0)
    for k in range(1, 101):
        peer.step(0.0001 * k, 0.01 * k)
    expect(client).to_contain_text(re.compile(r"Client 127\.0\.0\.1:\d+ by TCP: \d+ steps"))
    expect(client.get_by_role("heading", name="Waiting for client")).to_be_hidden()
    peer.all((Action.SET_TRIAL, (0.011,), 1.01), (Action.SET_TRIAL, (0.012,), 1.01))  # iterates
    peer.say(Action.COMMIT)
    peer.end()
    expect(page.locator("#state")).to_have_text("completed")
    expect(client).to_contain_text("101 steps")
    expect(client).to_contain_text("The integrator of the client iterates")
    expect(page.locator("#clock")).to_have_text(re.compile(r"^1\.01 s simulated"))
    expect(page.locator("#facts")).to_contain_text("with a client")


@pytest.mark.parametrize("kind", ["client"])
def test_the_form_of_a_test_with_a_client_shows_its_fields_and_no_structure(kind: str, idle: Service, opened: Opener) -> None:
    page = opened("/new?template=opensees-client")
    expect(page.get_by_label("Kind of test")).to_have_value(kind)
    for label in ("Transport", "Port", "Longest wait for the client, s", "Longest silence of the client, s"):
        expect(page.get_by_label(label, exact=True)).to_be_visible()
    for heading in ("Structure", "Ground motion", "Drive"):
        expect(page.get_by_role("heading", name=heading, exact=True)).to_be_hidden()
    expect(page.get_by_text("Not simulated: the client computes the displacements").first).to_be_visible()
