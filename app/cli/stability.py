"""`rths stability`: predict whether a plan's closed loop is stable."""

from __future__ import annotations

import json
from argparse import Namespace
from typing import Any

import numpy as np

from app.cli.run_input import model_at
from rths_engine import stability as engine
from rths_engine.stability import published
from rths_engine.stability.margins import MOST


def stability(given: Namespace) -> None:
    """`rths stability`: print the predicted stability of a plan; without a plan, print a published limit."""
    found = _published() if given.plan is None else engine.summary(model_at(given.plan))
    print(json.dumps(found) if given.json else _limit(found) if given.plan is None else _text(found))


def _text(found: dict[str, Any]) -> str:
    if found["radius"] is None:
        return "\n".join(found["notes"])
    verdict = "stable" if found["stable"] else "UNSTABLE"
    lines = [f"The closed loop is {verdict} about rest: spectral radius {found['radius']:.6f} per step."]
    if mode := found["least_damped"]:
        lines.append(f"Least damped mode: {mode['frequency_hz']:.3f} Hz, damping ratio {100 * mode['damping_ratio']:.2f} %.")
    for number, station in enumerate(found["stations"], start=1):
        steps = station["delay_margin_steps"]
        margin = (
            f"more than {MOST:g} controller steps"
            if steps is None
            else f"{steps:.2f} controller steps ({1e3 * station['delay_margin_s']:.2f} ms)"
        )
        lines.append(f"Station {number} ({station['name']}): delay margin {margin}.")
    return "\n".join([*lines, *found["notes"]])


def _published() -> dict[str, Any]:
    """Figure 3 of the paper: alpha1, and the largest alpha2 at which the loop is stable."""
    last = published.largest_alpha1()
    limit = [{"alpha1": float(alpha1), "alpha2": published.limit(float(alpha1))} for alpha1 in np.linspace(1.0, last, 11)]
    return {"name": published.section2((1.0, 1.0)).name, "limit": limit}


def _limit(found: dict[str, Any]) -> str:
    rows = [f"{one['alpha1']:9.4f} {one['alpha2']:9.4f}" for one in found["limit"]]
    head = "Two storeys, each with a delayed spring, 2 % damping, steps of 10 ms. Largest stable alpha2 for each alpha1:"
    return "\n".join([f"{found['name']}, Figure 3", head, f"{'alpha1':>9} {'alpha2':>9}", *rows])
