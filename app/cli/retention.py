"""`rths retention`: remove the recordings that the rule of the laboratory removes, or only say which."""

from __future__ import annotations

from argparse import Namespace

from app import db
from app.audit.log import Acting
from app.cli.recorded import user
from app.cli.settings import stored
from app.retention.daily import Removal
from app.retention.service import Retention
from app.store.opening import store_of


def retention(given: Namespace) -> None:
    """`rths retention`: remove recordings now, without waiting for the day; with `--dry-run`, change nothing."""
    settings = stored(given)
    db.migrate(settings.url)
    engine = db.connect(settings.url)
    try:
        maker = db.sessions(engine)
        with db.unit_of_work(maker) as session:
            rule, preview = Retention(session).rule, Retention(session).preview()
        print(rule.words)
        if given.dry_run or not rule.acts:
            given.recorded = False
            print(preview.sentence)
            for one in preview.oldest:
                print(f"  #{one.number} {one.name}, {one.finished_at:%Y-%m-%d}, {one.size / 1e6:.1f} MB")
        else:
            print(Removal(maker, store_of(settings), Acting(user(), "", "command line")).remove().sentence)
    finally:
        engine.dispose()
