"""The units that a header states for its data, and the factors that it states beside them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rths_engine.formats.plain import header_lines
from rths_engine.formats.plain import header_words as words
from rths_engine.formats.plain.form import COMMENT, Line
from rths_engine.formats.units_in_text import acceleration_in
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.errors import FileError, Issue
from rths_engine.foundation.unit_names import Written

NONE = Written("")

_LABEL = re.compile(words.UNIT, re.IGNORECASE)
_NEXT = re.compile(r"[,;|]|\s{2,}|\t|\bdt\b|(?:^|\s)(?:and|und|et|y|e|&)\s", re.IGNORECASE)
_TIMES = re.compile(r"\s*[x*\u00d7\u00b7]\s*[\d.]", re.IGNORECASE)
_OTHER_DATA = re.compile(r"conver|original|umgerechnet|urspr|transform|trasform|instead|target", re.IGNORECASE)
_COUNTS = re.compile(
    r"^\W*(?:raw|adc|digital|integer)?\s*counts?\b|\bin\s+(?:raw\s+|adc\s+)?counts\b|[(\[]counts?[)\]]", re.IGNORECASE
)
_COUNT = r"(?:adc\s+)?(?:counts?|digits?|lsb|bits?)"
_UNIT = r"[a-z\u00b5\u03bc][a-z0-9/^*.-]*?"
_NUMBER = rf"(?P<v>{words.NUMBER})"
_PER_COUNT = (
    re.compile(rf"(?<![\w.])(?:1\s*)?{_COUNT}\s*(?:=|is|equals)\s*{_NUMBER}\s*(?P<unit>{_UNIT})(?=[\s,;)]|$)", re.IGNORECASE),
    re.compile(rf"{_NUMBER}\s*\(?(?P<unit>{_UNIT})\)?\s*(?:/|\bper\s)\s*{_COUNT}\b", re.IGNORECASE),
)
_COUNTS_PER = re.compile(rf"{_NUMBER}\s*{_COUNT}\s*(?:/|\bper\s)\s*\(?(?P<unit>{_UNIT})\)?(?=[\s,;]|$)", re.IGNORECASE)


def stated(header: Sequence[Line]) -> tuple[Written, ...]:
    """The units after `units:`; else the unit in a sentence about neither peaks nor sensors; empty where there is none.

    Several units are those of several columns or blocks. Counts have the unit of one count, where the header states it. Raises
    FileError where two lines state different units of one dimension.
    """
    typed = [(at, words.without_accents(text)) for at, text in header]
    own = [(at, text) for at, text in typed if not _about_other(text)]
    labelled = [(at, found) for at, text in own if (found := labelled_in(text))]
    _refuse_two([(at, one) for at, found in labelled if len(found) == 1 for one in found])
    sentences = [
        (at, text) for at, text in own if not _LABEL.search(text) and not per_count(text) and not _OTHER_DATA.search(text)
    ]
    spoken = [(at, one) for at, text in sentences if not (one := acceleration_in(text)).none]
    if labelled:
        found = labelled[0][1]
        if len(found) == 1:
            _refuse_two([(labelled[0][0], found[0]), *spoken])
    else:
        together = acceleration_in("\n".join(text for _, text in sentences))
        found = () if together.none else (together,)
    counts = [one for _, text in typed for one in per_count(text)]
    if len(counts) == 1 and len(found) < 2:
        unit = found[0].plain if found else ""
        if unit == "count" or (not unit and any(_COUNTS.search(COMMENT.sub("", text.lstrip(), count=1)) for _, text in typed)):
            return (counts[0],)
    return found


def listed(header: Sequence[Line]) -> tuple[str, tuple[Written, ...]]:
    """The line of units and its units, all of which are known; empty where the header has none."""
    for at, typed in header:
        text = words.without_accents(typed)
        if not _about_other(text) and (found := labelled_in(text)) and all(one.unit for one in found):
            return f"line {at}", found
    return "", ()


def is_line(text: str) -> bool:
    """Whether a line of a header begins with `units:` and states them; a cell `units:` beside others does not."""
    return bool((label := _LABEL.match(words.without_accents(text))) and text[label.end() :].strip(" \t,;|"))


def labelled_in(text: str) -> tuple[Written, ...]:
    """The units after `units:` in a line; empty where it states none."""
    label = _LABEL.search(text)
    if label is None:
        return ()
    found: list[Written] = []
    for part in _NEXT.split(text[label.end() :].strip(" \"'")):
        if not (named := part.strip(" \"'").removesuffix(".")):
            continue
        several = _known(named)
        if not several:
            break
        found += several
    if found:
        return tuple(found)
    named = _NEXT.split(text[label.end() :].strip(" \"'"), maxsplit=1)[0].strip(" \"'.")
    short = " ".join(named.split(" ")[:2])
    return () if unit_names.read(named.split(" ")[0]).none else (unit_names.read(short),)


def _known(named: str) -> list[Written]:
    """The unit or the units that begin the text; a factor behind a unit makes it an unknown one."""
    parts = named.split(" ")
    for end in range(len(parts), 0, -1):
        unit = unit_names.read(" ".join(parts[:end]))
        if not unit.unit or unit.plain == "1":
            continue
        rest = " ".join(parts[end:])
        if _TIMES.match(rest):
            return [Written(named, problem=f"the factor in '{named}' can multiply or divide")]
        others = [unit_names.read(part) for part in parts[end:]]
        return [unit, *others] if others and all(one.unit for one in others) else [unit]
    return []


def per_count(text: str) -> list[Written]:
    """The unit of one count that the line states: `1 count = 0.1 gal`, `0.1 gal/count`, `427350 counts/(m/s^2)`."""
    found = []
    for pattern in (*_PER_COUNT, _COUNTS_PER):
        for match in pattern.finditer(text):
            unit, value = unit_names.read(match["unit"]), words.number(match["v"].lower())
            if unit.unit and unit.dimension not in {"count", "time", "number"} and value > 0:
                scale = unit.scale * (1 / value if pattern is _COUNTS_PER else value)
                found.append(Written(match[0].strip(), *unit_names.simplest(unit.unit, scale)))
    return found


def same(one: Written, other: Written) -> bool:
    """Whether two units of a dimension are one unit, or are of different dimensions or not known."""
    if not one.unit or not other.unit or one.dimension != other.dimension:
        return True
    first, second = (each.scale * units.factor(each.unit) for each in (one, other))
    return abs(first - second) <= 1e-9 * first


def _refuse_two(found: Sequence[tuple[int, Written]]) -> None:
    for at, one in found[1:]:
        before, first = found[0]
        if not same(one, first):
            problem = f"states the unit {one.text}; line {before} states {first.text}"
            fix = "the file contradicts itself: get it again, or correct the header"
            raise FileError(Issue(f"line {at}", problem, fix=fix))


def _about_other(typed: str) -> bool:
    text = words.plain(typed)
    return bool(words.OTHER_UNIT.search(text) or header_lines.PEAK.search(text) or header_lines.MINIMUM.search(text))
