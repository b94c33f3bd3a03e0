"""Pages of all runs in every order: each page along an index is the part of the whole order, on every shelf."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from typing import Any

import pytest
import sqlalchemy as sa
from fastapi.testclient import TestClient
from sqlalchemy.orm import Session

from app.config import Settings
from app.db import unit_of_work
from app.jobs.states import State
from app.main import create_app
from app.models import SORTED, Run, RunStation
from app.runs import pages
from app.runs.columns import FACTS, column
from app.runs.pages import Order
from app.runs.query import RunQuery, path_ids
from app.runs.shelves import Shelf, on_shelf
from tests.app.conftest import ADDRESS, HERE, app_of, plan
from tests.app.test_runs_api import RUNS

COUNT = 12
VALUES = ("mte_mm:1", "mte_mm:max", "mte_mm:9", "plan.stations.0.compensator.alpha_es", "plan.stations.0.compensator.kind")


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory, migrated: Any) -> Iterator[Session]:
    """Runs with equal, different and missing values, some of them archived, deleted or neither."""
    settings = Settings(data=tmp_path_factory.mktemp("pages"), embedded_worker=False, local_sign_in=True)
    with TestClient(create_app(settings), ADDRESS, client=HERE) as client:
        plans = []
        for number in range(COUNT):
            one = plan(name=f"Brace {number % 4}", seed=number % 5)
            if number % 3:
                one["stations"][0]["compensator"] = {"kind": "inverse", "alpha_es": 10.0 + number % 4}
            plans.append(one)
        assert client.post(RUNS, json={"plans": plans, "submitted_by": "Ana"}).status_code == 201
        with unit_of_work(app_of(client).state.sessions) as session:
            for run in session.scalars(sa.select(Run)):
                if run.number % 2:
                    run.state, run.elapsed_s, run.reason = State.COMPLETED, float(run.number % 3), "The end."
                    run.finished_at = datetime.now(UTC) + timedelta(seconds=run.number % 4)
                    run.stations = [RunStation(number=1, name="Damper", mte_mm=float(run.number % 5))]
                    run.tags, run.notes = ["paper"] * (run.number % 3 == 0), "Note" * (run.number % 5 == 0)
                run.archived = run.number in (3, 8)
                run.deleted_at = datetime.now(UTC) if run.number in (5, 8) else None
        with unit_of_work(app_of(client).state.sessions) as session:
            yield session


@pytest.mark.parametrize("key", [*FACTS, *VALUES])
def test_pages_along_an_index_are_the_parts_of_the_whole_order(session: Session, key: str) -> None:
    found = column(key)
    assert found is not None
    path = None if found.stored else path_ids(session, [key]).get(key)
    for shelf in Shelf:
        for descending in (True, False):
            order, rows = Order(found, descending), RunQuery(session, on_shelf(shelf), [])
            whole = rows._sorted(order, rows._kept(order, path))
            assert len(whole) == rows.count()
            for offset in range(len(whole) + 2):
                page = pages.page(session, on_shelf(shelf), order, path, 3, offset)
                assert page == whole[offset : offset + 3], (shelf, descending, offset)


@pytest.mark.parametrize("key", SORTED)
def test_a_page_of_a_sorted_column_reads_its_index_only_and_does_not_sort(session: Session, key: str) -> None:
    if session.get_bind().dialect.name != "sqlite":
        pytest.skip("the plan of a query is read from SQLite")
    with_value, _ = pages._facts(on_shelf(Shelf.SHOWN), FACTS[key])
    query = with_value.order_by(getattr(Run, key).desc(), Run.number.desc()).limit(100)
    text = str(query.compile(session.get_bind(), compile_kwargs={"literal_binds": True}))
    steps = [row[3] for row in session.execute(sa.text(f"EXPLAIN QUERY PLAN {text}"))]
    assert len(steps) == 1 and f"USING COVERING INDEX ix_run_by_{key}" in steps[0]
