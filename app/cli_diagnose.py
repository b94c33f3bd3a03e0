"""`rths diagnose`: what a recording says of the models of a plan."""

from __future__ import annotations

import json
from argparse import Namespace
from typing import Any

from app.cli_stability import plan_at
from rths_engine import files, measured
from rths_engine.diagnosis import diagnose as engine
from rths_engine.errors import Issue, PlanError

WORDS = {
    "consistent": "The recording is what the plan's models simulate, up to noise.",
    "recalibrate": "The plan's models fit once their own parameters are moved: no new physics.",
    "undetermined": "Something beyond noise remains, too small to tell what it is.",
    "mismatch": "The models leave physics out.",
    "configuration_error": "What the controller computed is not what the plan computes.",
}


def diagnose(given: Namespace) -> None:
    if not 0 < given.level < 1:
        raise PlanError(Issue("--level", "needs a rate of false alarms between 0 and 1", given.level, "0.01 is usual"))
    if given.json and not given.json.parent.is_dir():
        raise PlanError(Issue("--json", "there is no such folder", str(given.json.parent), "make it first"))
    plan = plan_at(given.plan)
    heldout = [measured.load(path) for path in given.holdout]
    more = [measured.load(path) for path in given.more]
    found = engine(plan, measured.load(given.recording), heldout, given.level, more=more).verdict
    if given.json:
        with files.temporary(given.json) as written:
            written.write_text(json.dumps(found, indent=2, allow_nan=False) + "\n", encoding="utf-8")
            written.replace(given.json)
    print(_text(found))


def _text(found: dict[str, Any]) -> str:
    lines = [WORDS[found["verdict"]]]
    for one in found["components"]:
        off, noise = 100 * one["residual_nrmse"], 100 * one["noise_nrmse"]
        lines.append(f"{one['component']}: off by {off:.3g} % as planned, noise {noise:.2g} %, p = {one['p_value']:.2g}")
    for effect in found["effects"]:
        lines.append(f"{effect['sentence']} Probability {effect['probability']:.2f}.")
    if found["effects"]:
        before, after = (found["fit"][key]["heldout_nrmse"] for key in ("baseline", "extended"))
        lines.append(f"On what was not fitted, the error goes from {100 * before:.3g} % to {100 * after:.3g} %.")
    return "\n".join(lines)
