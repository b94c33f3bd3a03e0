"""`rths diagnose`: what the models of a plan leave out of a recording."""

from __future__ import annotations

import json
from argparse import Namespace

from app.cli.run_input import model_at
from app.cli.written import check, write
from app.reports.diagnosis import document
from app.reports.diagnosis_names import Names, capital
from app.reports.digits import chance, words
from app.shown import VERDICTS
from rths_engine.diagnosis.linear import linear_plan
from rths_engine.diagnosis.pictures import pictures
from rths_engine.diagnosis.schema import ComponentVerdict, Verdict
from rths_engine.diagnosis.verdict import diagnose as engine
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, PlanError, RecordingError, renamed
from rths_engine.recordings import opening

LINEAR = "linear"  # in place of a plan: a linear model that is fitted to the recording


def diagnose(given: Namespace) -> None:
    """`rths diagnose`: compare a recording with a plan, print the verdict, and write it as JSON or as a report."""
    if not 0 < given.level < 1:
        raise PlanError(Issue("--level", "needs a false-alarm rate between 0 and 1", given.level, "0.01 is usual"))
    for option, path in (("--json", given.json), ("--report", given.report)):
        if path and not path.parent.is_dir():
            problem = f"there is no folder {path.parent}"
            raise PlanError(Issue(option, problem, str(path), f"create it first: mkdir -p '{path.parent}'"))
    check(given.report)
    planned = None if given.plan == LINEAR else model_at(given.plan).plan
    heldout = [opening.load(path) for path in given.holdout]
    more = [opening.load(path) for path in given.more]
    try:
        recording = opening.load(given.recording)
        plan = planned or linear_plan(recording, given.recording.name)
        diagnosis = engine(plan, recording, heldout, given.level, more=more)
    except RecordingError as error:
        raise renamed(error, _names(given)) from None
    found = diagnosis.verdict
    if given.json:
        files.write(given.json, json.dumps(found.as_dict(), indent=2, allow_nan=False) + "\n")
    if given.report:
        report = document(plan.name, _facts(given), found, pictures(diagnosis), plan.as_dict())
        write(report, given.report)
    print(_text(found, Names.of(plan.as_dict())))


def _names(given: Namespace) -> dict[str, str]:
    """Name of each recording in the engine's errors -> the argument that gave the recording."""
    heldout = {f"heldout.{number}": f"--holdout {path}" for number, path in enumerate(given.holdout)}
    more = {f"more.{number}": f"--with {path}" for number, path in enumerate(given.more)}
    return {"recording": str(given.recording), **heldout, **more}


def _facts(given: Namespace) -> list[tuple[str, str]]:
    heldout = [("Held out", ", ".join(path.name for path in given.holdout))] if given.holdout else []
    more = [("Also fitted", ", ".join(path.name for path in given.more))] if given.more else []
    return [("Recording", given.recording.name), *more, *heldout, ("False-alarm rate", f"{given.level:g}")]


def _text(found: Verdict, names: Names) -> str:
    lines = [VERDICTS[found.verdict], *(_component(one, names) for one in found.components)]
    for effect in found.effects:
        lines.append(f"{names.sentence(effect.sentence)}{_said(effect.probability, found.replicated)}")
    if found.effects:
        before, after = (_percent(one.heldout_nrmse) for one in (found.fit.baseline, found.fit.extended))
        lines.append(f"On held-out data the error changes from {before} to {after}.")
    return "\n".join(lines)


def _said(probability: float | None, replicated: bool) -> str:
    return "" if probability is None else f" {capital(words(probability, replicated))}: probability {chance(probability)}."


def _component(one: ComponentVerdict, names: Names) -> str:
    figures = [f"{capital(names.component(one.component))}: residual as planned {_percent(one.residual_nrmse)}"]
    if one.noise_nrmse is not None:
        figures.append(f"noise {100 * one.noise_nrmse:.2g} %")
    if one.p_value is not None:
        figures.append(f"p-value {one.p_value:.2g}")
    return ", ".join(figures)


def _percent(share: float | None) -> str:
    return "out of range" if share is None else f"{100 * share:.3g} %"
