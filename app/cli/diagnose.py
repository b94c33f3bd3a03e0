"""`rths diagnose`: what a recording says of the models of a plan."""

from __future__ import annotations

import json
from argparse import Namespace

from app.cli.run_input import model_at
from app.reports.diagnosis import report_html
from app.shown import VERDICTS
from rths_engine.diagnosis.pictures import pictures
from rths_engine.diagnosis.schema import ComponentVerdict, Verdict
from rths_engine.diagnosis.verdict import diagnose as engine
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, PlanError, RecordingError, renamed
from rths_engine.recordings import opening


def diagnose(given: Namespace) -> None:
    """`rths diagnose`: compare a recording with a plan and print, write or draw the result."""
    if not 0 < given.level < 1:
        raise PlanError(Issue("--level", "needs a rate of false alarms between 0 and 1", given.level, "0.01 is usual"))
    for option, path in (("--json", given.json), ("--report", given.report)):
        if path and not path.parent.is_dir():
            raise PlanError(Issue(option, "there is no such folder", str(path.parent), "make it first"))
    plan = model_at(given.plan).plan
    heldout = [opening.load(path) for path in given.holdout]
    more = [opening.load(path) for path in given.more]
    try:
        diagnosis = engine(plan, opening.load(given.recording), heldout, given.level, more=more)
    except RecordingError as error:
        raise renamed(error, _names(given)) from None
    found = diagnosis.verdict
    if given.json:
        files.write(given.json, json.dumps(found.as_dict(), indent=2, allow_nan=False) + "\n")
    if given.report:
        files.write(given.report, report_html(plan.name, _facts(given), found, pictures(diagnosis)))
    print(_text(found))


def _names(given: Namespace) -> dict[str, str]:
    """What the engine calls its recordings -> the argument that gave each."""
    heldout = {f"heldout.{number}": f"--holdout {path}" for number, path in enumerate(given.holdout)}
    more = {f"more.{number}": f"--with {path}" for number, path in enumerate(given.more)}
    return {"recording": str(given.recording), **heldout, **more}


def _facts(given: Namespace) -> list[tuple[str, str]]:
    heldout = [("Held out", ", ".join(path.name for path in given.holdout))] if given.holdout else []
    more = [("Fitted too", ", ".join(path.name for path in given.more))] if given.more else []
    return [("Recording", given.recording.name), *more, *heldout, ("Rate of false alarms", f"{given.level:g}")]


def _text(found: Verdict) -> str:
    lines = [VERDICTS[found.verdict], *(_component(one) for one in found.components)]
    for effect in found.effects:
        lines.append(
            effect.sentence if effect.probability is None else f"{effect.sentence} Probability {effect.probability:.2f}."
        )
    if found.effects:
        before, after = (_percent(one.heldout_nrmse) for one in (found.fit.baseline, found.fit.extended))
        lines.append(f"On what was not fitted, the error goes from {before} to {after}.")
    return "\n".join(lines)


def _component(one: ComponentVerdict) -> str:
    said = [f"{one.component}: off by {_percent(one.residual_nrmse)} as planned"]
    if one.noise_nrmse is not None:
        said.append(f"noise {100 * one.noise_nrmse:.2g} %")
    if one.p_value is not None:
        said.append(f"p = {one.p_value:.2g}")
    return ", ".join(said)


def _percent(share: float | None) -> str:
    return "more than can be computed" if share is None else f"{100 * share:.3g} %"
