"""The protocol of the proof: make, seal, diagnose with the public command, open, verify, score."""

from __future__ import annotations

import contextlib
import io
import json
import multiprocessing
import os
import tempfile
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rths_engine.diagnosis.schema import Verdict
from tests.proof import calibrate as calibration
from tests.proof import seals
from tests.proof.generator.draw import Spec, specs
from tests.proof.score import scored
from tests.proof.summary import summary

LEVEL = 0.01  # of false alarms, that every diagnosis is asked for
Told = Callable[[str], None]


@dataclass(frozen=True)
class Folders:
    """The folders of a proof: `shown` has plans and recordings, `sealed` has truths, `found` has diagnoses."""

    root: Path

    @property
    def shown(self) -> Path:
        return self.root / "shown"

    @property
    def sealed(self) -> Path:
        return self.root / "sealed"

    @property
    def found(self) -> Path:
        return self.root / "found"


def prove(
    cases: int, seed: int, workers: int = 2, only: str | None = None, keep: Path | None = None, told: Told = print
) -> dict[str, Any]:
    """Run the proof and return the content of OUT.json: all scores by class of lambda, and a row for each case."""
    with tempfile.TemporaryDirectory(prefix="rths-prove-") as passing:
        folders = Folders(keep or Path(passing))
        folders.found.mkdir(parents=True)
        made = specs(cases, seed, only)
        started = time.perf_counter()
        whole = _everywhere(workers, _made, [(spec, folders) for spec in made], "recordings made", told)
        made = [spec for spec, kept in zip(made, whole, strict=True) if kept]
        digests = seals.seal(folders.sealed, folders.root / seals.SEALS)
        told(f"{len(digests)} truths sealed after {time.perf_counter() - started:.0f} s")
        runs = _everywhere(workers, diagnosed, [(folders.shown / spec.name, folders.found) for spec in made], "diagnosed", told)
        seals.verify(folders.sealed, digests)
        seconds = dict(zip([spec.name for spec in made], runs, strict=True))
        (folders.root / "runs.json").write_text(json.dumps(seconds, indent=1) + "\n", encoding="utf-8")
        asked = [(folders, spec.name, seconds[spec.name]) for spec in made]
        rows = _everywhere(workers, _scored, asked, "scored", told)
        result = {**summary(rows), "not_made": whole.count(False), "seed": seed, "only": only, "level": LEVEL, "per_case": rows}
        (folders.root / "proof.json").write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
        return result


def calibrate(cases: int, seed: int, workers: int = 2, told: Told = print) -> dict[str, Any]:
    """Fit the map of probabilities to generated cases and write calibration.json; return its content."""
    chosen = [(spec,) for spec in calibration.chosen(cases, seed)]
    return calibration.write(_everywhere(workers, calibration.claims, chosen, "calibrated", told), cases, seed)


def diagnosed(case: Path, found: Path) -> dict[str, Any]:
    """Run `rths diagnose` on the shown files of a case; return its exit code, output and duration (s)."""
    from app.cli.main import main

    out, said = found / f"{case.name}.json", io.StringIO()
    arguments = ["diagnose", str(case / "plan.yaml"), str(case / "fit.h5"), "--holdout", str(case / "heldout.h5")]
    started = time.perf_counter()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
        try:
            code: int | str = main([*arguments, "--level", str(LEVEL), "--json", str(out)])
        except Exception as error:  # a crash is a result, of this case alone
            code = f"{type(error).__name__}: {error}"
    return {"exit": code, "said": said.getvalue().strip(), "seconds": time.perf_counter() - started}


def _made(spec: Spec, folders: Folders) -> bool:
    """Make a case; False where its equations are too stiff to solve, which only the draw of the case decides."""
    try:
        spec.case().write(folders.shown / spec.name, folders.sealed / spec.name)
    except ArithmeticError:
        return False
    return True


def _scored(folders: Folders, name: str, run: dict[str, Any]) -> dict[str, Any]:
    out = folders.found / f"{name}.json"
    found = Verdict.read(json.loads(out.read_text(encoding="utf-8"))) if out.exists() else None
    return scored(folders.shown / name, folders.sealed / name, found, run)


def _everywhere(workers: int, work: Callable[..., Any], asked: Iterable[tuple[Any, ...]], what: str, told: Told) -> list[Any]:
    """The results of a function for each item, in order, computed in separate processes with one core each."""
    asked = list(asked)
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    found = []
    with ProcessPoolExecutor(workers, multiprocessing.get_context("spawn")) as pool:
        for number, one in enumerate(pool.map(_called, [work] * len(asked), asked), start=1):
            found.append(one)
            if number % 10 == 0 or number == len(asked):
                told(f"{number} of {len(asked)} {what}")
    return found


def _called(work: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
    return work(*arguments)
