"""`rths preflight`: simulate a plan before it is queued, and predict its stability.

The exit code is 0 where the plan would run to its end, 1 where it would trip, and 2 where it cannot run as written.
"""

from __future__ import annotations

import json
from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from app.cli.run_input import model_of_plan
from app.cli.settings import settings
from app.store.motions import motions_of
from rths_engine.preflight import preflight as dry_run

WOULD_TRIP = 1


def preflight(given: Namespace) -> int:
    """`rths preflight`: print whether a plan would trip, its peaks against limits and capacities, and its times."""
    found = dry_run(model_of_plan(given.plan), motions_of(settings(given)))
    print(json.dumps(found) if given.json else "\n".join(_lines(found)))
    return WOULD_TRIP if found["trip"] else 0


def _lines(found: dict[str, Any]) -> Iterator[str]:
    yield f"{found['name']}: {found['sentence']}"
    yield from found["notes"]
    if found["uses"]:
        yield ""
        yield f"{'Station':24} {'Quantity':28} {'Peak':>10} {'Bound':>10} {'Unit':6} {'Used':>6}  Against"
    for use in found["uses"]:
        yield _use(use)
    yield ""
    for floors in found["floors"]:
        values = ", ".join(
            f"floor {number} {'–' if value is None else format(value, '.' + str(floors['decimals']) + 'f')}"
            for number, value in enumerate(floors["values"], start=1)
        )
        unit = f", {floors['shown_label']}" if floors["shown_label"] else ""
        yield f"{floors['label']}{unit}: {values}"
    yield from _stability(found["stability"])
    if found["open_ended"]:
        yield f"Duration at most {found['duration_s']:.4g} s; the client ends the test"
        return
    elapsed = "not known" if found["expected_elapsed_s"] is None else f"{found['expected_elapsed_s']:.3g} s"
    yield f"Duration {found['duration_s']:.4g} s; expected time at the pace of the plan: {elapsed}"


def _use(use: dict[str, Any]) -> str:
    peak = "–" if use["peak"] is None else f"{use['peak'] / use['factor']:.3g}"
    share = "–" if use["share"] is None else f"{100 * use['share']:.0f} %"
    bound = f"{use['bound'] / use['factor']:.6g}"
    name = f"{use['station']} {use['name']}"
    return f"{name:24.24} {use['label']:28} {peak:>10} {bound:>10} {use['shown_label']:6} {share:>6}  {use['against_label']}"


def _stability(found: dict[str, Any] | None) -> Iterator[str]:
    if found is None:
        return
    if found["radius"] is not None:
        verdict = "stable" if found["stable"] else "UNSTABLE"
        yield f"The closed loop is predicted {verdict} about rest: spectral radius {found['radius']:.6f} per step."
    for one in found["stations"]:
        steps, seconds = one["steps"], one["seconds"]
        margin = (
            "more than 1000 controller steps" if steps is None else f"{steps:.1f} controller steps ({1e3 * seconds:.1f} ms)"
        )
        yield f"Station {one['station']} ({one['name']}): delay margin {margin}."
    yield from found["notes"]
