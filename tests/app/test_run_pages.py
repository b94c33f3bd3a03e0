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
from app.models import LONG_TEXTS, SHORT, SORTED, Run, RunStation
from app.runs import pages
from app.runs.columns import FACTS, column
from app.runs.pages import Order
from app.runs.query import RunQuery, path_ids, values_of
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
                    run.state, run.elapsed_s = State.COMPLETED, float(run.number % 3)
                    run.reason = "" if run.number == 7 else "The end."  # an empty reason is one
                    run.finished_at = datetime.now(UTC) + timedelta(seconds=run.number % 4)
                    run.stations = [RunStation(number=1, name="Damper", mte_mm=float(run.number % 5))]
                    run.tags, run.notes = ["paper"] * (run.number % 3 == 0), "Note" * (run.number % 5 == 0)
                run.archived = run.number in (3, 8)
                run.deleted_at = datetime.now(UTC) if run.number in (5, 8) else None
        with unit_of_work(app_of(client).state.sessions) as session:
            yield session


@pytest.mark.parametrize("key", [*FACTS, *VALUES])
def test_every_page_from_either_end_is_the_part_of_the_whole_order(session: Session, key: str) -> None:
    check_pages(session, key)


@pytest.mark.parametrize("key", LONG_TEXTS)
def test_the_order_is_the_same_with_a_text_that_is_too_long_for_the_index(session: Session, key: str) -> None:
    assert not pages._has_long(session, key)
    with session.begin_nested() as savepoint:
        session.execute(sa.update(Run).where(Run.number == 4).values({key: "N" * (SHORT + 1)}))
        assert pages._has_long(session, key)
        check_pages(session, key)
        savepoint.rollback()


def check_pages(session: Session, key: str) -> None:
    """Check each page of 3 runs, of every shelf in both directions."""
    found = column(key)
    assert found is not None
    path = None if found.stored else path_ids(session, [key]).get(key)
    for shelf in Shelf:
        for descending in (True, False):
            order, rows = Order(found, descending), RunQuery(session, on_shelf(shelf), [])
            whole = in_order(session, shelf, order)
            assert len(whole) == rows.count() and rows._sorted(order, rows._kept(order, path)) == whole
            for offset in range(len(whole) + 2):
                page = pages.page(session, on_shelf(shelf), order, path, 3, offset, len(whole))
                assert page == whole[offset : offset + 3], (shelf, descending, offset)


def in_order(session: Session, shelf: Shelf, order: Order) -> list[int]:
    """The numbers of all runs of a shelf, sorted without the database."""
    key, values = order.column.key, {}
    for run in session.scalars(sa.select(Run)):
        archived = shelf is Shelf.ARCHIVED
        if (run.deleted_at is not None) == (shelf is Shelf.DELETED) and (
            shelf not in (Shelf.SHOWN, Shelf.ARCHIVED) or run.archived == archived
        ):
            values[run.number] = getattr(run, key) if order.column.stored else None
    if not order.column.stored:
        values |= {run: value for (run, _), value in values_of(session, list(values), path_ids(session, [key])).items()}
    missing: tuple[object, ...] = (None, "", []) if key in pages.EMPTY else (None,)
    given = {run: value for run, value in values.items() if value not in missing}
    with_value = sorted(given, key=lambda run: (given[run], run), reverse=order.descending)
    return with_value + sorted(values.keys() - given.keys(), reverse=order.descending)


@pytest.mark.parametrize("key", ["number", *SORTED, *LONG_TEXTS])
def test_a_page_of_a_sorted_column_reads_its_index_only_and_does_not_sort(session: Session, key: str) -> None:
    if session.get_bind().dialect.name != "sqlite":
        pytest.skip("the plan of a query is read from SQLite")
    part = pages._parts(session, on_shelf(Shelf.SHOWN), Order(FACTS[key]), 0, COUNT)[0]
    query = part.runs.order_by(*(one.desc() for one in part.by)).limit(100)
    text = str(query.compile(session.get_bind(), compile_kwargs={"literal_binds": True}))
    steps = [row[3] for row in session.execute(sa.text(f"EXPLAIN QUERY PLAN {text}"))]
    assert len(steps) == 1 and f"USING COVERING INDEX ix_run_by_{key}" in steps[0], steps
