"""Rules of drafts: kept as typed, valid or not; saved by revision, so that two windows never overwrite each other."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from typing import Any, Literal

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.checking import checked
from app.jobs.service import named
from app.library.draft_rows import DraftRows
from app.library.schemas import DraftDetail, DraftIn, DraftOut, Origin
from app.models import PlanDraft
from app.problems import Conflict, NotFound
from app.text import refuse_unstorable
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.differences import titles
from rths_engine.planning.plan_yaml import DEEPEST

MOST_PROBLEMS = 20  # kept with a draft


class DraftService:
    """Rules of drafts. No SQL, no HTTP."""

    def __init__(self, session: Session, motions: MotionLibrary):
        self.rows, self.motions = DraftRows(session), motions

    def get(self, draft_id: str) -> DraftDetail:
        """A draft with its plan. Raises NotFound."""
        draft = self._row(draft_id)
        return DraftDetail(**self._shown([draft])[0].model_dump(), plan=draft.plan)

    def listed(self, owner: str | None, closed: bool = False, origin_id: str | None = None) -> list[DraftOut]:
        """Drafts, last saved first; an empty owner stands for people who gave no name."""
        return self._shown(self.rows.listed(None if owner is None else named(owner), closed, origin_id))

    def save(self, draft_id: str, asked: DraftIn) -> DraftOut:
        """Keep the plan as typed now; revision 0 makes a new draft.

        Raises Conflict where another window has saved the draft since, or closed it, and PlanError for what cannot be stored.
        """
        values = {"saved_at": datetime.now(UTC), **self._typed(asked.plan, asked.owner)}
        if not self.rows.change(draft_id, asked.revision, asked.writer, **values):
            present = self.rows.get(draft_id)
            if present is not None and (present.closed_at or present.plan != asked.plan):
                raise _conflict(present, asked.revision)
            if present is not None:
                return self._shown([present])[0]  # another window saved the same
            if asked.revision:
                raise NotFound(f"There is no draft {draft_id}.")
            self._create(draft_id, asked, values)
        return self._shown([self._row(draft_id)])[0]

    def _create(self, draft_id: str, asked: DraftIn, values: dict[str, Any]) -> None:
        origin = asked.origin
        draft = PlanDraft(
            id=draft_id,
            revision=1,
            writer=asked.writer,
            created_at=values["saved_at"],
            origin_kind=origin.kind if origin else None,
            origin_id=origin.id if origin else None,
            origin_version=origin.version if origin else None,
            **values,
        )
        try:
            self.rows.add(draft)
        except IntegrityError:  # another window took the id meanwhile
            raise Conflict(f"Another window saved the draft {draft_id} first. Save yours as a new draft.") from None

    def close(self, draft_id: str, closed_as: Literal["discarded", "queued"]) -> DraftOut:
        """Take a draft off the list of open drafts. It stays stored, and `reopen` brings it back."""
        return self._closed(draft_id, closed_as, datetime.now(UTC))

    def reopen(self, draft_id: str) -> DraftOut:
        """Bring a closed draft back to the list of open drafts."""
        return self._closed(draft_id, None, None)

    def _closed(self, draft_id: str, closed_as: str | None, at: datetime | None) -> DraftOut:
        draft = self._row(draft_id)
        if (draft.closed_at is None) != (at is None):
            draft.closed_as, draft.closed_at, draft.writer = closed_as, at, ""
            draft.revision += 1
        return self._shown([draft])[0]

    def _row(self, draft_id: str) -> PlanDraft:
        draft = self.rows.get(draft_id)
        if draft is None:
            raise NotFound(f"There is no draft {draft_id}.")
        return draft

    def _typed(self, plan: dict[str, Any], owner: str) -> dict[str, Any]:
        """The columns that follow from what was typed."""
        refuse_unstorable(plan)
        issues = tuple(_unstorable(plan))
        if issues:
            raise PlanError(issues)
        name, found = plan.get("name"), self._problems(plan)[:MOST_PROBLEMS]
        known = titles(plan) if found else {}
        return {
            "plan": plan,
            "owner": named(owner),
            "name": name.strip()[:200] if isinstance(name, str) else "",
            "problems": [_worded(issue, known) for issue in found],
        }

    def _problems(self, plan: dict[str, Any]) -> tuple[Issue, ...]:
        try:
            checked(plan, self.motions)
        except RthsError as error:
            return error.issues
        return ()

    def _shown(self, drafts: Sequence[PlanDraft]) -> list[DraftOut]:
        """Drafts as they are sent, with what each started from in words."""
        names: dict[tuple[str, str], str] = {}
        for kind in ("version", "run"):
            ids = {draft.origin_id for draft in drafts if draft.origin_kind == kind and draft.origin_id}
            names |= {(kind, one): name for one, name in self.rows.names(kind, ids).items()}
        return [_out(draft, names) for draft in drafts]


def _worded(issue: Issue, known: dict[str, tuple[str, str]]) -> dict[str, Any]:
    """The issue with the label and the unit of its field, or of the nearest field around it. `known` are those of the plan."""
    path = issue.where
    while path and path not in known:
        path = path.rpartition(".")[0]
    title, unit = known.get(path, (issue.where, ""))
    return {**issue.as_dict(), "title": title, "unit": unit if path == issue.where else ""}


def _conflict(draft: PlanDraft, revision: int) -> Conflict:
    if draft.closed_at:
        return Conflict(
            f"The draft was closed at {draft.closed_at:%H:%M:%S} UTC ({draft.closed_as}). Save yours as a new draft."
        )
    return Conflict(
        f"Another window saved this draft at {draft.saved_at:%H:%M:%S} UTC: it has revision {draft.revision}, "
        f"yours is {revision}. Load that draft, or save yours as a new draft."
    )


def _out(draft: PlanDraft, names: dict[tuple[str, str], str]) -> DraftOut:
    kind, origin_id = draft.origin_kind, draft.origin_id
    origin = Origin.model_validate({"kind": kind, "id": origin_id, "version": draft.origin_version}) if kind else None
    columns = {name: getattr(draft, name) for name in DraftOut.model_fields if name not in ("origin", "origin_title")}
    return DraftOut(**columns, origin=origin, origin_title=_title(origin, names) if origin else "")


def _title(origin: Origin, names: dict[tuple[str, str], str]) -> str:
    name = names.get((origin.kind, origin.id), origin.id)
    if origin.kind == "version":
        return f"{name}, version {origin.version}" if origin.version else name
    return f"{origin.kind} {name}"


def _unstorable(plan: dict[str, Any]) -> Iterator[Issue]:
    """Issues of numbers that JSON does not have, and of data nested too deeply."""
    left: list[tuple[str, Any, int]] = [("", plan, 0)]
    while left:
        where, value, depth = left.pop()
        if depth > DEEPEST:
            yield Issue(where, f"is nested deeper than {DEEPEST} levels", fix="give a plan as the form or the YAML writes it")
            return
        if isinstance(value, float) and not math.isfinite(value):
            yield Issue(where, "needs a finite number, not NaN or infinity", json.dumps(value), "give a number or text")
        elif isinstance(value, dict | list):
            items = value.items() if isinstance(value, dict) else enumerate(value)
            left += [(f"{where}.{key}" if where else str(key), inner, depth + 1) for key, inner in items]
