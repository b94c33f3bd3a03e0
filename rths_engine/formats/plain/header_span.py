"""Start and end that a header states: as clock times, or in seconds."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rths_engine.formats.plain import header_lines
from rths_engine.formats.plain import header_words as words
from rths_engine.formats.plain.form import Line
from rths_engine.formats.statement import Statement, Written

_DAY = 86400.0  # s, by definition
_ROUNDED = 0.02  # relative: rounding of a stated end, at most; chosen, see docs/decisions/0023
_CLOCK = r"(?P<h>[01]?\d|2[0-3]):(?P<m>[0-5]\d):(?P<s>[0-5]\d(?:[.,]\d+)?)"
_DATE = r"(?P<date>\d{1,4}[-/.]\d{1,2}[-/.]\d{1,4})?[\st,;]*"
_IN_SECONDS = rf"(?P<v>{words.NUMBER})\s*(?P<unit>{words.TIME_UNIT})"
_CLOCKS = tuple(
    re.compile(rf"(?<![a-z_])(?:{label}){words.BRACKET}{words.IS}{_DATE}{_CLOCK}") for label in (words.START, words.END)
)
_SECONDS = tuple(
    re.compile(
        rf"(?<![a-z_])(?:{label})(?:\s*[(\[]\s*(?P<b>{words.TIME_UNIT})\s*[)\]]{words.IS}(?P<w>{words.NUMBER})|{words.IS}{_IN_SECONDS})"
    )
    for label in (words.START, words.END)
)


def spans(header: Sequence[Line]) -> tuple[tuple[Written, bool], ...]:
    """From the start to the end (s) that the header states, and whether the start is stated: else it is zero."""
    clocks: list[tuple[float, float, str, str] | None] = [None, None]
    seconds: list[Written | None] = [None, None]
    for at, typed in header:
        text = words.plain(typed)
        for k in (0, 1):
            if found := _CLOCKS[k].search(text):
                clock = found["s"].replace(",", ".")
                digit = 10.0 ** -len(clock.partition(".")[2])
                value = 3600 * int(found["h"]) + 60 * int(found["m"]) + float(clock)
                clocks[k] = value, digit, found["date"] or "", f"line {at}"
            elif found := _SECONDS[k].search(text):
                seconds[k] = header_lines.written(
                    found["v"] or found["w"], f"line {at}", header_lines.scale(found["unit"] or found["b"])
                )
    spans: list[tuple[Written, bool]] = []
    start, end = clocks
    if start and end and start[2] == end[2]:
        spans.append((Written((end[0] - start[0]) % _DAY, (start[1] + end[1]) / 2, end[3]), True))
    first, last = seconds
    if last is not None:
        zero = first or Written(0.0, 0.0, "")
        spans.append((Written(last.value - zero.value, last.within + zero.within, last.where), first is not None))
    return tuple(spans)


def statements(stated: Sequence[tuple[Written, bool]], count: int, dt: float, start: float) -> list[Statement]:
    """Each stated span beside that of `count` samples at `dt`, of which the first is at `start`."""
    found = []
    for one, started in stated:
        begin = 0.0 if started else start
        read = min((begin + (count - less) * dt for less in (1, 0)), key=lambda span: abs(span - one.value))
        within = max(dt, one.within, _ROUNDED * read)
        found.append(
            Statement("time from start to end" if started else "time of the end", one.where, one.value, read, "s", within)
        )
    return found
