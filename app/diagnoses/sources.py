"""The inputs of a diagnosis: its plan and its recordings, each imported or made by a run."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.config import Settings
from app.diagnoses.schemas import Asked, Source
from app.measured.service import MeasuredService
from app.models import DiagnosisInput, MeasuredRecording, Run
from app.plans.service import PlanService
from app.problems import Conflict
from app.runs.service import RunService
from app.text import refuse_unstorable
from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan


def file_of(given: DiagnosisInput, settings: Settings) -> Path:
    """Path of the HDF5 file of a recording that was imported or made by a run."""
    folder, name = (settings.measured, given.recording_id) if given.recording_id else (settings.recordings, given.run_id)
    return folder / f"{name}.h5"


@dataclass(frozen=True, slots=True)
class Sources:
    """The services that give a diagnosis its plan and its recordings."""

    runs: RunService
    recordings: MeasuredService
    plans: PlanService

    def plan(self, asked: Asked) -> Plan:
        """The plan of a request. Raises PlanError where it is not a valid plan, where none is given, or more than one."""
        given = [name for name in ("plan", "template", "plan_of_run") if getattr(asked, name) is not None]
        if len(given) > 1:
            raise PlanError(Issue("plan", f"is given {len(given)} times", ", ".join(given), "give one of them"))
        if asked.plan is not None:
            return read_plan(self._read(asked.plan))
        if asked.template is not None:
            return read_plan(self.plans.template(asked.template)["plan"])
        run = asked.plan_of_run or asked.recording.run
        if run is None:
            fix = "give plan (JSON or YAML), template or plan_of_run"
            raise PlanError(Issue("plan", "is required: an imported recording has no plan", None, fix))
        return self.runs.plan_of(self.runs.get(run))

    def inputs(self, asked: Asked, plan: Plan) -> list[DiagnosisInput]:
        """The recording and the held-out recordings. Raises RthsError where a recording does not match the plan."""
        given = [("recording", asked.recording), *((f"heldout.{i}", one) for i, one in enumerate(asked.heldout))]
        found = [self._input(where, source, plan) for where, source in given]
        for place, one in enumerate(found):
            one.place = place
        return found

    def _input(self, where: str, source: Source, plan: Plan) -> DiagnosisInput:
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

    def _read(self, given: dict[str, Any] | str) -> dict[str, Any]:
        if isinstance(given, str):
            return self.plans.read(given.encode(errors="surrogatepass"))
        refuse_unstorable(given)
        return given


def _fits(where: str, recording: MeasuredRecording, plan: Plan) -> None:
    if recording.test:
        _of_kind(where, recording.test, plan)
    stations = [one["number"] or 0 for one in recording.channels if one["role"].endswith(("_cmd", "_comp", "_meas"))]
    if stations and max(stations) > len(plan.stations):
        problem = f"has a channel of station {max(stations)}; the number of stations in the plan is {len(plan.stations)}"
        raise RthsError(Issue(where, problem, None, "give the plan of this recording"))


def _of_kind(where: str, test: str, plan: Plan) -> None:
    if test != plan.test:
        problem = f"is of a {test!r} test; the plan describes a {plan.test!r} test"
        raise RthsError(Issue(where, problem, None, "give the plan of this test"))


def _recorded(run: Run) -> None:
    if not run.recording_sha256:
        raise Conflict(f"The run {run.name} has no recording: its status is {run.state}.")
