"""The demonstration test of `make run`: simulation 4 of Table III in real time, so that it can be watched."""

from __future__ import annotations

from contextlib import suppress

from fastapi import FastAPI

from app.control.service import NotDriving
from app.db import unit_of_work
from app.jobs.service import MOST_ATTEMPTS
from app.jobs.states import State
from app.runs.repository import Filter, Page
from app.runs.service import RunService
from app.store.motions import motions_of
from rths_engine.planning import templates
from rths_engine.planning.plan import RealTime

TEMPLATE = "table3-04"
SUBMITTER = "demonstration"


def queue_demonstration(app: FastAPI) -> None:
    """Queue the demonstration, unless one waits, also for approval, or is running, and has an attempt left."""
    with unit_of_work(app.state.sessions) as session:
        runs = RunService(session, motions_of(app.state.settings), app.state.queue)
        unfinished = Filter(states=(State.TO_APPROVE, State.QUEUED, State.RUNNING), submitted_by=SUBMITTER, template=TEMPLATE)
        if all(run.attempt >= MOST_ATTEMPTS for run in runs.listed(unfinished, Page())[0]):
            plan = templates.template(TEMPLATE).model_copy(update={"pace": RealTime()})
            with suppress(NotDriving):  # where one person drives a rig, that person queues it
                runs.submit([plan.as_dict()], SUBMITTER)
