"""`rths prove`: diagnose generated recordings with known left-out physics, and score the verdicts."""

from __future__ import annotations

import json
import sys
from argparse import Namespace
from importlib import import_module
from pathlib import Path

from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, PlanError

CHECKOUT = Path(__file__).parents[2]


def prove(given: Namespace) -> None:
    """`rths prove`: diagnose generated recordings with known left-out physics, and write the scores."""
    _checked(given)
    sys.path.insert(0, str(CHECKOUT))
    proving, table, drawing = (import_module(f"tests.proof.{name}") for name in ("proving", "table", "drawing"))
    try:
        proving.specs(1, 0, given.only)
    except ValueError as error:
        raise PlanError(Issue("--only", "is not a valid kind of case", given.only, str(error))) from None
    if given.calibrate:
        files.write(
            given.json, json.dumps(proving.calibrate(given.cases, given.seed, given.workers, _progress), indent=1) + "\n"
        )
        return
    result = proving.prove(given.cases, given.seed, given.workers, given.only, given.keep, _progress)
    files.write(given.json, json.dumps(result, indent=1) + "\n")
    if given.picture:
        files.write(given.picture, drawing.svg(result))
    if given.reliability:
        files.write(given.reliability, drawing.reliability(result))
    if given.certificate:
        import_module("tests.proof.certificate").write(result["per_case"], given.cases, given.seed)
    print(table.scores(result))
    if given.table:
        print(table.effects(result["per_case"]))


def _checked(given: Namespace) -> None:
    if not (CHECKOUT / "tests" / "proof").is_dir():
        fix = "run the command in a checkout of the repository: the installed package has no generator"
        raise PlanError(Issue("rths prove", "there is no folder tests/proof with the generator", str(CHECKOUT), fix))
    for name, least in (("cases", 1), ("workers", 1), ("seed", 0)):
        if getattr(given, name) < least:
            raise PlanError(Issue(f"--{name}", f"needs a value >= {least}", getattr(given, name)))
    for option, path in (("--json", given.json), ("--picture", given.picture), ("--reliability", given.reliability)):
        if path and not path.parent.is_dir():
            problem = f"there is no folder {path.parent}"
            raise PlanError(Issue(option, problem, str(path), f"create it first: mkdir -p '{path.parent}'"))
    if given.keep and given.keep.exists() and any(given.keep.iterdir()):
        raise PlanError(Issue("--keep", "is not empty", str(given.keep), "choose a new folder"))


def _progress(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
