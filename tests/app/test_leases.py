"""What one of several web processes does: nobody else does it meanwhile, and another takes over after its end."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
import sqlalchemy as sa
from sqlalchemy.orm import Session, sessionmaker

from app import db
from app.config import Settings
from app.leases import RENEWED_S, TERM, Lease, Once, alone


@pytest.fixture
def maker(settings: Settings) -> sessionmaker[Session]:
    return db.sessions(db.connect(settings.url))


def moved(maker: sessionmaker[Session], by: timedelta) -> None:
    """As if the clock of the database had been moved."""
    with db.unit_of_work(maker) as session:
        session.execute(sa.update(Lease).values(until=datetime.now(UTC) + TERM - by))


def test_one_process_does_a_task_until_it_gives_it_back(maker: sessionmaker[Session]) -> None:
    one, other = Once(maker), Once(maker)
    assert one.held("webhooks") and one.held("webhooks") and not other.held("webhooks")
    assert other.held("purge")  # each task has a lease of its own
    other.release("webhooks")  # it does not hold that one
    assert not other.held("webhooks")
    one.release("webhooks")
    assert other.held("webhooks") and not one.held("webhooks")


@pytest.mark.parametrize("jump", [TERM + timedelta(seconds=1), -timedelta(days=1)], ids=["ended", "left in the future"])
def test_another_takes_over_from_a_process_that_died(maker: sessionmaker[Session], jump: timedelta) -> None:
    dead, other = Once(maker), Once(maker)
    assert dead.held("webhooks") and not other.held("webhooks")
    moved(maker, jump)
    assert other.held("webhooks")


def test_a_holder_writes_only_when_it_renews(maker: sessionmaker[Session], monkeypatch: pytest.MonkeyPatch) -> None:
    one, writes, clock = Once(maker), [0], [100.0]
    monkeypatch.setattr("app.leases.time.monotonic", lambda: clock[0])
    monkeypatch.setattr(one, "_take", lambda *_: bool(writes.__setitem__(0, writes[0] + 1)) or True)
    for _ in range(10):
        assert one.held("webhooks")
        clock[0] += RENEWED_S / 5
    assert writes == [2]


def test_sqlite_needs_no_lock_of_its_own_to_migrate(settings: Settings) -> None:
    with alone(settings.url), alone(settings.url):
        pass
