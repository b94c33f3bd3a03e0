"""Search in the documents: the sections that contain every word, those with words in their heading first."""

from __future__ import annotations

import re
from dataclasses import dataclass

from app.help.documents import Section, paths, sections, title

MOST_FOUND = 30
EXCERPT = 220  # characters
IN_HEADING = 20  # occurrences in the text that one word in the heading weighs
DECISION = 0.2  # weight of a decision record: what a user asks is rarely in it


@dataclass(frozen=True, slots=True)
class Found:
    """A section that was found: the title of its document, its address, and parts of its text, each marked or not."""

    title: str
    heading: str
    address: str
    excerpt: list[tuple[str, bool]]


def search(query: str) -> list[Found]:
    """The best sections for a query, at most MOST_FOUND. An empty query finds nothing."""
    words = [word.casefold() for word in query.split()]
    if not words:
        return []
    ranked = [(_weight(section, words), section) for name in paths() for section in sections(name)]
    best = sorted((one for one in ranked if one[0] > 0), key=lambda one: -one[0])
    return [_found(section, words) for _, section in best[:MOST_FOUND]]


def _weight(section: Section, words: list[str]) -> float:
    heading, text = section.heading.casefold(), section.text.casefold()
    counts = [IN_HEADING * heading.count(word) + text.count(word) for word in words]
    if not all(counts):
        return 0.0
    return sum(min(count, 3 * IN_HEADING) for count in counts) * (DECISION if "/decisions/" in section.document else 1.0)


def _found(section: Section, words: list[str]) -> Found:
    anchor = f"#{section.anchor}" if section.anchor else ""
    return Found(title(section.document), section.heading, f"/help/{section.document}{anchor}", _excerpt(section.text, words))


def _excerpt(text: str, words: list[str]) -> list[tuple[str, bool]]:
    """The text around the first word, in parts that are marked where a word stands."""
    pattern = re.compile("(" + "|".join(re.escape(word) for word in words) + ")", re.IGNORECASE)
    first = pattern.search(text)
    start = max(0, (first.start() if first else 0) - EXCERPT // 3)
    start = text.rfind(" ", 0, start) + 1 if start else 0
    part = text[start : start + EXCERPT]
    shown = ("… " if start else "") + part + (" …" if start + EXCERPT < len(text) else "")
    return [(piece, bool(pattern.fullmatch(piece))) for piece in pattern.split(shown) if piece]
