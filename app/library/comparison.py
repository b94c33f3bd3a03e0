"""Differences between two plans: versions in the library, plans of runs, drafts and templates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from sqlalchemy.orm import Session

from app.library.draft_rows import DraftRows
from app.library.repository import LibraryRows
from app.library.schemas import ComparedOut, DifferenceOut, DifferencesOut
from app.problems import NotFound
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.planning import templates
from rths_engine.planning.differences import FieldDifference, differences

CHECKSUM = "motion.sha256"  # written into a plan when it is checked, so a template and most drafts have none
FORMS = "version:ID:NUMBER, run:ID, draft:ID or template:NAME"


@dataclass(frozen=True, slots=True)
class _Item:
    """A plan to compare: what it is called, in short and in full, the page that shows it, and the plan."""

    label: str
    title: str
    page: str
    plan: Mapping[str, Any]


class ComparisonService:
    """Differences between two plans. No SQL, no HTTP."""

    def __init__(self, session: Session):
        self.rows, self.drafts = LibraryRows(session), DraftRows(session)

    def differences(self, first: str, second: str) -> DifferencesOut:
        """The fields in which two plans differ. Raises RthsError for an item that is not of FORMS, and NotFound."""
        items = [self._item("first", first), self._item("second", second)]
        rows = [DifferenceOut.model_validate(one) for one in between(items[0].plan, items[1].plan)]
        return DifferencesOut(
            items=[ComparedOut(label=one.label, title=one.title, page=one.page) for one in items], differences=rows
        )

    def _item(self, where: str, text: str) -> _Item:
        kind, _, rest = text.partition(":")
        found = {"version": self._version, "run": self._run, "draft": self._draft, "template": self._template}.get(kind)
        if found is None or not rest:
            raise RthsError(Issue(where, f"needs {FORMS}", text))
        return found(where, rest)

    def _version(self, where: str, text: str) -> _Item:
        plan_id, _, number = text.partition(":")
        if not (number.isascii() and number.isdecimal() and len(number) <= 6):
            raise RthsError(Issue(where, "needs the number of a version", text, "write version:ID:NUMBER"))
        plan = self.rows.get(plan_id)
        version = self.rows.version(plan, int(number)) if plan else None
        if plan is None or version is None:
            raise NotFound(f"The library has no version {number} of a plan {plan_id}.")
        return _Item(f"Version {number}", f"{plan.name}, version {number}", f"/plans/{plan_id}", version.plan)

    def _run(self, _: str, run_id: str) -> _Item:
        run = self.rows.run(run_id)
        if run is None:
            raise NotFound(f"There is no run {run_id}.")
        return _Item(f"Run {run.number}", f"Run {run.number}: {run.name}", f"/runs/{run_id}", run.plan)

    def _draft(self, _: str, draft_id: str) -> _Item:
        draft = self.drafts.get(draft_id)
        if draft is None:
            raise NotFound(f"There is no draft {draft_id}.")
        return _Item("Draft", f"Draft {draft.name}".rstrip(), f"/new?draft={draft_id}", draft.plan)

    def _template(self, _: str, name: str) -> _Item:
        if name not in templates.names():
            raise NotFound(f"There is no template '{name}'. Templates: {', '.join(templates.names())}.")
        return _Item(f"Template {name}", f"Template {name}", f"/new?template={name}", templates.template(name).as_dict())


def between(first: Mapping[str, Any], second: Mapping[str, Any]) -> list[FieldDifference]:
    """The fields in which two plans differ. A checksum that only one has is none: the other was not checked yet."""
    return [one for one in differences([first, second]) if one.path != CHECKSUM or None not in one.values]
