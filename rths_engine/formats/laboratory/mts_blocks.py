"""Blocks of an MTS text file: their own headers, names, units and rows; texts of the operator; extremes of the test."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date

from rths_engine.formats.laboratory import rows
from rths_engine.formats.laboratory.rows import Line
from rths_engine.foundation.errors import FileError, Issue

# by definition: MTS 793 MultiPurpose TestWare, manual 100-147-131, "Data File Header"
_DELIMITERS = {"0": "", "1": ",", "2": "\t"}
_ORDER = {"0": (2, 0, 1), "1": (2, 1, 0), "2": (0, 1, 2)}  # of year, month and day in a date, Windows iDate
_DAY_ZERO = date(1899, 12, 30)
_STAMP_FIELDS = 4  # word, number, unit and date at the end of the first line of a block
_LONGEST_HEADER = 50  # lines of the header of a block; chosen, see docs/decisions/0023
_POINTS = re.compile(r"(points?|puntos|punkte|punti|pontos|punten)\s*:?", re.IGNORECASE)


@dataclass(frozen=True)
class Locale:
    """How the file writes fields, decimals and dates. `decimal` is empty where the file does not state it."""

    delimiter: str = "\t"
    decimal: str = ""
    order: tuple[int, int, int] | None = None

    @classmethod
    def of(cls, line: str) -> Locale:
        """The locale in the first line, `MTS793|MPT|DEU|1|2|,|.|:|49|1|1|A`."""
        given = line.strip().strip('"').split("|")
        delimiter, decimal, order = (given[k] if k < len(given) else "" for k in (4, 5, 9))
        return cls(_DELIMITERS.get(delimiter, "\t"), decimal if decimal in {".", ","} else "", _ORDER.get(order))

    def fields(self, text: str) -> list[str]:
        """The fields of a line without empty ones at its end."""
        if self.delimiter == ",":
            found = [one.strip() for one in next(csv.reader([text]))]
        else:
            found = [one.strip().strip('"') for one in rows.fields(text, self.delimiter)]
        while found and not found[-1]:
            found.pop()
        return found

    def number(self, text: str) -> float | None:
        if not text:
            return None
        found = rows.number(text, self.decimal or ".")
        return rows.number(text, ",") if found is None and not self.decimal else found


@dataclass
class Block:
    """A block of rows. `stamp`: the time of the controller when the block was written, s; `day`: its date."""

    at: int
    title: str
    stamp: float | None
    day: int | None
    names: list[str] = field(default_factory=list)
    units: list[str] = field(default_factory=list)
    points: tuple[float, str] | None = None
    rows: list[Line] = field(default_factory=list)


def parsed(lines: Sequence[str]) -> tuple[Locale, list[Block], list[str], dict[str, str]]:
    """Locale, blocks of data, the text of all headers, and what the operator wrote. Raises FileError with the line."""
    locale = Locale.of(lines[0])
    blocks: list[Block] = []
    header = [lines[0]]
    about: dict[str, str] = {}
    numbered = list(enumerate(lines, start=1))[1:]
    while numbered:
        at, text = numbered[0]
        if not locale.fields(text):
            numbered = numbered[1:]
            continue
        block = _opened(at, text, locale)
        if block is None:
            problem = "does not belong to a block: each block begins with its time and date"
            raise FileError(Issue(f"line {at}", problem, text.strip(), "write the file with a header for each block"))
        end = _end_of_text(numbered, block.title, locale)
        body = numbered[1:end] if end else _until_empty(numbered[1:], locale)
        header.append(text)
        if end:
            header += [one for _, one in body]
            about |= _pairs([locale.fields(one) for _, one in body[:-1]])
        else:
            header += _fill(block, body, locale)
            blocks.append(block)
        numbered = numbered[1 + len(body) :]
    return locale, blocks, header, about


def _opened(at: int, text: str, locale: Locale) -> Block | None:
    """The block that a line such as `Data Acquisition ... Time: 199.87 Sec 12/31/2019 10:49:14 AM` begins."""
    given = locale.fields(text)
    for k in range(1, len(given) - 2):
        value = locale.number(given[k + 1])
        word = bool(given[k].rstrip(":")) and locale.number(given[k]) is None
        dated = len(given) >= k + _STAMP_FIELDS and re.match(r"\d+\D\d+\D\d+", given[k + 3])
        if word and dated and value is not None and re.match(r"\D+$", given[k + 2]):
            seconds = value if given[k + 2].lower() in {"s", "sec"} else None
            return Block(at, given[0], seconds, _day(given[k + 3], locale))
    return None


def _day(text: str, locale: Locale) -> int | None:
    """The date as days since 1899-12-30; None where the file does not state the order of day and month."""
    numbers = [int(one) for one in re.findall(r"\d+", text)[:3]]
    if locale.order is None or len(numbers) < 3:
        return None
    try:
        return (date(*(numbers[k] for k in locale.order)) - _DAY_ZERO).days
    except (ValueError, OverflowError):
        return None


def _end_of_text(numbered: Sequence[Line], title: str, locale: Locale) -> int:
    """Where a block of text ends with its own title and a word, `Operator Information End`; 0 for a block of data."""
    for k, (at, text) in enumerate(numbered[1:], start=1):
        if text[:1].isdigit() or text[:1] in "-+.":
            continue
        if text.lstrip('"').startswith(f"{title} ") and len(locale.fields(text)) == 1:
            return k + 1
        if text.strip() and _opened(at, text, locale):
            return 0
    return 0


def _until_empty(numbered: Sequence[Line], locale: Locale) -> list[Line]:
    count = next((k for k, (_, text) in enumerate(numbered) if not text.strip().strip(locale.delimiter or None)), len(numbered))
    return list(numbered[:count])


def _fill(block: Block, body: list[Line], locale: Locale) -> list[str]:
    """Names, units, stated number of points and rows of a block of data; returns the lines of its header."""
    given = [locale.fields(text) for _, text in body[:_LONGEST_HEADER]]
    first = next((k for k, row in enumerate(given) if k > 1 and all(locale.number(one) is not None for one in row)), len(given))
    if first < 2 or any(one.endswith(":") for one in given[first - 2]):
        fix = "a block has a row of names, a row of units, then rows of numbers"
        raise FileError(Issue(f"line {block.at}", "has no row of names and of units", block.title, fix))
    block.names, block.units = given[first - 2], given[first - 1]
    if len(block.units) > len(block.names):
        problem = f"names {len(block.names)} columns; the next line has {len(block.units)} units"
        raise FileError(Issue(f"line {body[first - 2][0]}", problem, fix="correct the names or the units"))
    block.units += [""] * (len(block.names) - len(block.units))
    for (at, _), row in zip(body[: first - 2], given, strict=False):
        if len(row) == 2 and _POINTS.fullmatch(row[0]) and (count := locale.number(row[1])) is not None:
            block.points = (count, f"line {at}")
    block.rows = body[first:]
    return [text for _, text in body[:first]]


def _pairs(given: Sequence[Sequence[str]]) -> dict[str, str]:
    """What the operator wrote as `word: value` or in two fields."""
    found = {}
    for row in given:
        key, _, value = (
            row[0].partition(":") if len(row) == 1 else (row[0].rstrip(": "), "", " ".join(row[1:])) if row else ("",) * 3
        )
        if key.strip() and value.strip():
            found[key.strip()] = value.strip()
    return found
