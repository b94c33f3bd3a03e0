"""The Lab page: cards of running tests, what happened meanwhile, and the tour."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from fastapi.testclient import TestClient

from app.live.frames import Decimator, FrameStore
from app.live.hub import LiveRun
from app.live.messages import progress, schema
from app.models import Run
from app.pages.lab_cards import card
from app.pages.sparkline import COLUMNS, HEIGHT, path
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan
from rths_engine.planning.templates import template
from rths_engine.running.run import Run as EngineRun
from tests.app.conftest import plan


def points(text: str) -> list[tuple[str, float, float]]:
    return [(move, float(x), float(y)) for move, x, y in re.findall(r"([ML])([\d.]+) ([\d.]+)", text)]


def test_a_curve_keeps_the_extremes_of_each_column_and_leaves_a_gap_where_nothing_was_measured() -> None:
    low, high = np.zeros(1200), np.zeros(1200)
    high[605], low[606] = 2.0, -1.0
    low[300:400] = high[300:400] = np.nan
    drawn = points(path(low, high, 2400, 2.0))
    assert len(drawn) == 2 * (COLUMNS / 2 - 5)  # half of the test is over; five columns lie in the gap
    assert [move for move, *_ in drawn].count("M") == 2
    peak = min(y for _, _, y in drawn)
    assert peak < HEIGHT * 0.07 and max(y for _, _, y in drawn) > HEIGHT * 0.7
    assert max(x for _, x, _ in drawn) <= 121  # of 240


def live_of(planned: Plan, seconds: float) -> LiveRun:
    run = EngineRun(planned, MotionLibrary(None))
    run.advance(round(seconds / run.plan.step))
    decimator = Decimator(run.channels, 10, run.dt)
    live = LiveRun(1, schema(1, run.dt, 10, run.total, decimator.channels))
    assert live.store.append(decimator.frame(run.signals, run.done) or b"")
    live.progress = progress("running", run.done * run.dt, 0.5, planned.duration or 0.0, {"stations": [{"mte_mm": 0.5}] * 2})
    return live


def test_a_card_shows_curves_the_smallest_margin_and_the_measures_so_far() -> None:
    planned = template("two-storeys").model_copy(update={"duration": 20.0})
    shown = card(Run(id="a", number=7, name="A"), planned, live_of(planned, 10.0))
    assert [curve.label for curve in shown.curves] == ["Measured displacement, station 1", "Tracking indicator, station 1"]
    assert len(shown.curves[0].paths) == 2 and shown.curves[0].value.endswith(" mm")
    assert shown.margin is not None and re.fullmatch(r"\d+ % of the limit on velocity of station [12]", shown.margin.words)
    assert ("MTE, mm", "0.50 / 0.50") in shown.measures


def test_a_card_of_a_structure_shows_its_highest_floor_and_no_margin() -> None:
    planned = template("structure-free-vibration").model_copy(update={"duration": 4.0})
    shown = card(Run(id="a", number=7, name="A"), planned, live_of(planned, 2.0))
    assert [curve.label for curve in shown.curves] == ["Floor displacement, floor 3"] and shown.margin is None


def test_a_card_before_the_first_sample_has_no_curves() -> None:
    planned = template("two-storeys")
    assert card(Run(id="a", number=7, name="A"), planned, None).curves == []
    assert FrameStore(3).values().shape == (0, 3, 3)


def test_the_page_says_what_happened_since_a_moment(client: TestClient) -> None:
    before = datetime.now(UTC) - timedelta(minutes=1)
    run = client.post("/api/v1/runs", json={"plan": plan(name="Forgotten"), "submitted_by": "Ana"}).json()["runs"][0]["id"]
    client.post(f"/api/v1/runs/{run}/cancel", json={"by": "Ana"})
    told = client.get("/lab/since", params={"moment": before.isoformat()})
    assert told.status_code == 200 and "1 test cancelled" in told.text and f'href="/runs/{run}"' in told.text
    later = datetime.now(UTC) + timedelta(minutes=1)
    assert "Nothing happened." in client.get("/lab/since", params={"moment": later.isoformat()}).text
    assert client.get("/lab/since", params={"moment": "yesterday"}).status_code == 422
    assert client.get("/lab/since", params={"moment": "2026-11-29"}).status_code == 200
    assert client.get("/lab/since", params={"moment": "0001-01-01T00:00:00+14:00"}).status_code == 422


@pytest.mark.parametrize(("part", "whole"), [("/lab", "/"), ("/lab/since?moment=2026-11-29", "/"), ("/table4/now", "/table4")])
def test_the_address_of_a_part_of_a_page_leads_people_to_the_page(client: TestClient, part: str, whole: str) -> None:
    page = {"accept": "text/html,*/*;q=0.8"}
    answer = client.get(part, headers=page, follow_redirects=False)
    assert (answer.status_code, answer.headers["location"]) == (303, whole)
    assert client.get(part, headers=page | {"hx-request": "true"}, follow_redirects=False).status_code == 200
    assert client.get(part, follow_redirects=False).status_code == 200


def test_the_tour_leads_from_the_demonstration_to_a_comparison(client: TestClient) -> None:
    assert "Start the demonstration" in client.get("/lab").text
    planned = template("table3-04").as_dict()
    first = client.post("/api/v1/runs", json={"plan": planned, "submitted_by": "Ana"}).json()["runs"][0]["id"]
    text = client.get("/lab").text
    assert f'href="/runs/{first}"' in text and f'href="/new?from={first}"' in text and "/compare" not in text
    changed = {**planned, "template": None, "seed": 99}
    second = client.post("/api/v1/runs", json={"plan": changed, "submitted_by": "Ana"}).json()["runs"][0]["id"]
    for run in (first, second):
        client.post(f"/api/v1/runs/{run}/cancel", json={})
    assert f'href="/compare?items=run:{first},run:{second}"' in client.get("/lab").text
