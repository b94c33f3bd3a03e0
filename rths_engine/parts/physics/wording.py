"""Text of a size for a sentence."""

from __future__ import annotations

from rths_engine.foundation import units

# units of one dimension, the smallest first, of which a sentence takes the one that gives a short number
SCALES = (
    ("N", "kN", "MN"),
    ("um", "mm", "m"),
    ("us", "ms", "s"),
    ("um/s", "mm/s", "m/s"),
    ("N/m", "kN/m", "kN/mm"),
    ("N/m^3", "kN/m^3", "N/mm^3", "kN/mm^3"),
    ("N*s/m", "kN*s/m", "kN*s/mm"),
    ("N*(s/m)^2", "kN*(s/m)^2", "MN*(s/m)^2"),
    ("mm/MN", "mm/kN", "mm/N"),
    ("mJ", "J", "kJ", "MJ", "GJ"),
    ("kg", "t"),
    ("us/mm", "ms/mm"),
    ("1/m", "1/mm"),
    ("1/MJ", "1/kJ", "1/J"),
    ("1/MN", "1/kN", "1/N"),
)
# chosen; see docs/decisions/0023
SHORTEST, LONGEST = 0.1, 1e4  # numbers outside are said in another unit


def said(value: float, unit: str) -> str:
    """An SI value in `unit` to three digits: `said(18300.0, "kN")` -> "18.3 kN".

    A number below SHORTEST or from LONGEST on is said in another unit of the same dimension: `said(0.7, "kN")` -> "0.7 N".
    """
    unit = fitting(value, unit)
    shown = units.from_si(value, unit)
    text = f"{shown:.3g}"
    if "e" in text and 1.0 <= abs(shown) < 1e9:
        text = f"{float(text):.0f}"
    return f"{text} {units.pretty(unit)}".rstrip()


def lost(rate: float, unit: str) -> tuple[str, str]:
    """A loss per `unit` as a share of at most 100 %, and the unit it is lost in: `lost(1.84e-3, "MJ")` -> ("0.184 %", "J")."""
    scale = next(scale for scale in SCALES if unit in scale)
    per = next((one for one in reversed(scale) if rate * units.factor(one) <= 1.0), scale[0])
    return said(rate * units.factor(per), "%"), units.pretty(per)


def fitting(value: float, unit: str) -> str:
    """`unit`, or where it gives a long number the largest unit of its scale in which the value is at least 1."""
    if not value or SHORTEST <= abs(units.from_si(value, unit)) < LONGEST:
        return unit
    scale = next((scale for scale in SCALES if unit in scale), (unit,))
    return next((one for one in reversed(scale) if abs(units.from_si(value, one)) >= 1.0), scale[0])
