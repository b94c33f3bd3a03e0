"""Text of a size for a sentence."""

from __future__ import annotations

from rths_engine.foundation import units


def said(value: float, unit: str) -> str:
    """An SI value in `unit` to three digits: `said(18300.0, "kN")` -> "18.3 kN"."""
    shown = units.from_si(value, unit)
    text = f"{shown:.3g}"
    if "e" in text and 1.0 <= abs(shown) < 1e9:
        text = f"{float(text):.0f}"
    return f"{text} {units.pretty(unit)}".rstrip()
