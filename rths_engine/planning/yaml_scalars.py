"""Plain scalars of YAML by the core schema of YAML 1.2: null, bool, int, float.

Source: https://yaml.org/spec/1.2.2/, section 10.3.2.
"""

from __future__ import annotations

import re

MOST_DIGITS = 400  # of a whole number: the largest float has 309; chosen; see docs/decisions/0023
NAMED: dict[str, bool | None] = dict.fromkeys(("", "~", "null", "Null", "NULL")) | {
    word: word.lower() == "true" for word in ("true", "True", "TRUE", "false", "False", "FALSE")
}
_INT = re.compile(r"[-+]?[0-9][0-9_]*")
_OF_BASE = re.compile(r"([-+]?)0(?:b([01_]+)|o([0-7_]+)|x([0-9a-fA-F_]+))")
_FLOAT = re.compile(r"[-+]?(?:[0-9][0-9_]*\.[0-9_]*|\.[0-9][0-9_]*|[0-9][0-9_]*(?=[eE]))(?:[eE][-+]?[0-9]+)?")
_INFINITE = re.compile(r"[-+]?\.(?:inf|Inf|INF)")
_NAN = re.compile(r"\.(?:nan|NaN|NAN)")


def plain(text: str) -> bool | float | int | str | None:
    """The value of a plain scalar; text where it is none of the others. Raises ValueError for a number with too many digits."""
    if text in NAMED:
        return NAMED[text]
    if text[0] not in "+-.0123456789":
        return text
    if _INT.fullmatch(text):
        return _whole(text, text, 10)
    if _FLOAT.fullmatch(text):
        return float(text.replace("_", ""))
    if based := _OF_BASE.fullmatch(text):
        sign, *digits = based.groups()
        base, given = next((base, one) for base, one in zip((2, 8, 16), digits, strict=True) if one)
        return _whole(text, sign + given, base) if given.strip("_") else text
    if _INFINITE.fullmatch(text):
        return float(text.replace(".", ""))
    return float("nan") if _NAN.fullmatch(text) else text


def _whole(text: str, digits: str, base: int) -> int:
    if len(text) > MOST_DIGITS:
        raise ValueError(f"a number has {len(text)} digits; the limit is {MOST_DIGITS}")
    return int(digits.replace("_", ""), base)
