"""MTS 793 text as MultiPurpose TestWare writes it: a line of the locale, then blocks with their own headers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

Rows = Sequence[Sequence[float]]


@dataclass(frozen=True)
class Words:
    """The words of a language."""

    locale: str
    decimal: str
    title: str
    time: str
    points: str
    date: str


ENGLISH = Words("MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A", ".", "Data Acquisition", "Time:", "Points: ", "5/13/2024 10:49:14 AM")
GERMAN = Words("MTS793|MPT|DEU|1|2|,|.|:|49|1|1|A", ",", "Datenerfassung", "Zeit:", "Punkte: ", "13.05.2024 10:49:14")
MASKED = Words("MTS***|MPT|**|*|*|*|*|*|*|*|*|*", ",", "Adquisición cíclica", "Tiempo", "Puntos: ", "13/05/2024 10:49:14")
DAY = 45425  # 2024-05-13, in days since 1899-12-30


def operator(words: Words) -> list[str]:
    """A block of text, with an empty line and a line of numbers inside."""
    first = f"Operator Information\t\t\tCube\t\t\t{words.time}\t{number(1.5, words.decimal)}\ts\t{words.date}"
    return [first, "Date\t5/13/2024", "Mass [g]:\t7985", "", "12\t13", "Operator Information End", ""]


def number(value: float, decimal: str) -> str:
    return f"{value:.8g}".replace(".", decimal)


def block(
    words: Words,
    names: Sequence[str],
    units: Sequence[str],
    rows: Rows,
    *,
    stamp: float,
    points: int | None = None,
    end: str = "",
) -> list[str]:
    lines = [f"{words.title}\t\t\t\t\t\t{words.time}\t{number(stamp, words.decimal)}\ts\t{words.date}"]
    if points is not None:
        lines += ["Stored at: \t100\tcycle\t\t\tStored for: \t2\tsegments", f"{words.points}\t{points}"]
    lines += ["\t".join(names), "\t".join(units)]
    lines += ["\t".join(number(one, words.decimal) for one in row) for row in rows]
    return [line + end for line in lines]


def written(words: Words, blocks: Sequence[Sequence[str]], text: Sequence[str] = ()) -> bytes:
    lines = [words.locale, "", *text]
    for one in blocks:
        lines += [*one, ""]
    return "\r\n".join(lines).encode("cp1252")
