"""Every route declares what bounds its work, and those of calculations have a process for it."""

from __future__ import annotations

import inspect
import math
import pickle
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.routing import iter_route_contexts
from fastapi.testclient import TestClient

from app.calculations.bound import Bound
from app.calculations.orders import order
from app.checking import PLANS, outlines
from app.config import Settings
from app.db import connect, sessions
from app.main import create_app
from app.models import Run
from app.runs.service import RunService
from app.store.motions import motions_of
from rths_engine.foundation.errors import RthsError
from tests.app.bounds import GROUPS
from tests.app.conftest import plan

CALCULATES = ("Calculated(", "CalculatedFile(", "calculate(")


def routes(app: FastAPI) -> dict[str, Any]:
    """The context of each route, websocket and mount, by its method and path."""
    found = {}
    for one in iter_route_contexts(app.routes):
        method = sorted(one.methods)[0] if one.methods else "websocket" if one.endpoint else "MOUNT"
        found[f"{method} {one.path}" + ("" if one.endpoint else "/{path:path}")] = one
    return found


@pytest.fixture(scope="module")
def described(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    return routes(create_app(Settings(data=tmp_path_factory.mktemp("bounds"), embedded_worker=False, local_sign_in=True)))


def test_every_route_declares_once_what_bounds_its_work(described: dict[str, Any]) -> None:
    declared = Counter(name for group in GROUPS.values() for name in group)
    missing = sorted(described.keys() - declared.keys())
    assert missing == [], "add these to a group of tests/app/bounds.py, after you have bounded their work"
    assert sorted(declared.keys() - described.keys()) == [] and set(declared.values()) == {1}


def test_routes_of_calculations_have_a_process_and_others_none(described: dict[str, Any]) -> None:
    for name, one in described.items():
        if one.endpoint and (method := name.partition(" ")[0]) not in ("websocket", "MOUNT"):
            calculates = any(call in inspect.getsource(one.endpoint) for call in CALCULATES)
            assert calculates == (name in GROUPS["process"]), (method, name)


def test_a_service_in_a_calculation_reads_with_a_session_of_its_own(client: TestClient, settings: Settings) -> None:
    run_id = client.post("/api/v1/runs", json={"plan": plan(), "submitted_by": "Ana Ruiz"}).json()["runs"][0]["id"]
    url = f"/api/v1/runs/{run_id}"
    assert client.get(f"{url}/plan.yaml").text.startswith("schema:")
    assert client.get(f"{url}/recording.csv").status_code == 409
    missing = client.get("/api/v1/runs/0/plan.yaml")
    assert missing.status_code == 404 and missing.headers["content-type"] == "application/problem+json"


def test_the_session_of_an_order_is_not_that_of_the_request(settings: Settings) -> None:
    with sessions(connect(settings.url))() as session:
        runs = RunService(session, motions_of(settings))
        _, (there,), *_ = pickle.loads(order(PLANS, len, (runs,), {}))
        assert there.session is not session and there.runs.session is there.session
        assert there.session.query(Run).count() == 0
        there.session.close()


class Counted:
    """Calculations that are only counted."""

    def __init__(self) -> None:
        self.bounds: list[Bound] = []

    def __call__(self, bound: Bound, function: Any, /, *arguments: Any, **named: Any) -> Any:
        self.bounds.append(bound)
        return function(*arguments, **named)


def test_long_plans_are_checked_in_a_process_and_brief_ones_at_once(settings: Settings) -> None:
    counted: Any = Counted()
    (good,) = outlines(counted, [plan()], motions_of(settings))
    assert not isinstance(good, RthsError) and good.floors == 2 and not counted.bounds
    found = outlines(counted, [plan(), plan(notes="x" * 20_000), {}], motions_of(settings))
    assert counted.bounds == [PLANS] and isinstance(found[2], RthsError)


def test_every_bound_ends(described: dict[str, Any]) -> None:
    declared = [one for one in _bounds() if isinstance(one, Bound)]
    assert len(declared) > 12
    for one in declared:
        assert 0 < one.seconds <= 600 and one.megabytes > 0 and one.mend and math.isfinite(one.patience_s), one


def _bounds() -> list[object]:
    """Values of the modules of the service that a test has loaded."""
    app = Path(__file__).parents[2] / "app"
    modules = [one for one in sys.modules.values() if str(getattr(one, "__file__", "")).startswith(str(app))]
    return [value for module in modules for value in vars(module).values()]
