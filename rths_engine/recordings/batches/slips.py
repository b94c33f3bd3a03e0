"""Ratios of units of one quantity: the values of a file are off by one of them where another unit was written, kgf for N."""

from __future__ import annotations

from functools import cache
from itertools import permutations

from rths_engine.foundation import units

# chosen; see docs/decisions/0023
SMALLEST = 2.0  # ratio of two units
NAMED = 2  # ratios in a sentence, the nearest ones
WITHIN, WIDEST = 0.02, 0.15  # relative: around the ratio of two units, at least and at most


def between(value: float, usual: float, unit: str, scatter: float | None) -> str:
    """How two values in `unit` differ by a ratio of units: `9.81 times, as units differ by 9.807 (kgf, N)`; empty: they don't.

    `scatter` (relative): by which values in the right unit differ from their median; the two values can differ by twice that.
    None where they are not alike, so that no ratio means a unit.
    """
    if scatter is None or not value > 0 or not usual > 0:
        return ""
    within = min(max(2 * scatter, WITHIN), WIDEST)
    size = max(value / usual, usual / value)
    near = [(abs(one / size - 1), one, pair) for one, pair in _ratios(units.dimension(unit)).items()]
    named = " or ".join(f"{one:.4g} ({', '.join(pair)})" for off, one, pair in sorted(near)[:NAMED] if off <= within)
    return f"{size:.4g} times, as units differ by {named}" if named else ""


@cache
def _ratios(dimension: str) -> dict[float, tuple[str, str]]:
    """Each ratio of two units of a dimension, with the first two units that have it."""
    known = [name for name, (of, _) in units.UNITS.items() if of == dimension and name not in units.ZEROS]
    found: dict[float, tuple[str, str]] = {}
    for large, small in permutations(known, 2):
        ratio = float(f"{units.factor(large) / units.factor(small):.6g}")
        if ratio >= SMALLEST:
            found.setdefault(ratio, (large, small))
    return found
