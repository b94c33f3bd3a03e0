"""The process of one diagnosis."""

from __future__ import annotations

import json
from typing import Any

from app.diagnoses.order import Diagnosed, DiagnosisOrder
from app.worker.child import Line, Refused


def prepare() -> None:
    """Nothing is compiled ahead: the diagnosis loads what it needs."""


def execute(order: DiagnosisOrder, line: Line) -> Diagnosed:
    """Diagnose a recording. Raises Refused where the recording does not fit the plan."""
    from rths_engine.diagnosis import diagnose
    from rths_engine.diagnosis.pictures import pictures
    from rths_engine.foundation.errors import RthsError
    from rths_engine.planning.reading import read_plan
    from rths_engine.recordings import opening

    line.progress("reading the recording", 0.0)
    try:
        plan, recording = read_plan(order.plan), opening.load(order.recording)
        heldout = [opening.load(path) for path in order.heldout]
        found = diagnose(plan, recording, heldout, order.level, told=line.progress)
    except RthsError as error:
        raise Refused("; ".join(_named(str(issue)) for issue in error.issues)) from None
    return Diagnosed(_finite(found.verdict), _finite(pictures(found)))


def _named(issue: str) -> str:
    """The command line's words for its arguments as the service's."""
    return issue.replace("REC.h5", "The recording").replace("--holdout", "A recording held out")


def _finite(result: dict[str, Any]) -> dict[str, Any]:
    """The result with null for numbers that are not finite, which JSON cannot hold."""
    found: dict[str, Any] = json.loads(json.dumps(result), parse_constant=lambda _: None)
    return found
