"""What `rths run` is given: a plan, perhaps another record, and a place for the recording."""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from contextlib import nullcontext
from pathlib import Path

from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.foundation.part import validated
from rths_engine.planning.motion import FileMotion
from rths_engine.planning.plan import Plan
from rths_engine.planning.plan_yaml import LARGEST
from rths_engine.planning.reading import plan_from_yaml

STANDARD_INPUT = "-"


def read_plan(given: Namespace) -> Plan:
    """Raises PlanError with every issue."""
    plan = plan_at(given.plan)
    if given.record and plan.driven:
        raise PlanError(Issue("--record", f"is not used: a test of one {plan.test} follows its drive", fix="leave it out"))
    if given.record:
        motion = {"kind": "file", "path": given.record, "unit": given.record_unit, "dt": given.record_dt}
        return _with_motion(plan, validated(FileMotion, {**motion, "scale": plan.motion.scale}))
    if given.record_unit or given.record_dt:
        raise PlanError(Issue("--record", "is needed with --record-unit and --record-dt", fix="name the record's file"))
    if isinstance(plan.motion, FileMotion) and given.plan != STANDARD_INPUT:
        beside = str(Path(given.plan).parent / plan.motion.path)
        return _with_motion(plan, plan.motion.model_copy(update={"path": beside}))
    return plan


def plan_at(path: str) -> Plan:
    """The plan of a YAML file; - is standard input. Raises PlanError with every issue."""
    return plan_from_yaml(_text(path))


def check_folder(out: Path, option: str = "--out", example: str = "rec.h5") -> None:
    """Raises RthsError when nothing can be written there."""
    folder = out.parent
    if not folder.is_dir():
        raise RthsError(Issue(option, f"there is no folder {folder}", str(out), f"make it first: mkdir -p '{folder}'"))
    if out.is_dir():
        raise RthsError(Issue(option, "is a folder", str(out), f"name a file in it, such as {example}"))
    if not os.access(folder, os.W_OK | os.X_OK):
        raise RthsError(Issue(option, f"the folder {folder.resolve()} can't be written to", str(out), "choose another folder"))


def _text(path: str) -> str:
    """A plan's text, read no further than one character beyond what a plan may have."""
    try:
        with nullcontext(sys.stdin) if path == STANDARD_INPUT else Path(path).open(encoding="utf-8") as file:
            return file.read(LARGEST + 1)
    except UnicodeDecodeError:
        raise PlanError(Issue("PLAN.yaml", "is no text in UTF-8", path, "give a plan as `rths plan` prints it")) from None
    except OSError as error:
        raise PlanError(Issue("PLAN.yaml", f"can't be read: {error.strerror}", path, "`rths plan NAME` prints one")) from None


def _with_motion(plan: Plan, motion: FileMotion) -> Plan:
    return plan.model_copy(update={"motion": motion})
