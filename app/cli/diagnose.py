"""`rths diagnose`: what a recording says of the models of a plan."""

from __future__ import annotations

import json
from argparse import Namespace
from typing import Any

from app.cli.run_input import plan_at
from app.reports.diagnosis import report_html
from app.shown import VERDICTS
from rths_engine.diagnosis import diagnose as engine
from rths_engine.diagnosis.pictures import pictures
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.recordings import opening


def diagnose(given: Namespace) -> None:
    if not 0 < given.level < 1:
        raise PlanError(Issue("--level", "needs a rate of false alarms between 0 and 1", given.level, "0.01 is usual"))
    for option, path in (("--json", given.json), ("--report", given.report)):
        if path and not path.parent.is_dir():
            raise PlanError(Issue(option, "there is no such folder", str(path.parent), "make it first"))
    plan = plan_at(given.plan)
    heldout = [opening.load(path) for path in given.holdout]
    more = [opening.load(path) for path in given.more]
    diagnosis = engine(plan, opening.load(given.recording), heldout, given.level, more=more)
    found = diagnosis.verdict
    if given.json:
        files.write(given.json, json.dumps(found, indent=2, allow_nan=False) + "\n")
    if given.report:
        files.write(given.report, report_html(plan.name, _facts(given), found, pictures(diagnosis)))
    print(_text(found))


def _facts(given: Namespace) -> list[tuple[str, str]]:
    heldout = [("Held out", ", ".join(path.name for path in given.holdout))] if given.holdout else []
    more = [("Fitted too", ", ".join(path.name for path in given.more))] if given.more else []
    return [("Recording", given.recording.name), *more, *heldout, ("Rate of false alarms", f"{given.level:g}")]


def _text(found: dict[str, Any]) -> str:
    lines = [VERDICTS[found["verdict"]]]
    for one in found["components"]:
        off, noise = 100 * one["residual_nrmse"], 100 * one["noise_nrmse"]
        lines.append(f"{one['component']}: off by {off:.3g} % as planned, noise {noise:.2g} %, p = {one['p_value']:.2g}")
    for effect in found["effects"]:
        lines.append(f"{effect['sentence']} Probability {effect['probability']:.2f}.")
    if found["effects"]:
        before, after = (found["fit"][key]["heldout_nrmse"] for key in ("baseline", "extended"))
        lines.append(f"On what was not fitted, the error goes from {100 * before:.3g} % to {100 * after:.3g} %.")
    return "\n".join(lines)
