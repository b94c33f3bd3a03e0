"""The process of one diagnosis."""

from __future__ import annotations

from app.diagnoses.order import Diagnosed, DiagnosisOrder
from app.worker.child import Line, Refused


def prepare() -> None:
    """Do nothing: a diagnosis loads what it needs."""


def execute(order: DiagnosisOrder, line: Line) -> Diagnosed:
    """Diagnose a recording, by a linear model if no plan is given.

    Raises Refused if a recording is not as its row states, or does not fit the plan.
    """
    from app.store.opening import store_of
    from rths_engine.diagnosis.linear import linear_plan
    from rths_engine.diagnosis.pictures import pictures
    from rths_engine.diagnosis.verdict import diagnose
    from rths_engine.foundation.errors import RthsError, renamed
    from rths_engine.planning.reading import read_plan
    from rths_engine.recordings import opening

    line.progress("reading the recording", 0.0)
    store = store_of(order.settings)
    try:
        recording = opening.load(store.verified(order.recording))
        plan = linear_plan(recording, order.name) if order.plan is None else read_plan(order.plan)
        heldout = [opening.load(store.verified(one)) for one in order.heldout]
        found = diagnose(plan, recording, heldout, order.level, told=line.progress)
    except RthsError as error:
        raise Refused("; ".join(str(issue) for issue in renamed(error, _names(order)).issues)) from None
    return Diagnosed(plan.as_dict(), found.verdict, pictures(found))


def _names(order: DiagnosisOrder) -> dict[str, str]:
    """Name of each recording in the engine's errors -> its name in the reason of the job."""
    heldout = {f"heldout.{place}": f"Held-out recording {place + 1}" for place in range(len(order.heldout))}
    return {"recording": "The recording", **heldout}
