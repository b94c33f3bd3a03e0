"""Rules of the library: save versions, duplicate, rename, tag, archive, and list. No SQL, no HTTP."""

from __future__ import annotations

import difflib
import uuid
from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.calculations.answer import HERE, Calculate
from app.checking import Outline, outlines
from app.jobs.service import named
from app.library.draft_rows import DraftRows
from app.library.repository import SORTS, LibraryRows, Wanted
from app.library.schemas import (
    Changes,
    Copy,
    LibraryList,
    LibraryPlanDetail,
    LibraryPlanOut,
    NewPlan,
    NewVersion,
    RunFromVersion,
    RunsFromPlan,
    SavedOut,
    TagOut,
    VersionDetail,
    VersionOut,
)
from app.models import LibraryPlan, PlanTag, PlanVersion
from app.problems import Conflict, NotFound
from rths_engine import __version__
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_to_yaml, read_plan

LONGEST_NAME = 200


class LibraryService:
    """Rules of the library of plans. No SQL, no HTTP."""

    def __init__(self, session: Session, motions: MotionLibrary, calculate: Calculate = HERE):
        self.session, self.motions, self.calculate = session, motions, calculate
        self.rows, self.drafts = LibraryRows(session), DraftRows(session)

    def listed(self, wanted: Wanted) -> LibraryList:
        """A page of plans. Raises RthsError for a column that does not exist."""
        if wanted.sort not in SORTS:
            near = difflib.get_close_matches(wanted.sort, SORTS, 1)
            fix = f"try {near[0]}" if near else "choose one of " + ", ".join(SORTS)
            raise RthsError(Issue("sort", "is not a column to sort by", wanted.sort, fix))
        found, total = self.rows.listed(wanted)
        tags = [TagOut(tag=tag, plans=plans) for tag, plans in self.rows.tags()]
        return LibraryList(plans=self._shown(found), total=total, tags=tags)

    def get(self, plan_id: str) -> LibraryPlanDetail:
        """A plan with all its versions. Raises NotFound."""
        plan = self._row(plan_id)
        versions, runs = self.rows.versions(plan), self.rows.run_counts([plan_id])
        history = [_version(one, runs.get((plan_id, one.number), 0)) for one in versions]
        return LibraryPlanDetail(**self._shown([(plan, versions[0])])[0].model_dump(), history=history)

    def version(self, plan_id: str, number: int) -> VersionDetail:
        """One version with its plan. Raises NotFound."""
        plan, version = self._version(plan_id, number)
        runs = self.rows.run_counts([plan_id]).get((plan_id, number), 0)
        shown = _version(version, runs).model_dump()
        return VersionDetail(**shown, library_id=plan.id, library_name=plan.name, plan=version.plan)

    def yaml(self, plan_id: str, number: int) -> str:
        """One version as YAML. Raises NotFound."""
        return plan_to_yaml(read_plan(self._version(plan_id, number)[1].plan))

    def save(self, asked: NewPlan) -> SavedOut:
        """Keep a valid plan under a name that is free. Raises PlanError or Conflict."""
        found = self._checked(asked.plan)
        by, now = named(asked.saved_by), datetime.now(UTC)
        name = self._free(asked.name or found.plan.name)
        plan = LibraryPlan(
            id=str(uuid.uuid4()), name=name, newest=1, created_by=by, created_at=now, changed_at=now, tagged=_tagged(asked.tags)
        )
        try:
            self.rows.add(plan)
        except IntegrityError:  # another request took the name meanwhile
            raise _taken(name) from None
        return self._add(plan, found.plan, 1, by, asked.comment, asked.draft)

    def save_version(self, plan_id: str, asked: NewVersion) -> SavedOut:
        """Add a valid plan as the next version, unless a version has equal content. Raises PlanError or NotFound."""
        found = self._checked(asked.plan)
        plan = self._row(plan_id, lock=True)
        for version in self.rows.with_digest(plan, found.plan.digest):
            if _equal(version.plan, found.plan):
                self._close(asked.draft)
                return SavedOut(id=plan.id, name=plan.name, version=_version(version, 0), created=False)
        return self._add(plan, found.plan, plan.newest + 1, named(asked.saved_by), asked.comment, asked.draft)

    def duplicate(self, plan_id: str, asked: Copy) -> SavedOut:
        """Keep a copy of a version as a plan of its own. Raises NotFound or Conflict."""
        source = self._row(plan_id)
        _, version = self._version(plan_id, asked.version or source.newest)
        name = asked.name or self._copied(source.name)
        comment = f"Copy of {source.name}, version {version.number}."
        return self.save(
            NewPlan(
                plan=version.plan,
                name=name,
                comment=comment,
                tags=[tag for tag in source.tags if tag.strip()],
                saved_by=asked.saved_by,
            )
        )

    def change(self, plan_id: str, asked: Changes) -> LibraryPlanDetail:
        """Rename a plan, or give it other tags. Raises NotFound or Conflict."""
        plan = self._row(plan_id)
        if asked.name is not None and asked.name != plan.name:
            plan.name = self._free(asked.name)
        if asked.tags is not None and sorted(set(asked.tags)) != plan.tags:
            kept = {one.tag: one for one in plan.tagged}
            plan.tagged = [kept.get(one.tag, one) for one in _tagged(asked.tags)]
        try:
            self.session.flush()
        except IntegrityError:
            raise _taken(asked.name or "") from None
        return self.get(plan_id)

    def archive(self, plan_id: str, by: str) -> LibraryPlanDetail:
        """Take a plan off the list; nothing is deleted. Raises NotFound."""
        plan = self._row(plan_id)
        if plan.archived_at is None:
            plan.archived_by, plan.archived_at = named(by), datetime.now(UTC)
        return self.get(plan_id)

    def unarchive(self, plan_id: str) -> LibraryPlanDetail:
        """Bring an archived plan back to the list. Raises NotFound."""
        plan = self._row(plan_id)
        plan.archived_by = plan.archived_at = None
        return self.get(plan_id)

    def runs(self, plan_id: str, limit: int, offset: int) -> RunsFromPlan:
        """The newest runs that were queued from a plan. Raises NotFound."""
        plan = self._row(plan_id)
        runs = [
            RunFromVersion(
                **{name: getattr(run, name) for name in RunFromVersion.model_fields if name not in ("version", "changed")},
                version=run.library_version or 0,
                changed=run.digest != digest,
            )
            for run, digest in self.rows.runs(plan, limit, offset)
        ]
        return RunsFromPlan(runs=runs, total=sum(self.rows.run_counts([plan_id]).values()))

    def _checked(self, plan: Any) -> Outline:
        (found,) = outlines(self.calculate, [plan], self.motions)
        if isinstance(found, RthsError):
            raise PlanError([Issue(f"plan.{one.where}".rstrip("."), one.problem, one.value, one.fix) for one in found.issues])
        return found

    def _add(self, plan: LibraryPlan, content: Plan, number: int, by: str, comment: str, draft: str | None) -> SavedOut:
        version = PlanVersion(
            number=number,
            plan=content.as_dict(),
            name=content.name,
            test=content.test,
            digest=content.digest,
            code_version=__version__,
            saved_by=by,
            saved_at=datetime.now(UTC),
            comment=comment.strip(),
        )
        self.rows.add_version(plan, version)
        plan.newest, plan.changed_at = number, version.saved_at
        self._close(draft)
        return SavedOut(id=plan.id, name=plan.name, version=_version(version, 0), created=True)

    def _close(self, draft_id: str | None) -> None:
        """Close the draft that a version was typed in. Raises NotFound."""
        if draft_id is None:
            return
        draft = self.drafts.get(draft_id)
        if draft is None:
            raise NotFound(f"There is no draft {draft_id}.")
        if draft.closed_at is None:
            draft.closed_as, draft.closed_at, draft.writer = "saved", datetime.now(UTC), ""
            draft.revision += 1

    def _row(self, plan_id: str, lock: bool = False) -> LibraryPlan:
        plan = self.rows.locked(plan_id) if lock else self.rows.get(plan_id)
        if plan is None:
            raise NotFound(f"There is no plan {plan_id} in the library.")
        return plan

    def _version(self, plan_id: str, number: int) -> tuple[LibraryPlan, PlanVersion]:
        plan = self._row(plan_id)
        version = self.rows.version(plan, number)
        if version is None:
            raise NotFound(f"The plan '{plan.name}' has no version {number}; the newest is {plan.newest}.")
        return plan, version

    def _free(self, name: str) -> str:
        other = self.rows.named(name)
        if other is not None:
            raise _taken(name, archived=other.archived_at is not None)
        return name

    def _copied(self, name: str) -> str:
        base = name[: LONGEST_NAME - 12]
        taken = self.rows.taken(base)
        names = (f"{base} (copy{f' {count}' if count > 1 else ''})" for count in range(1, len(taken) + 2))
        return next(one for one in names if one not in taken)

    def _shown(self, found: Sequence[tuple[LibraryPlan, PlanVersion]]) -> list[LibraryPlanOut]:
        ids = [plan.id for plan, _ in found]
        runs, drafts = self.rows.run_counts(ids), self.rows.draft_counts(ids)
        return [
            LibraryPlanOut(
                **{name: getattr(plan, name) for name in LibraryPlanOut.model_fields if name not in COUNTED},
                versions=plan.newest,
                runs=sum(number for (one, _), number in runs.items() if one == plan.id),
                drafts=drafts.get(plan.id, 0),
                newest=_version(newest, runs.get((plan.id, newest.number), 0)),
            )
            for plan, newest in found
        ]


COUNTED = ("versions", "runs", "drafts", "newest")


def _version(version: PlanVersion, runs: int) -> VersionOut:
    return VersionOut.model_validate(version).model_copy(update={"runs": runs})


def _tagged(tags: Sequence[str]) -> list[PlanTag]:
    return [PlanTag(tag=tag) for tag in sorted(set(tags))]


def _equal(stored: Any, plan: Plan) -> bool:
    """Whether a stored plan has equal content; a plan that this version cannot read has not."""
    try:
        return read_plan(stored) == plan
    except RthsError:
        return False


def _taken(name: str, archived: bool = False) -> Conflict:
    holder = "an archived plan in the library" if archived else "a plan in the library"
    return Conflict(f"The name '{name}' is already that of {holder}. Choose another name, or save a new version of that plan.")
