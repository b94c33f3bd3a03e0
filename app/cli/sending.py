"""`rths send-recordings`."""

from __future__ import annotations

import sys
from argparse import Namespace

from app import db
from app.audit.log import Acting, acts
from app.cli.main import DONE, FAILED
from app.cli.recorded import user
from app.cli.settings import stored
from app.runs.job import UNSENT
from app.runs.unsent import send
from app.store.opening import store_of
from rths_engine.foundation.errors import Issue, RthsError


def send_recordings(given: Namespace) -> int:
    """`rths send-recordings`: attach recordings that were not stored; returns 1 where one could not be attached."""
    settings = stored(given)
    db.check_schema(settings.url)
    folder = given.folder or settings.data / UNSENT
    if given.folder and not folder.is_dir():
        raise RthsError(Issue("FOLDER", "is not a folder", str(folder), "give the folder `unsent` of a worker's data folder"))
    engine = db.connect(settings.url)
    maker = db.sessions(engine)
    acts(maker, Acting(user(), "", "command line"))
    attached = kept = 0
    try:
        for one in send(folder, maker, store_of(settings)):
            attached, kept = attached + one.attached, kept + (not one.attached)
            print(f"{one.path.name}: {one.sentence}", file=sys.stdout if one.attached else sys.stderr)
    except OSError as error:
        fix = "repeat this when the store answers: what was not sent is still there"
        raise RthsError(Issue("store", f"did not take a recording: {error.strerror or error}", None, fix)) from None
    finally:
        engine.dispose()
    print(f"{attached} recordings attached to their runs, {kept} left in {folder}.")
    return FAILED if kept else DONE
