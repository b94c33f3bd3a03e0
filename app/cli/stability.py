"""`rths stability`: predict whether a plan's closed loop is stable."""

from __future__ import annotations

import json
from argparse import Namespace
from typing import Any

import numpy as np

from app.cli.run_input import model_at
from rths_engine import stability as engine
from rths_engine.stability import published


def stability(given: Namespace) -> None:
    """`rths stability`: print the stability of a plan, or the published limit where no plan is given."""
    found = _published() if given.plan is None else engine.summary(model_at(given.plan))
    print(json.dumps(found) if given.json else _limit(found) if given.plan is None else _text(found))


def _text(found: dict[str, Any]) -> str:
    if found["radius"] is None:
        return "\n".join(found["notes"])
    verdict = "stable" if found["stable"] else "UNSTABLE"
    lines = [f"The closed loop is {verdict} about rest: spectral radius {found['radius']:.6f} a step."]
    if mode := found["least_damped"]:
        lines.append(f"Least damped mode: {mode['frequency_hz']:.3f} Hz, damping ratio {100 * mode['damping_ratio']:.2f} %.")
    for number, station in enumerate(found["stations"], start=1):
        steps = station["delay_margin_steps"]
        margin = (
            "more than can be added"
            if steps is None
            else f"{steps:.2f} controller steps ({1e3 * station['delay_margin_s']:.2f} ms)"
        )
        lines.append(f"Station {number} ({station['name']}) bears {margin} of more delay.")
    return "\n".join([*lines, *found["notes"]])


def _published() -> dict[str, Any]:
    """Figure 3: alpha1 and the alpha2 up to which the loop is stable."""
    last = published.largest_alpha1()
    limit = [{"alpha1": float(alpha1), "alpha2": published.limit(float(alpha1))} for alpha1 in np.linspace(1.0, last, 11)]
    return {"name": published.section2((1.0, 1.0)).name, "limit": limit}


def _limit(found: dict[str, Any]) -> str:
    rows = [f"{one['alpha1']:9.4f} {one['alpha2']:9.4f}" for one in found["limit"]]
    head = "Two storeys, a delayed spring in each, 2 % damping, steps of 10 ms: stable up to"
    return "\n".join([f"{found['name']}, Figure 3", head, f"{'alpha1':>9} {'alpha2':>9}", *rows])
