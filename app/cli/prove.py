"""`rths prove`: how well diagnoses find physics that was concealed in recordings made for it."""

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
    """`rths prove`: diagnose recordings whose left-out physics is known, and write the scores."""
    _checked(given)
    sys.path.insert(0, str(CHECKOUT))
    proving, table, drawing = (import_module(f"tests.proof.{name}") for name in ("proving", "table", "drawing"))
    try:
        proving.specs(1, 0, given.only)
    except ValueError as error:
        raise PlanError(Issue("--only", "there is no such kind of case", given.only, str(error))) from None
    result = proving.prove(given.cases, given.seed, given.workers, given.only, given.keep, _told)
    files.write(given.json, json.dumps(result, indent=1) + "\n")
    if given.picture:
        files.write(given.picture, drawing.svg(result))
    print(table.scores(result))
    if given.table:
        print(table.effects(result["per_case"]))


def _checked(given: Namespace) -> None:
    if not (CHECKOUT / "tests" / "proof").is_dir():
        fix = "run it in a checkout of the repository: the generator is not part of the installed package"
        raise PlanError(Issue("rths prove", "its generator, tests/proof, is not here", str(CHECKOUT), fix))
    for name, least in (("cases", 1), ("workers", 1), ("seed", 0)):
        if getattr(given, name) < least:
            raise PlanError(Issue(f"--{name}", f"needs to be at least {least}", getattr(given, name)))
    for option, path in (("--json", given.json), ("--picture", given.picture)):
        if path and not path.parent.is_dir():
            raise PlanError(Issue(option, "there is no such folder", str(path.parent), "make it first"))
    if given.keep and given.keep.exists() and any(given.keep.iterdir()):
        raise PlanError(Issue("--keep", "is not empty", str(given.keep), "give a new folder"))


def _told(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
