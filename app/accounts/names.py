"""Names of accounts: each uses one alphabet, and none looks like a word that the audit log or a page uses for itself."""

from __future__ import annotations

import unicodedata

from app.models.accounts import tidy
from app.roles import Role
from rths_engine.foundation.errors import Issue, RthsError

RESERVED = frozenset(
    {
        *("service", "worker", "workers", "command line", "local administrator", "not signed in", "nobody", "somebody"),
        *("left out", "audit", "audit log", "system", *(role.name.lower() for role in Role)),
    }
)
"""Actors and words of the audit log and of the pages."""
BESIDE = frozenset({"CJK", "HIRAGANA", "KATAKANA", "KATAKANA-HIRAGANA", "HANGUL", "BOPOMOFO", "IDEOGRAPHIC", "MODIFIER"})
"""Scripts that names use beside an alphabet, and whose letters look like none of it."""
INVISIBLE = frozenset("\u034f\u115f\u1160\u17b4\u17b5\u2800\u3164\uffa0")  # printable by their category, but blank


def checked(name: str) -> str:
    """The name to store. Raises RthsError for a name that is empty, reserved, or looks like another name."""
    name = tidy(name)
    if not name or not name.isprintable() or any(_blank(letter) for letter in name):
        raise RthsError(Issue("name", "needs at least one character, and visible characters only", name))
    if _plain(name) in RESERVED:
        raise RthsError(Issue("name", "is a word that the audit log uses for the program itself", name, "choose another name"))
    found = sorted({_alphabet(letter) for letter in name if letter.isalpha()} - BESIDE)
    if len(found) > 1:
        mixed = f"mixes letters of the alphabets {' and '.join(one.title() for one in found)}, some of which look alike"
        raise RthsError(Issue("name", mixed, name, "write it in one alphabet"))
    return name


def _blank(letter: str) -> bool:
    selects = "\ufe00" <= letter <= "\ufe0f" or "\U000e0100" <= letter <= "\U000e01ef"  # variants of a letter, not seen
    return selects or letter in INVISIBLE


def _alphabet(letter: str) -> str:
    return unicodedata.name(letter, "unnamed").partition(" ")[0]


def _plain(name: str) -> str:
    """The words of a name as a reader takes them in: without case, accents and punctuation, of variants the plain letter."""
    letters = (_base(letter) for letter in unicodedata.normalize("NFKD", name.casefold()))
    return " ".join("".join(letter for letter in letters if letter.isalnum() or letter == " ").split())


def _base(letter: str) -> str:
    """The letter of the alphabet of which a Latin letter is a variant: `i` of the dotless i, whose Unicode name ends in `I`."""
    words = unicodedata.name(letter, "").partition(" WITH ")[0].split()
    return words[-1].lower() if words[:1] == ["LATIN"] and len(words[-1]) == 1 else letter
