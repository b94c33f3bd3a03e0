"""`rths deadline`: measure before a test day whether this machine meets the deadlines of a test in real time."""

from __future__ import annotations

import json
import os
import sys
from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from app.cli.main import DONE, FAILED, INTERRUPTED
from app.cli.run import Interrupt, advance
from app.cli.run_input import model_of_plan
from app.cli.settings import settings
from app.store.motions import motions_of
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.foundation.part import validated
from rths_engine.planning import templates
from rths_engine.planning.model import Model
from rths_engine.planning.plan import RealTime
from rths_engine.results import timing_text
from rths_engine.running.run import Run

TEMPLATE = "two-storeys"
SECONDS = 60.0  # of a measurement without --steps
BAR = 30  # characters


def deadline(given: Namespace) -> int:
    """`rths deadline`: measure and print. Exit code: 0 no step missed, 1 missed, 2 invalid input, 130 interrupted."""
    run = Run(_model(given), motions_of(settings(given)))
    with Interrupt() as interrupt:
        advance(run, interrupt)
    assert run.timing is not None
    timing = run.timing.summary()
    if given.json:
        print(json.dumps({"plan": run.plan.name, "tripped": run.trip is not None, "load": _load(), **timing}))
    else:
        print("\n".join(_lines(run, timing)))
    if interrupt.asked and not run.finished:
        return INTERRUPTED
    return FAILED if timing["missed"] or not timing["steps"] else DONE


def _model(given: Namespace) -> Model:
    """The plan whose steps are measured, in real time at the rate and for the steps that are asked for."""
    model = model_of_plan(given.plan) if given.plan else Model.of(templates.template(TEMPLATE))
    plan = model.plan
    if plan.test == "client":
        fix = "use a plan of another kind of test with the same stations"
        raise PlanError(Issue("--plan", "follows a client, so it has no steps of its own to measure", given.plan, fix))
    rate = plan.controller_rate if given.rate is None else given.rate
    if not 1 <= rate <= 100_000:
        raise PlanError(Issue("--rate", "is out of range: needs 1 to 100000 Hz", rate))
    steps = round(SECONDS * rate) if given.steps is None else given.steps
    if steps < 1:
        raise PlanError(Issue("--steps", "is out of range: needs at least 1", steps))
    pace = {"factor": rate / plan.controller_rate, "core": given.core, "priority": given.priority}
    if steps > 3600 * plan.controller_rate:
        raise PlanError(Issue("--steps", f"is out of range: needs at most {3600 * plan.controller_rate:.0f}", steps))
    return model.changed(pace=validated(RealTime, pace), duration=steps / plan.controller_rate)


def _lines(run: Run, timing: dict[str, Any]) -> Iterator[str]:
    yield f"{run.plan.name}: {len(run.plan.stations)} stations, load of the machine {_load()}"
    if run.trip:
        yield f"The test tripped, so the measurement ended early. {run.trip.as_dict()['sentence']}"
    yield from timing_text.lines(timing)
    yield ""
    yield f"{'µs':>16}{'begin after due':>17}{'length of work':>17}  begin after due"
    largest = max((max(pair) for _, *pair in timing_text.buckets(timing)), default=1)
    for label, delays, lengths in timing_text.buckets(timing):
        yield f"{label:>16}{delays:>17}{lengths:>17}  {'#' * -(-BAR * delays // largest)}".rstrip()


def _load() -> str:
    """The mean number of processes that ran or waited to run in the last minute, and the number of cores."""
    cores = os.cpu_count() or 1
    if sys.platform == "win32":
        return f"unknown, {cores} cores"
    return f"{os.getloadavg()[0]:.2f} on {cores} cores"
