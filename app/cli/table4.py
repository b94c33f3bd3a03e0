"""`rths table4`: run the twelve simulations of Chen and Ricles (2012) on the emulated laboratory, beside Table IV."""

from __future__ import annotations

import json
import time
from argparse import Namespace
from dataclasses import asdict, replace
from pathlib import Path

from app.cli.run_input import check_folder
from app.cli.table4_text import text
from rths_engine import table4 as engine
from rths_engine.foundation.errors import Issue, MotionError, RthsError
from rths_engine.foundation.part import validated
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.planning.motion import FileMotion
from rths_engine.table4 import running
from rths_engine.table4.scale import design_basis

UNIT, DT = "g", 0.02  # for a file that states neither: see docs/table4.md


def table4(given: Namespace) -> None:
    """`rths table4`: run the simulations and print the table. Raises RthsError for a record that can't be read or scaled."""
    if given.json:
        check_folder(given.json, "--json", "table4.json")
    motions = MotionLibrary(None)
    motion = _scaled(given, motions)
    start = time.perf_counter()
    results = running.run_all(engine.plans(motion), motions)
    elapsed_s = time.perf_counter() - start
    rows = running.rows(results)
    floors, drifts = results[2].summary()["floors_peak_mm"], running.drifts_percent(results[2])
    print(text(motion, results[2].motion, rows, floors, drifts, elapsed_s))
    if given.json:
        _write(given.json, {"rows": [asdict(row) for row in rows], "floors_peak_mm": floors, "drifts_percent": drifts})


def _scaled(given: Namespace, motions: MotionLibrary) -> engine.PlannedRecord:
    if given.record is None:
        if given.record_unit or given.record_dt:
            raise RthsError(Issue("--record", "is needed with --record-unit and --record-dt", fix="name the record's file"))
        motion: engine.PlannedRecord = engine.BUNDLED
        if given.factor is None:
            return motion
    else:
        motion = _read(given, motions)
    if given.factor is None:
        return design_basis(motion, motions)
    return motion.model_copy(update={"scale": validated(Factor, {"factor": given.factor})})


def _read(given: Namespace, motions: MotionLibrary) -> FileMotion:
    """The record in a file. Where the file states no unit or time step, UNIT and DT of the paper's record are used."""
    asked = {"kind": "file", "path": given.record, "unit": given.record_unit, "dt": given.record_dt}
    motion = validated(FileMotion, asked)
    try:
        motion.unscaled(motions)
        return motion
    except MotionError as error:
        unsaid = {issue.where for issue in error.issues}
        defaults = {key: value for key, value in (("unit", UNIT), ("dt", DT)) if key in unsaid and asked[key] is None}
        if not unsaid <= set(defaults):
            raise MotionError(replace(issue, where=f"--record {issue.where}") for issue in error.issues) from None
    motion = motion.model_copy(update=defaults)
    motion.unscaled(motions)
    return motion


def _write(path: Path, found: dict[str, object]) -> None:
    try:
        path.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    except OSError as error:
        raise RthsError(Issue("--json", f"was not written: {error.strerror}", str(path), "choose another file")) from None
