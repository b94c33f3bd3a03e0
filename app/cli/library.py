"""`rths library`: list, show, save and compare plans in the library of a data folder."""

from __future__ import annotations

import getpass
from argparse import Namespace
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app import db
from app.cli.run_input import text_of
from app.cli.settings import stored
from app.library.comparison import between
from app.library.repository import LibraryRows, Wanted
from app.library.schemas import LibraryPlanDetail, NewPlan, NewVersion, VersionDetail
from app.library.service import LibraryService
from app.problems import Conflict, NotFound
from app.store.motions import motions_of
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.foundation.part import validated
from rths_engine.planning import plan_yaml
from rths_engine.planning.differences import FieldDifference

LISTED = 500


@dataclass(frozen=True, slots=True)
class _Store:
    """The library of a data folder in one transaction."""

    service: LibraryService
    rows: LibraryRows

    def id_of(self, name: str) -> str | None:
        plan = self.rows.named(name)
        return plan.id if plan else None

    def plan(self, name: str) -> LibraryPlanDetail:
        """The plan of this name. Raises RthsError."""
        found = self.id_of(name)
        if found is None:
            raise RthsError(Issue("library", "has no plan of this name", name, "`rths library list` prints the names"))
        return self.service.get(found)

    def version(self, text: str) -> VersionDetail:
        """The version that `NAME` (the newest) or `NAME@NUMBER` names. Raises RthsError."""
        name, at, number = text.rpartition("@")
        if not at or not number.isdecimal() or self.id_of(text):
            name, number = text, ""
        kept = self.plan(name)
        return self.service.version(kept.id, int(number or kept.versions))


@contextmanager
def _library(given: Namespace) -> Iterator[_Store]:
    settings = stored(given)
    db.migrate(settings.url)
    engine = db.connect(settings.url)
    try:
        with db.unit_of_work(db.sessions(engine)) as session:
            yield _Store(LibraryService(session, motions_of(settings)), LibraryRows(session))
    except (NotFound, Conflict) as error:
        raise RthsError(str(error)) from None
    finally:
        engine.dispose()


def listed(given: Namespace) -> None:
    """`rths library list`: print the plans with newest version, author, time, runs and tags."""
    wanted = Wanted(given.text, given.tag, archived=given.archived, sort="name", descending=False, limit=LISTED)
    with _library(given) as library:
        found = library.service.listed(wanted)
    lines = [("Plan", "Version", "Changed, UTC", "Runs", "By", "Tags")]
    for one in found.plans:
        changed, tags = f"{one.changed_at:%Y-%m-%d %H:%M}", ", ".join(one.tags)
        lines.append((one.name, str(one.versions), changed, str(one.runs), one.newest.saved_by, tags))
    _print_columns(lines)


def show(given: Namespace) -> None:
    """`rths library show`: print a version as YAML, or the versions of a plan."""
    with _library(given) as library:
        if given.history:
            for one in library.plan(given.plan).history:
                print(f"{one.number:4} {one.saved_at:%Y-%m-%d %H:%M} UTC  {one.saved_by:16} {one.comment}".rstrip())
            return
        version = library.version(given.plan)
        print(library.service.yaml(version.library_id, version.number), end="")


def save(given: Namespace) -> None:
    """`rths library save`: keep a plan as a new plan, or as the next version of the plan of this name."""
    plan = _mapping(given.plan)
    asked = {"plan": plan, "comment": given.comment, "saved_by": given.by or getpass.getuser()}
    with _library(given) as library:
        known = library.id_of(str(given.name or plan.get("name")))
        if known:
            saved = library.service.save_version(known, validated(NewVersion, asked))
        else:
            saved = library.service.save(validated(NewPlan, {**asked, "name": given.name, "tags": given.tag}))
    done = "saved as" if saved.created else "unchanged: equal to"
    print(f"{saved.name}: {done} version {saved.version.number}")


def diff(given: Namespace) -> int:
    """`rths library diff`: print the fields in which two plans differ. Returns 1 if they differ, 0 if they are equal."""
    with _library(given) as library:
        first, second = (_compared(library, text) for text in (given.first, given.second))
    rows = between(first[1], second[1])
    if rows:
        _print_rows(first[0], second[0], rows)
    else:
        print("The two plans are equal.")
    return int(bool(rows))


def _compared(library: _Store, text: str) -> tuple[str, dict[str, Any]]:
    """The title and the plan of a YAML file, or of a version in the library. Raises RthsError."""
    if Path(text).is_file():
        return text, _mapping(text)
    version = library.version(text)
    return f"{version.library_name}, version {version.number}", version.plan


def _mapping(path: str) -> dict[str, Any]:
    data = plan_yaml.parse(text_of(path))
    if not isinstance(data, dict):
        raise PlanError(Issue("", "a plan is a mapping of fields", fix="`rths plan NAME` prints a plan"))
    return data


def _print_rows(first: str, second: str, rows: list[FieldDifference]) -> None:
    fields = [f"{row.title}, {row.unit}" if row.unit else row.title for row in rows]
    values = [(row.texts[0], row.texts[1]) for row in rows]
    _print_columns([("Field", first, second), *((field, *both) for field, both in zip(fields, values, strict=True))])


def _print_columns(lines: Sequence[tuple[str, ...]]) -> None:
    """Lines in columns as wide as their longest text."""
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        print("  ".join(f"{text:{width}}" for text, width in zip(line, widths, strict=True)).rstrip())
