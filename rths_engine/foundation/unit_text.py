"""Units as text: a unit as people read it, and the powers of the symbols in a typed unit."""

from __future__ import annotations

import re
from collections.abc import Mapping

# (symbol, whether its power is multiplied by the free exponent n of (s/m)^n) -> power
Powers = Mapping[tuple[str, bool], int]

_SUPERSCRIPTS = {"⁰": "0", "¹": "1", "²": "2", "³": "3", "⁴": "4", "⁻": "-", "ⁿ": "n"}
_RAISED = re.compile(f"[{''.join(_SUPERSCRIPTS)}]+")
_SIGNS = str.maketrans({"−": "-", "·": "*", "⋅": "*", "×": "*", "µ": "u", "μ": "u"})
_TOKEN = re.compile(r"\s*(?:(\^\s*(?:-?\d|n))|([A-Za-z%]+|1)|([*/()]))")
_PLAIN_PARENTHESES = re.compile(r"/\((\w+(?:\^\w)?)\)")


def ascii_signs(text: str) -> str:
    """The text with keyboard characters only: `−` as `-`, `·` as `*`, `²` as `^2`, `**` as `^`."""
    typed = _RAISED.sub(lambda raised: "^" + "".join(_SUPERSCRIPTS[sign] for sign in raised[0]), text.translate(_SIGNS))
    return typed.replace("**", "^")


def shown(unit: str) -> str:
    """The unit as people read it: `kN*s/m` -> `kN·s/m`, `1/(mm^2)` -> `1/mm²`; `1` is not shown."""
    if unit == "1":
        return ""
    raised = {digit: sign for sign, digit in _SUPERSCRIPTS.items()}
    bare = _PLAIN_PARENTHESES.sub(r"/\1", unit)
    return re.sub(r"\^(\w)", lambda power: raised[power[1]], bare).replace("*", "·")


def powers(text: str) -> Powers | None:
    """The powers of the symbols in a unit, equal for all spellings of the unit; None where the text is not a unit.

    `1/(mm^2*s)`, `1/mm²/s` and `mm^-2 s^-1` give equal powers. `/` divides by the next factor only.
    """
    tokens: list[str] = []
    typed = ascii_signs(text).strip()
    while typed:
        token = _TOKEN.match(typed)
        if token is None:
            return None
        tokens.append(token[0].replace(" ", ""))
        typed = typed[token.end() :].strip()
    try:
        found = _product(tokens)
    except (IndexError, ValueError):
        return None
    return None if tokens else {symbol: power for symbol, power in found.items() if power}


def _product(tokens: list[str]) -> dict[tuple[str, bool], int]:
    """Powers of factors with `*`, `/` or nothing between them, up to a closing parenthesis or the end."""
    found = _factor(tokens)
    while tokens and tokens[0] != ")":
        sign = -1 if tokens[0] == "/" else 1
        if tokens[0] in "*/":
            tokens.pop(0)
        for symbol, power in _factor(tokens).items():
            found[symbol] = found.get(symbol, 0) + sign * power
    return found


def _factor(tokens: list[str]) -> dict[tuple[str, bool], int]:
    token = tokens.pop(0)
    if token == "(":
        found = _product(tokens)
        if tokens.pop(0) != ")":
            raise ValueError
    elif token in "*/)" or token.startswith("^"):
        raise ValueError
    else:
        found = {} if token == "1" else {(token, False): 1}
    if tokens and tokens[0].startswith("^"):
        exponent = tokens.pop(0)[1:]
        if exponent == "n":
            return {(symbol, True): power for (symbol, _), power in found.items()}
        return {symbol: power * int(exponent) for symbol, power in found.items()}
    return found
