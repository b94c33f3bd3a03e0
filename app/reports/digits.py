"""Numbers for people: at most four significant digits, and probabilities in words."""

from __future__ import annotations

NONE = "–"  # a number that was not computed
DIGITS = 4
LEAST = 0.001  # smaller probabilities are shown as < 0.001
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

# smallest probability -> its words; a probability above 0.95 needs held-out recordings that agree
CHANCES = (
    (0.95, "almost certain"),
    (0.9, "very likely"),
    (0.75, "likely"),
    (0.5, "more likely than not"),
    (0.25, "less likely than not"),
    (0.1, "unlikely"),
    (0.0, "very unlikely"),
)


def short(value: float, digits: int = DIGITS) -> str:
    """A number rounded to `digits` significant digits, at most four: `0.01234`, `2850`, `1.84 × 10⁵`."""
    shown = f"{float(f'{value:.{digits}g}'):.{DIGITS}g}"
    mantissa, _, power = shown.partition("e")
    return f"{mantissa} × 10{str(int(power)).translate(RAISED)}" if power else shown


def percent(share: float | None) -> str:
    """A share in percent with three digits, without the sign."""
    return NONE if share is None else short(100 * share, 3)


def chance(probability: float) -> str:
    """A probability as a number with two or three decimals."""
    if 0 < probability < LEAST / 2:
        return f"< {LEAST:g}"
    return f"{probability:.3f}" if probability > 0.99 or probability < 0.1 else f"{probability:.2f}"


def words(probability: float, replicated: bool) -> str:
    """A probability in words; above 0.95 they say whether held-out recordings replicated the effect."""
    least, found = next(row for row in CHANCES if probability >= row[0])
    if least < CHANCES[0][0]:
        return found
    return f"{found}, replicated" if replicated else f"{found}, not replicated"
