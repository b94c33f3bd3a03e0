"""The input of `rths run`: a plan, optionally another record, and the path of the recording."""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from contextlib import nullcontext
from pathlib import Path

from rths_engine.foundation.errors import Issue, PlanError, RthsError
from rths_engine.foundation.part import validated
from rths_engine.parts.connections.fmu import Fmu
from rths_engine.planning.model import Model
from rths_engine.planning.motion import FileMotion
from rths_engine.planning.plan import Station
from rths_engine.planning.plan_yaml import LARGEST
from rths_engine.planning.reading import model_from_yaml

STANDARD_INPUT = "-"


def read_model(given: Namespace) -> Model:
    """The model of the plan to run. Raises PlanError with every issue."""
    model = model_at(given.plan)
    plan = model.plan
    if given.record and plan.driven:
        leader = "test follows its client" if plan.test == "client" else f"{plan.test} follows its drive"
        problem = f"is not used in this kind of test: the {leader}"
        raise PlanError(Issue("--record", problem, given.record, "leave it out"))
    if given.record:
        motion = {"kind": "file", "path": given.record, "unit": given.record_unit, "dt": given.record_dt}
        return model.changed(motion=validated(FileMotion, {**motion, "scale": plan.motion.scale}))
    if given.record_unit or given.record_dt:
        raise PlanError(Issue("--record", "is needed with --record-unit and --record-dt", fix="name the record's file"))
    return _beside(model, given.plan)


def model_of_plan(path: str) -> Model:
    """The model of the plan in a YAML file; the path of its record starts at the folder of the file. Raises PlanError."""
    return _beside(model_at(path), path)


def model_at(path: str) -> Model:
    """The model of the plan in a YAML file; - is standard input. Raises PlanError with every issue."""
    return model_from_yaml(text_of(path))


def _beside(model: Model, path: str) -> Model:
    """The model with the paths of its record and of its FMUs relative to the folder of the plan's file `path`."""
    if path == STANDARD_INPUT:
        return model
    folder, planned = Path(path).parent, model.plan.motion
    if any(isinstance(one.connection, Fmu) for one in model.plan.stations):
        model = model.changed(stations=tuple(_near(one, folder) for one in model.plan.stations))
    if not isinstance(planned, FileMotion):
        return model
    return model.changed(motion=planned.model_copy(update={"path": str(folder / planned.path)}))


def _near(station: Station, folder: Path) -> Station:
    """The station with the path of its FMU, if it has one, relative to a folder."""
    planned = station.connection
    if not isinstance(planned, Fmu):
        return station
    return station.model_copy(update={"connection": planned.model_copy(update={"path": str(folder / planned.path)})})


def check_folder(out: Path, option: str = "--out", example: str = "rec.h5") -> None:
    """Raise RthsError if the file `out` cannot be written."""
    folder = out.parent
    if not folder.is_dir():
        raise RthsError(Issue(option, f"there is no folder {folder}", str(out), f"create it first: mkdir -p '{folder}'"))
    if out.is_dir():
        raise RthsError(Issue(option, "is a folder", str(out), f"give a file in it, for example {example}"))
    if not os.access(folder, os.W_OK | os.X_OK):
        raise RthsError(Issue(option, f"the folder {folder.resolve()} can't be written to", str(out), "choose another folder"))


def text_of(path: str) -> str:
    """The text of a plan, at most one character more than a plan may have."""
    try:
        with nullcontext(sys.stdin) if path == STANDARD_INPUT else Path(path).open(encoding="utf-8") as file:
            return file.read(LARGEST + 1)
    except UnicodeDecodeError:
        raise PlanError(Issue("PLAN.yaml", "is not valid UTF-8 text", path, "`rths plan NAME` prints a plan")) from None
    except OSError as error:
        raise PlanError(
            Issue("PLAN.yaml", f"cannot be read: {error.strerror}", path, "`rths plan NAME` prints a plan")
        ) from None
