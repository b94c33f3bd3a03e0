"""The inputs of a diagnosis: its plan and its recordings, each imported or made by a run."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import object_session

from app.calculations.bound import Bound
from app.config import Settings
from app.diagnoses.schemas import Asked, Source
from app.jobs.repository import JobRepository
from app.measured.service import MeasuredService
from app.measured.service import filed as filed_measured
from app.models import Diagnosis, DiagnosisInput, MeasuredRecording, Run
from app.plans.service import PlanService
from app.problems import Conflict, NotFound
from app.runs.exports import filed as filed_run
from app.runs.exports import removed
from app.runs.service import RunService
from app.store.filed import Filed
from app.store.opening import store_of
from app.text import refuse_unstorable
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan

READING = Bound("reading of the plan", seconds=20, megabytes=2000, mend="shorten the plan", where="plan")


def filed(given: DiagnosisInput) -> Filed:
    """The HDF5 file of a recording that was imported or made by a run, as its row describes it."""
    session = object_session(given)
    assert session is not None
    if given.recording_id:
        return filed_measured(session.scalars(sa.select(MeasuredRecording).filter_by(id=given.recording_id)).one())
    return filed_run(session.scalars(sa.select(Run).filter_by(id=given.run_id)).one())


def file_of(given: DiagnosisInput, settings: Settings) -> Path:
    """Path of the verified file of a recording. Raises Damaged."""
    return store_of(settings).verified(filed(given))


@dataclass(frozen=True, slots=True)
class Sources:
    """The services and rows that give a diagnosis its plan and its recordings."""

    runs: RunService
    recordings: MeasuredService
    plans: PlanService
    diagnoses: JobRepository[Diagnosis]

    def plan(self, asked: Asked) -> Plan | None:
        """The plan of a request; None for a linear model, which a worker fits to the recording.

        Raises PlanError where it is not a valid plan, where none is given, or more than one.
        """
        names = ("plan", "template", "plan_of_run", "extended_plan_of", "linear")
        given = [name for name in names if getattr(asked, name) not in (None, False)]
        if len(given) > 1:
            raise PlanError(Issue("plan", f"is given {len(given)} times", ", ".join(given), "give one of them"))
        if asked.plan is not None:
            return self.runs.calculate(READING, read_plan, self._read(asked.plan))
        if asked.linear:
            return None
        if asked.extended_plan_of is not None:
            return read_plan(self._extended(asked.extended_plan_of))
        if asked.template is not None:
            return read_plan(self.plans.template(asked.template)["plan"])
        run = asked.plan_of_run or asked.recording.run
        if run is None:
            fix = "give plan (JSON or YAML), template, plan_of_run, extended_plan_of or linear"
            raise PlanError(Issue("plan", "is required: an imported recording has no plan", None, fix))
        return self.runs.plan_of(self.runs.get(run))

    def inputs(self, asked: Asked, plan: Plan | None) -> list[DiagnosisInput]:
        """The recording and the held-out recordings. Raises RthsError where a recording does not match the plan."""
        given = [("recording", asked.recording), *((f"heldout.{i}", one) for i, one in enumerate(asked.heldout))]
        found = [self._input(where, source, plan) for where, source in given]
        for place, one in enumerate(found):
            one.place = place
        return found

    def _input(self, where: str, source: Source, plan: Plan | None) -> DiagnosisInput:
        if (source.recording is None) == (source.run is None):
            fix = "give the identifier of an imported recording (recording) or of a run (run)"
            raise RthsError(Issue(where, "needs exactly one of recording and run", None, fix))
        if source.recording is not None:
            measured = self.recordings.get(source.recording)
            _fits(where, measured, plan)
            return DiagnosisInput(name=measured.name, recording_id=measured.id)
        run = self.runs.get(source.run or "")
        _recorded(run)
        _of_kind(where, run.test, plan)
        return DiagnosisInput(name=run.name, run_id=run.id)

    def _extended(self, diagnosis_id: str) -> dict[str, Any]:
        diagnosis = self.diagnoses.get(diagnosis_id)
        if diagnosis is None:
            raise NotFound(f"There is no diagnosis {diagnosis_id}.")
        found: dict[str, Any] | None = (diagnosis.verdict or {}).get("extended_plan")
        if found is None:
            raise Conflict(f"The diagnosis {diagnosis.name} has no extended plan.")
        return found

    def _read(self, given: dict[str, Any] | str) -> dict[str, Any]:
        if isinstance(given, str):
            return self.runs.calculate(READING, self.plans.read, given.encode(errors="surrogatepass"))
        refuse_unstorable(given)
        return given


def _fits(where: str, recording: MeasuredRecording, plan: Plan | None) -> None:
    if recording.test:
        _of_kind(where, recording.test, plan)
    if plan is None:
        return
    stations = [one["number"] or 0 for one in recording.channels if one["role"].endswith(("_cmd", "_comp", "_meas"))]
    if stations and max(stations) > len(plan.stations):
        problem = f"has a channel of station {max(stations)}; the number of stations in the plan is {len(plan.stations)}"
        raise RthsError(Issue(where, problem, None, "give the plan of this recording"))


def _of_kind(where: str, test: str, plan: Plan | None) -> None:
    if plan is None:
        if test == "hybrid":
            problem = "is of a hybrid test; a linear model is fitted to tests of a specimen, an actuator or a structure"
            raise RthsError(Issue(where, problem, None, "give the plan of this test"))
    elif test != plan.test:
        problem = f"is of a {test!r} test; the plan describes a {plan.test!r} test"
        raise RthsError(Issue(where, problem, None, "give the plan of this test"))


def _recorded(run: Run) -> None:
    if not run.recording_sha256:
        raise Conflict(removed(run) or f"The run {run.name} has no recording: its status is {run.state}.")
