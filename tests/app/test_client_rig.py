"""A test with a client from the queue to its report: OpenSees drives the rig of a whole service."""

from __future__ import annotations

import os
import re
import subprocess
from typing import Any

import pytest

from rths_engine.recordings.run_file import load
from tests.app.test_worker import live, watch
from tests.browser.service import Service, until
from tests.engine.clients import led, station
from tests.engine.test_client_opensees import STATION, STEPS, script
from tests.opensees import peer

PYTHON_LINE = "ops.element('genericClient', TAG, '-node', NODE, '-dof', 1, '-server', {port}, '127.0.0.1')"


def submitted(service: Service, **changed: Any) -> str:
    plan = led([STATION]).model_dump(mode="json", by_alias=True) | {"name": "Damper under OpenSees"} | changed
    run: str = service.post("/runs", {"plan": plan, "submitted_by": "Ana Ruiz"})["runs"][0]["id"]
    return run


def waiting(service: Service, run: str) -> int:
    """The port at which a queued test waits for its client."""
    told = until(lambda: service.get(f"/runs/{run}")["doing"], lambda doing: doing.startswith("waiting for client"))
    found = re.fullmatch(r"waiting for client at 127\.0\.0\.1:(\d+) by TCP", told)
    assert found
    return int(found[1])


def test_opensees_drives_a_queued_test_that_is_seen_live_and_reported(service: Service) -> None:
    if reason := peer.missing():
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)(reason)
    run = submitted(service)
    port = waiting(service, run)
    with live(service, run) as socket:
        done = subprocess.run(
            [peer.PYTHON, "-c", script("'NewmarkExplicit', 0.5"), str(port)], capture_output=True, timeout=120
        )
        assert done.returncode == 0
        _, buckets, messages = watch(socket)
    told = [one["client"] for one in messages if one["type"] == "progress" and "client" in one]
    assert told[0]["state"] == "waiting" and told[0]["lines"]["python"] == PYTHON_LINE.format(port=port)
    assert told[-1]["state"] == "connected" and told[-1]["steps"] == STEPS and len(buckets) > 0
    ended = service.wait(run, "completed")
    assert ended["reason"] == "The client ended the test." and ended["client"]["steps"] == STEPS
    assert ended["client"]["step_ms"]["median"] > 0 and ended["stations"][0]["peak_stroke_mm"] > 5
    assert ended["simulated_s"] == pytest.approx(2.0)
    assert load(service.data / "recordings" / f"{run}.h5").summary["client"]["messages"]["5"] == STEPS
    report = service.http.get(f"/api/v1/runs/{run}/report.html").raise_for_status().text
    assert "its program is in no digest" in report and "to the bit" not in report
    assert "Steps of the client" in report and f"{STEPS}" in report


def test_a_cancel_while_the_rig_waits_and_a_client_that_never_comes_end_the_test_with_a_reason(service: Service) -> None:
    run = submitted(service)
    waiting(service, run)
    service.post(f"/runs/{run}/cancel", {"by": "Ana Ruiz"})
    assert service.wait(run)["state"] == "cancelled"
    absent = submitted(service, client={"port": 0, "waiting": 0.2})
    ended = service.wait(absent)
    assert ended["state"] == "failed" and "No client connected" in ended["reason"] and ended["client"] is None


def test_a_preflight_says_that_a_client_computes_the_displacements(service: Service) -> None:
    plan = led([station()]).model_dump(mode="json", by_alias=True)
    found = service.post("/plans/preflight", {"plan": plan})
    assert found["open_ended"] is True
    assert found["verdict"] == "incomplete" and "the client computes the displacements" in found["sentence"]
    stability = service.post("/stability", plan)
    assert stability["radius"] is None and "client" in stability["notes"][0]
