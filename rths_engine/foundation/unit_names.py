"""Read the unit that a file writes: its spelling, its language, and a number before it, without guessing.

A text names no unit, one unit of `units.UNITS`, or a unit that is not known. These three stay apart: an unknown unit is never
read as no unit, and a word with several meanings (`tonf`, `mn`) is never read as one of them.
"""

from __future__ import annotations

import math
import re
import unicodedata
from dataclasses import dataclass
from functools import lru_cache

from rths_engine.foundation import unit_text, units
from rths_engine.foundation.unit_spellings import AMBIGUOUS, AMBIGUOUS_IN_ANY_CASE, NO_UNIT, SPELLINGS

_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"
_BEFORE = re.compile(rf"({_NUMBER})\s*[*x]?\s*([^\d\s*^.].*)", re.IGNORECASE)
_POWER = re.compile(rf"(?:({_NUMBER})\s*[*x]\s*)?10\s*(?:\^\s*([-+]?\d+)|([-+]\d+))\s*[*x]?\s*(\S.*)", re.IGNORECASE)
_BELOW = re.compile(r"(.+?)\s*/\s*(10+)")
_LARGEST_POWER = 30  # of ten: quetta, the largest prefix of SI (ISO 80000-1)
_PER = re.compile(r"\s*\b(?:per|pro|par|por)\b\s*")
_EXPONENT = re.compile(r"(?<=[A-Za-z)])\s?(-?[1-4])(?![\d.])")
_WORD = re.compile(r"[A-Za-z%°\"']+")
_BRACKETS = {"(": ")", "[": "]", "{": "}", "<": ">"}
_SAME = 1e-12  # relative: two factors that are equal by definition differ by less, in rounding only


@dataclass(frozen=True, slots=True)
class Written:
    """A unit as a file writes it.

    `unit` is a unit of the table, and one written unit is `scale` of it: `0.05 g` is 0.05 of g, `0.1 g` one of g/10. `unit`
    is empty where the text states no unit, or where its unit is not known; then `problem` says why.
    """

    text: str
    unit: str = ""
    scale: float = 1.0
    problem: str = ""

    @property
    def none(self) -> bool:
        """Whether the text states no unit at all."""
        return not self.unit and not self.problem

    @property
    def plain(self) -> str:
        """The unit where no number scales it; else empty."""
        return self.unit if self.scale == 1.0 else ""

    @property
    def dimension(self) -> str:
        """The dimension of a known unit; empty for others."""
        return units.dimension(self.unit) if self.unit else ""


@lru_cache(maxsize=4096)
def read(text: str) -> Written:
    """The unit that `text` names, in any of its spellings, with or without brackets around it."""
    plain, typed = _plain(text), _without_brackets(text)
    if plain.lower() in NO_UNIT:
        return Written(typed)
    if len(plain) > units.LONGEST:
        return Written(typed, problem=f"the unit '{typed[: units.LONGEST]}…' is not known")
    meant = _ambiguous(plain)
    if meant:
        return Written(typed, problem=f"the unit '{typed}' has several meanings: choose {' or '.join(meant)}")
    if meant is None and (unit := _named(plain)):
        return Written(typed, unit)
    return _scaled(typed, plain) or Written(typed, problem=f"the unit '{typed}' is not known")


def known(text: str) -> str:
    """The unit of the table that `text` names; empty where it names none, an unknown unit, or a scaled unit."""
    return read(text).plain


def simplest(unit: str, scale: float) -> tuple[str, float]:
    """The unit of the table that equals `scale` of `unit`, with scale 1; else `unit` and `scale` unchanged."""
    if scale == 1.0 or unit in units.ZEROS:
        return unit, scale
    wanted = scale * units.factor(unit)
    for other in units.of_dimension(units.dimension(unit)):
        if other not in units.ZEROS and math.isclose(units.factor(other), wanted, rel_tol=_SAME):
            return other, 1.0
    return unit, scale


def _plain(text: str) -> str:
    """The text in keyboard characters, without accents, brackets around the whole, and a trailing point."""
    typed = unit_text.ascii_signs(text).replace("ß", "ss").replace("ε", "e").replace("″", '"').replace("º", "°")
    typed = "".join(sign for sign in unicodedata.normalize("NFD", typed) if not unicodedata.combining(sign))
    return _without_brackets(typed).removesuffix(".")


def _without_brackets(text: str) -> str:
    typed = re.sub(r"\s+", " ", text).strip()
    while len(typed) > 1 and _closing(typed) == len(typed) - 1:
        typed = typed[1:-1].strip()
    return typed


def _closing(text: str) -> int:
    """Where the bracket that opens the text closes; -1 where none opens it or it stays open."""
    opens, closes = text[0], _BRACKETS.get(text[0], "")
    depth = 0
    for at, sign in enumerate(text if closes else ""):
        depth += (sign == opens) - (sign == closes)
        if depth == 0:
            return at
    return -1


def _ambiguous(plain: str) -> tuple[str, ...] | None:
    found = AMBIGUOUS.get(plain)
    return AMBIGUOUS_IN_ANY_CASE.get(plain.lower()) if found is None else found


def _named(plain: str) -> str:
    """The unit of the table in this spelling; empty where there is none."""
    if plain in units.UNITS:
        return plain
    lower = plain.lower()
    found = _BY_SPELLING.get(lower) or _BY_SPELLING.get(_raised(lower)) or _BY_CASE.get(_raised(lower))
    return found or units.named(_raised(plain)) or _compound(plain)


def _compound(plain: str) -> str:
    """A unit of several symbols, each in its own spelling: `cm/sec/sec`, `Meter pro Sekunde`, `m.s-2`, `KN/MM`."""
    typed = re.sub(r"\b(?:squared|quadrat|carre)\b", "^2", plain.lower()) if " " in plain else plain
    typed = re.sub(r"(?<=[A-Za-z\d])\s*\.\s*(?=[A-Za-z])", "*", _PER.sub("/", typed))
    words = _WORD.findall(typed)
    if len(words) < 2 and "/" not in typed and "^" not in _raised(typed):
        return ""
    if any(_ambiguous(word) is not None for word in words):
        return ""
    spelled = _WORD.sub(lambda word: _symbol(word[0]), _raised(typed))
    return units.named(re.sub(r"\s+(?=\^)", "", spelled)) or ""


def _symbol(word: str) -> str:
    lower = word.lower()
    return word if word in units.UNITS else _BY_SPELLING.get(lower) or _BY_CASE.get(lower) or word


def _raised(text: str) -> str:
    """Exponents with their sign: `s2` and `s 2` as `s^2`, `s-2` as `s^-2`."""
    return _EXPONENT.sub(r"^\1", text) if "^" not in text else text


def _scaled(typed: str, plain: str) -> Written | None:
    """A unit with a power or a number before it (`0.1 g`, `10^-3 g`, `1e-3 m`, `x10^-6 strain`) or below it (`g/100`).

    A plain number above 1 before a unit is refused: `Force (10 kN)` can be the range of a load cell.
    """
    signed = re.sub(r"^[x*]\s*", "", plain)
    if power := _POWER.fullmatch(signed):
        exponent = int(power[2] or power[3])
        number, rest = (float(power[1] or 1) * 10.0**exponent if abs(exponent) < _LARGEST_POWER else 0.0), power[4]
    elif before := _BEFORE.fullmatch(signed):
        number, rest = float(before[1]), before[2]
    elif below := _BELOW.fullmatch(plain):
        number, rest = 1 / float(below[2]), below[1]
    else:
        return None
    unit = _named(rest) if _ambiguous(rest) is None else ""
    if not unit or unit == "1" or not (number > 0 and math.isfinite(number)):
        return None
    if not power and number > 1 and "e" not in plain[: len(plain) - len(rest)].lower():
        return Written(typed, problem=f"the number in '{typed}' can be a factor or the range of a sensor")
    return Written(typed, *simplest(unit, number))


_BY_SPELLING = {spelling: unit for unit, spellings in SPELLINGS.items() for spelling in spellings}
_BY_CASE = {unit.lower(): unit for unit in reversed(units.UNITS)}
