"""The check of the present data: every file against its row, and files that no row states."""

from __future__ import annotations

from dataclasses import dataclass

from app import db
from app.config import Settings
from app.moving import files
from app.moving.places import Place
from app.moving.rows import Rows
from app.store.checks import Damaged
from app.store.filed import MEASURED, RAW, RECORDINGS
from app.store.opening import store_of

WITH_ROWS = (RECORDINGS, MEASURED, RAW)  # prefixes whose files all have rows


@dataclass(frozen=True, slots=True)
class Found:
    """The number of files that are as their rows state, the problems of the others, and keys of files without a row."""

    good: int
    damaged: dict[str, str]
    without_row: list[str]


def verify(settings: Settings) -> Found:
    """Read every file that a row states."""
    db.check_schema(settings.url)
    engine = db.connect(settings.url)
    try:
        place = Place(settings.url, Rows(engine), store_of(settings))
        good, damaged, stated = 0, {}, set()
        for filed in files.stated(place):
            stated.add(filed.key)
            try:
                place.store.verified(filed)
                good += 1
            except Damaged as error:
                damaged[filed.key] = str(error)
        stored = [key for prefix in WITH_ROWS for key in place.store.listed(prefix)]
    finally:
        engine.dispose()
    return Found(good, damaged, sorted(set(stored) - stated))
