"""What the header of a text states in words: counts, steps, durations, peaks, units and marks of missing values.

Both readers of plain text read it, and compare each of these with the data.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rths_engine.formats.plain import header_lines, header_span, header_units
from rths_engine.formats.plain import header_words as words
from rths_engine.formats.plain.form import Line
from rths_engine.formats.plain.header_lines import Peak
from rths_engine.formats.statement import Statement, Written
from rths_engine.foundation import unit_names, units
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_SAME_STEP = 2e-3  # relative: two statements of one step in a header
_ROUNDED = 0.02  # relative: rounding of a stated step, rate or duration, at most


@dataclass(frozen=True)
class Facts:
    """What a header states. `steps` and `durations` in s; `unclear` names what lacks a unit; `width`: of a Fortran field.

    `units`: of the data, one for each column or block where there are several. `factors`: line and statement of each.
    """

    counts: tuple[Written, ...] = ()
    steps: tuple[Written, ...] = ()
    durations: tuple[tuple[Written, bool], ...] = ()
    peaks: tuple[Peak, ...] = ()
    missing: tuple[Written, ...] = ()
    channels: tuple[Written, ...] = ()
    components: tuple[str, ...] = ()
    units: tuple[unit_names.Written, ...] = ()
    width: int = 0
    unclear: tuple[str, ...] = ()
    spans: tuple[tuple[Written, bool], ...] = ()
    factors: tuple[tuple[str, str], ...] = ()

    @property
    def unit(self) -> unit_names.Written:
        """The unit of the data; no unit where the header states none, or several."""
        return self.units[0] if len(self.units) == 1 else header_units.NONE

    @property
    def dt(self) -> float | None:
        """The step (s); None where the header does not state it with certainty."""
        return self.steps[0].value if self.steps else None

    def step_statements(self, read: float) -> list[Statement]:
        """Each stated step beside the step `read` (s) of a time column."""
        return [
            Statement("time step", one.where, one.value, read, "s", max(1e-3 * read, min(one.within, _ROUNDED * read)))
            for one in self.steps
        ]

    def channel_statements(self, signals: int, others: int) -> list[Statement]:
        """Each stated number of channels beside the number of signals; `others`: columns of time and sample numbers."""
        found = []
        for one in self.channels:
            read = min(range(signals, signals + others + 1), key=lambda count: abs(count - one.value))
            found.append(Statement("number of channels", one.where, one.value, read))
        return found

    def duration_statements(self, count: int, dt: float, start: float = 0.0) -> list[Statement]:
        """Each stated duration beside `count` samples at `dt`: from the first to the last sample, or one step more."""
        found = header_span.statements(self.spans, count, dt, start)
        for one, sure in self.durations:
            spans = (count * dt, (count - 1) * dt)
            read = min(spans, key=lambda span: abs(span - one.value))
            within = max(dt / 2, min(one.within, _ROUNDED * read))
            scales = (1.0,) if sure else (1.0, 60.0, 1e-3)
            value = min((scale * one.value for scale in scales), key=lambda value: abs(value - read))
            found.append(
                Statement("duration", one.where, value if abs(value - read) <= within else one.value, read, "s", within)
            )
        return found


def read(header: Sequence[Line]) -> Facts:
    """The facts in the numbered lines of a header. Raises FileError where two stated steps differ."""
    counts: list[Written] = []
    steps: list[Written] = []
    durations: list[tuple[Written, bool]] = []
    peaks: list[Peak] = []
    missing: list[Written] = []
    channels: list[Written] = []
    components: tuple[str, ...] = ()
    unclear: list[str] = []
    factors: list[tuple[str, str, list[unit_names.Written]]] = []
    decimated = ""
    width = 0
    for at, typed in header:
        text, where = words.plain(typed), f"line {at}"
        counts += header_lines.counts(text, where)
        found, doubts = header_lines.steps(text, where)
        steps += [one for one in found if one not in steps]
        unclear += doubts
        durations += header_lines.durations(text, where)
        peaks = header_lines.with_peaks(peaks, text, where)
        missing += header_lines.missing(text, where)
        channels += header_lines.channels(text, where)
        components = header_lines.components(text) or components
        width = header_lines.width(text) or width
        if scaled := header_lines.factor(text):
            factors.append((where, scaled, header_units.per_count(typed)))
        if kept := header_lines.decimation(text):
            decimated = f"{where} states '{kept}', and the header a time step: which samples it is of is not clear"
    if decimated and steps:
        steps, unclear = [], [decimated]
    _refuse_two(steps)
    units_of_data = header_units.stated(header)
    clear = tuple(dict.fromkeys(unclear)) if not steps else ()
    return Facts(
        tuple(counts),
        tuple(steps),
        tuple(durations),
        tuple(peaks),
        tuple(missing),
        tuple(channels),
        components,
        units_of_data,
        width,
        clear,
        header_span.spans(header),
        tuple((where, text) for where, text, used in factors if not used or units_of_data[:1] != tuple(used)),
    )


def _refuse_two(steps: Sequence[Written]) -> None:
    for one in steps[1:]:
        first = steps[0]
        if abs(one.value - first.value) > max(_SAME_STEP * first.value, min(one.within + first.within, _ROUNDED * first.value)):
            problem = f"states a time step of {one.value:.7g} s; {first.where} states {first.value:.7g} s"
            raise FileError(Issue(one.where, problem, fix="the file contradicts itself: get it again, or correct the header"))


def in_unit(peak: Peak, unit: str) -> Written | None:
    """The peak in `unit`, a unit of the table; None where the units cannot be compared."""
    written = unit_names.read(peak.unit)
    if not peak.unit or not unit:
        return peak.value
    if not written.unit or units.dimension(written.unit) != units.dimension(unit):
        return None
    factor = written.scale * units.factor(written.unit) / units.factor(unit)
    return Written(peak.value.value * factor, peak.value.within * factor, peak.value.where)
