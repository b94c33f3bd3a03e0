"""Rules of rigs: add, change and remove them, and refuse a plan that is too much for one. No SQL, no HTTP."""

from __future__ import annotations

import uuid

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.jobs.states import State
from app.models import EMULATED, Rig
from app.problems import Conflict, NotFound
from app.rigs.capacities import exceeded
from app.rigs.repository import RigRepository
from app.rigs.schemas import RigIn, RigKind, RigOut
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan

RETIRE = "Retire it instead: it then takes no more tests."


class RigService:
    """Rules of rigs. No SQL, no HTTP."""

    def __init__(self, session: Session):
        self.rigs = RigRepository(session)

    def listed(self) -> list[RigOut]:
        running, queued = (self.rigs.tests(state) for state in (State.RUNNING, State.QUEUED))
        return [_out(rig, running.get(rig.id, 0), queued.get(rig.id, 0)) for rig in self.rigs.listed()]

    def get(self, rig_id: str) -> Rig:
        """The rig with this id. Raises NotFound."""
        return _found(self.rigs.get(rig_id), rig_id)

    def _locked(self, rig_id: str) -> Rig:
        """The rig with this id as it is now, locked against other writers. Raises NotFound."""
        return _found(self.rigs.locked(rig_id), rig_id)

    def shown(self, rig_id: str) -> RigOut:
        """The rig with this id and its tests. Raises NotFound."""
        rig = self.get(rig_id)
        running, queued = (self.rigs.tests(state).get(rig_id, 0) for state in (State.RUNNING, State.QUEUED))
        return _out(rig, running, queued)

    def keep(self, rig_id: str) -> None:
        """Lock a rig: nobody changes, retires or deletes it until a submission to it is stored.

        Who locks a run too locks the rig first, so that no two wait for each other.
        """
        self.rigs.locked(rig_id)

    def for_tests(self, rig_id: str) -> Rig:
        """The rig that a submission names. Raises RthsError if it does not exist or is retired."""
        rig = self.rigs.get(rig_id)
        if rig is not None and not rig.retired:
            return rig
        offered = ", ".join(f"{one.id} ({one.name})" for one in self.rigs.listed() if not one.retired)
        problem = "is not the id of a rig" if rig is None else f"is the id of {rig.name}, which is retired"
        raise RthsError(Issue("rig", problem, rig_id, f"choose one of {offered}"))

    def check(self, plan: Plan, rig: Rig) -> None:
        """Raise PlanError with every limit of the plan that exceeds a capacity of the rig."""
        if issues := exceeded(plan, rig):
            raise PlanError(issues)

    def add(self, given: RigIn) -> RigOut:
        """Add a rig. Raises Conflict for a name that another has."""
        self._check(given)
        rig = Rig(id=str(uuid.uuid4()), **_stored(given))
        try:
            self.rigs.add(rig)
        except IntegrityError:  # another request took the name meanwhile
            raise _taken(given.name) from None
        return self.shown(rig.id)

    def change(self, rig_id: str, given: RigIn) -> RigOut:
        """Change a rig. Raises Conflict where a test that waits for it would not fit any more."""
        rig = self._locked(rig_id)
        self._check(given, rig)
        if rig.id == EMULATED and (given.kind is not RigKind.EMULATED or given.retired):
            raise Conflict(f"{rig.name} is the rig of every test that names none: it stays emulated and takes tests.")
        for name, value in _stored(given).items():
            setattr(rig, name, value)
        try:
            self.rigs.store()
        except IntegrityError:
            raise _taken(given.name) from None
        for run in self.rigs.waiting(rig.id):
            if issues := exceeded(read_plan(run.plan), rig):
                raise Conflict(f"Run {run.number}, {run.name}, waits for {rig.name} and would not fit: {issues[0]}.")
        return self.shown(rig.id)

    def remove(self, rig_id: str) -> None:
        """Delete a rig that no run names. Raises Conflict otherwise."""
        rig = self._locked(rig_id)
        name = rig.name
        if rig.id == EMULATED:
            raise Conflict(f"{rig.name} is the rig of every test that names none. It cannot be deleted.")
        if used := self.rigs.used(rig_id):
            runs = "1 run names" if used == 1 else f"{used} runs name"
            raise Conflict(f"{runs} {name}, so it cannot be deleted. {RETIRE}")
        try:
            self.rigs.remove(rig)
        except IntegrityError:
            raise Conflict(f"A test has just been submitted for {name}, so it cannot be deleted. {RETIRE}") from None

    def _check(self, given: RigIn, rig: Rig | None = None) -> None:
        other = self.rigs.named(given.name)
        if other is not None and other is not rig:
            raise _taken(other.name)
        if given.kind is RigKind.PHYSICAL:
            if given.tests_at_a_time not in (None, 1):
                problem = "needs to be 1: a physical rig executes one test at a time"
                raise RthsError(Issue("tests_at_a_time", problem, given.tests_at_a_time))
            if not given.actuators:
                fix = "give its stroke, velocity and force; null where it is not known"
                raise RthsError(Issue("actuators", "needs at least one actuator for a physical rig", None, fix))


def _found(rig: Rig | None, rig_id: str) -> Rig:
    if rig is None:
        raise NotFound(f"There is no rig {rig_id}.")
    return rig


def _taken(name: str) -> Conflict:
    return Conflict(f"There is already a rig with the name {name}.")


def _stored(given: RigIn) -> dict[str, object]:
    stored = given.model_dump()
    return {**stored, "tests_at_a_time": 1 if given.kind is RigKind.PHYSICAL else given.tests_at_a_time}


def _out(rig: Rig, running: int, queued: int) -> RigOut:
    stored = {name: getattr(rig, name) for name in ("id", *RigIn.model_fields)}
    return RigOut.model_validate({**stored, "running": running, "queued": queued})
