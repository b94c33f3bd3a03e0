"""Calibration of probabilities: facts of claims on generated cases, and the logistic map from facts to a probability."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize

from rths_engine.diagnosis import calibration
from rths_engine.diagnosis.calibration import Facts
from rths_engine.diagnosis.verdict import diagnose
from rths_engine.foundation.arrays import Array
from rths_engine.planning.reading import plan_from_yaml
from rths_engine.recordings import opening
from tests.proof.generator.draw import Spec, specs
from tests.proof.score import named

TABLE = Path(calibration.__file__).with_name("calibration.json")
SIGNS = (0, 1, 1, 1, -1, -1, -1, 1)  # of the weights: more mass, evidence and gain raise a probability, the others lower it
SPREAD = 1.0  # prior standard deviation of a weight; it keeps weights finite where the facts separate right from wrong
OUTSIDE = 4  # one more case outside the library for every OUTSIDE others
LEVEL = 0.01
Row = tuple[tuple[float, ...], bool]


def chosen(cases: int, seed: int) -> list[Spec]:
    """Cases that conceal something, with more of them outside the library than the proof has."""
    inside = [spec for spec in specs(cases, seed) if spec.level != "clean"]
    return inside + specs(max(1, len(inside) // OUTSIDE), seed + 1, "outside")


def claims(spec: Spec) -> list[Row]:
    """The facts of every claim on a case, and whether its effect is part of the truth."""
    with tempfile.TemporaryDirectory(prefix="rths-calibrate-") as folder:
        shown, sealed = Path(folder) / "shown", Path(folder) / "sealed"
        try:
            spec.case().write(shown, sealed)
        except ArithmeticError:  # too stiff to solve
            return []
        truth = {named(one) for one in json.loads((sealed / "truth.json").read_text(encoding="utf-8"))["effects"]}
        plan = plan_from_yaml((shown / "plan.yaml").read_text(encoding="utf-8"))
        fitted, heldout = (opening.load(shown / name) for name in ("fit.h5", "heldout.h5"))
        found = diagnose(plan, fitted, [heldout], LEVEL)
    return [
        (claim.facts.row, f"{one.component.place(claim.effect)}/{claim.effect.id}" in truth)
        for one in found.judged
        for claim in (one.proof.claims if one.proof else ())
    ]


def weights(rows: Sequence[Row]) -> Array:
    """Weights of the logistic map by the largest posterior, with SIGNS and a normal prior of SPREAD on all but the constant."""
    facts, right = np.array([row for row, _ in rows]), np.array([float(true) for _, true in rows])

    def minus(w: Array) -> float:
        z = facts @ w
        return float(np.sum(np.logaddexp(0.0, z) - right * z) + 0.5 * np.sum((w[1:] / SPREAD) ** 2))

    bounds = [(None, None) if sign == 0 else (0.0, None) if sign > 0 else (None, 0.0) for sign in SIGNS]
    found: Array = minimize(minus, np.zeros(len(SIGNS)), bounds=bounds, method="L-BFGS-B").x
    return found


def table(rows: Sequence[Row], cases: int, seed: int) -> dict[str, Any]:
    """The content of calibration.json."""
    fitted = [float(f"{weight:.4g}") for weight in weights(rows)]
    return {
        "command": f"rths prove --calibrate --cases {cases} --seed {seed}",
        "claims": len(rows),
        "right": sum(true for _, true in rows),
        "weights": dict(zip(Facts.NAMES, fitted, strict=True)),
    }


def write(found: Iterable[list[Row]], cases: int, seed: int) -> dict[str, Any]:
    """Fit the map to the claims of all cases and write calibration.json."""
    made = table([row for rows in found for row in rows], cases, seed)
    TABLE.write_text(json.dumps(made, indent=2) + "\n", encoding="utf-8")
    return made
