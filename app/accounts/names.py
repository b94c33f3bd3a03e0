"""Names of accounts: no two of them look alike, and none is a word that the audit log uses for itself."""

from __future__ import annotations

import unicodedata

from app.models.accounts import key_of, tidy
from rths_engine.foundation.errors import Issue, RthsError

RESERVED = frozenset(
    {"service", "worker", "workers", "command line", "local administrator", "not signed in", "nobody", "somebody", "left out"}
)
"""Actors and words of the audit log and of the pages."""
ALPHABETS = frozenset({"LATIN", "GREEK", "CYRILLIC"})  # with letters that look equal
INVISIBLE = frozenset("\u034f\u115f\u1160\u17b4\u17b5\u2800\u3164\uffa0")  # printable by their category, but blank


def checked(name: str) -> str:
    """The name to store. Raises RthsError for a name that is empty, reserved, or looks like another name."""
    name = tidy(name)
    if not name or not name.isprintable() or any(_blank(letter) for letter in name):
        raise RthsError(Issue("name", "needs at least one character, and visible characters only", name))
    if key_of(name) in RESERVED:
        raise RthsError(Issue("name", "is a word that the audit log uses for the program itself", name, "choose another name"))
    found = sorted({_alphabet(letter) for letter in name} & ALPHABETS)
    if len(found) > 1:
        mixed = f"mixes letters of the alphabets {' and '.join(one.title() for one in found)}, which look alike"
        raise RthsError(Issue("name", mixed, name, "write it in one alphabet"))
    return name


def _blank(letter: str) -> bool:
    selects = "\ufe00" <= letter <= "\ufe0f" or "\U000e0100" <= letter <= "\U000e01ef"  # variants of a letter, not seen
    return selects or letter in INVISIBLE


def _alphabet(letter: str) -> str:
    return unicodedata.name(letter, "").partition(" ")[0] if letter.isalpha() else ""
