"""The trip that a dry run predicts, with its field and its short sentence, and the sentence of a whole preflight."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from rths_engine.foundation import units
from rths_engine.planning.safety import LIMITS, Trip
from rths_engine.preflight.dry_run import DryRun
from rths_engine.preflight.uses import Use


def trip_of(trip: Trip) -> dict[str, Any]:
    """JSON form of a predicted trip: the engine's trip, the field of its limit, and a sentence for beside that field."""
    words, _, shown = LIMITS[trip.limit]
    found = trip.as_dict()
    return {
        **{key: found[key] for key in ("station", "name", "limit", "value", "bound", "unit", "time_s")},
        "words": words,
        "shown": shown,
        "path": f"stations.{trip.station - 1}.limits.{trip.limit}",
        "sentence": f"Would trip at {trip.time_s:.2f} s: station {trip.station} ({trip.name}), {words} {_beyond(trip)}.",
    }


def sentence(dry: DryRun, uses: Sequence[Use]) -> str:
    """The outcome of a preflight in one sentence: the trip, or the largest use of a limit."""
    if dry.run.trip:
        return str(trip_of(dry.run.trip)["sentence"])
    used = max((use for use in uses if use.against == "limit"), key=lambda use: use.share, default=None)
    most = f" Largest use of a limit: {100 * used.share:.0f} %, {used.label} of station {used.station}." if used else ""
    if dry.complete:
        return f"Would complete {dry.planned_s:.4g} s.{most}"
    return f"Would not trip in the first {dry.covered_s:.3g} s of {dry.planned_s:.4g} s; the rest was not simulated.{most}"


def _beyond(trip: Trip) -> str:
    """`304 > 300 mm/s`, with as many digits as tell the two numbers apart."""
    _, _, shown = LIMITS[trip.limit]
    value, bound = abs(units.from_si(trip.value, shown)), units.from_si(trip.bound, shown)
    unit = f" {units.pretty(shown)}".rstrip()
    if not math.isfinite(value):
        return f"is not a number; its limit is {bound:g}{unit}"
    digits = next((n for n in range(3, 12) if float(f"{value:.{n}g}") > bound), 12)
    return f"{float(f'{value:.{digits}g}'):.12g} > {bound:.12g}{unit}"
