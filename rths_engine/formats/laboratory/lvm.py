"""LabVIEW measurement file (.lvm): channels as text, with unit, step, start and number of samples in the header.

A file can hold several segments. Segments whose headers state that time goes on are joined; segments of one sample each
become rows with the times of their headers; other segments are columns of their own, `Force (segment 2)`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.laboratory.lvm_channels import Channel, channels_of
from rths_engine.formats.laboratory.lvm_segments import END, parsed
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_CLOCK = 2e-3  # s: the clock of the computer, which gives date and time, against the axis of the samples
_HALF = 0.5  # of a step: parts that differ less from the next sample continue

Segments = Sequence[Sequence[Channel]]


def looks_like(source: Source) -> bool:
    """Whether the file states a LabVIEW header or its end."""
    lines = source.head_lines
    return bool(lines) and (lines[0].startswith("LabVIEW Measurement") or any(one.startswith(END) for one in lines))


def read(source: Source) -> Table:
    """The channels of the file. Raises FileError with the line where header or rows do not follow the format."""
    file = parsed(source.lines)
    found = [channels_of(segment, file) for segment in file.segments if segment.rows]
    if not found:
        raise FileError(Issue("file", "contains no rows of numbers", fix="get the file again"))
    segments = [one.channels for one in found]
    statements = [statement for one in found for statement in one.statements]
    notes = [*file.notes, *dict.fromkeys(note for one in found for note in one.notes)]
    relative = file.header.get("Time_Pref") == "Relative"
    if len(segments) == 1:
        columns = _columns(segments[0], _offsets(segments[0]))
    elif not all(_alike(segments[0], one) for one in segments):
        columns = [one for k, channels in enumerate(segments, 1) for one in _columns(channels, [0.0] * len(channels), k)]
        notes.append(f"{len(segments)} segments with different channels: each is read as columns of its own")
    else:
        columns, statement, note = _several(segments, relative)
        statements += statement
        notes.append(note)
    about = {
        key.lower(): file.header[key] for key in ("Operator", "Date", "Time", "Project", "Description") if key in file.header
    }
    return Table(
        "LabVIEW measurement file",
        distinct(columns),
        notes=tuple(notes),
        statements=tuple(statements),
        header="\n".join(file.text),
        about=about,
    )


def _alike(one: Sequence[Channel], other: Sequence[Channel]) -> bool:
    return [(a.name, a.unit, a.dt) for a in one] == [(b.name, b.unit, b.dt) for b in other]


def _offsets(channels: Sequence[Channel]) -> list[float]:
    """How much later than the first channel each channel began by date and time, s. Its X counts from there."""
    known = [one.began for one in channels if one.began is not None]
    if len(known) < len(channels):
        return [0.0] * len(channels)
    return [one - min(known) for one in known]


def _columns(channels: Sequence[Channel], offsets: Sequence[float], segment: int = 0) -> list[Column]:
    """Columns of the channels of a segment; time stamps with unequal steps become a column before their channel."""
    end = f" (segment {segment})" if segment else ""
    columns: list[Column] = []
    stamps: list[Column] = []
    for one, offset in zip(channels, offsets, strict=True):
        time = ""
        if one.times is not None and len(one.times) > 1:
            times = one.times + offset
            if not stamps or not np.array_equal(stamps[-1].values, times):
                number = f" {len(stamps) + 1}" if stamps else ""
                stamps.append(Column(f"X_Value{number}{end}", times, "s", quantity="time"))
                columns.append(stamps[-1])
            time = stamps[-1].name
        columns.append(Column(one.name + end, one.values, one.unit, one.dt, one.start + offset, time=time))
    return columns


def _several(segments: Segments, relative: bool) -> tuple[list[Column], list[Statement], str]:
    """Columns of several segments with the same channels, the statements on their times, and a note."""
    count, offsets = len(segments), _offsets(segments[0])
    starts = [[_start(segments, s, k, relative) for k in range(len(segments[0]))] for s in range(count)]
    statements = [] if relative else [one for k in range(len(segments[0])) for one in _clocks(segments, k)]
    if all(len(one.values) == 1 for channels in segments for one in channels):
        times = np.array([row[0] for row in starts])
        apart = max((abs(row[k] - row[0]) for row in starts for k in range(len(row))), default=0.0)
        late = f"; the channels differ by up to {apart:.2g} s" if apart > _CLOCK else ""
        columns = [Column("X_Value", times, "s", quantity="time")]
        columns += [
            Column(one.name, np.array([channels[k].values[0] for channels in segments]), one.unit, time="X_Value")
            for k, one in enumerate(segments[0])
        ]
        return columns, statements, f"{count} segments of one sample are read as rows at the times of their headers{late}"
    if all(_continues(segments, starts, s, k) for s in range(1, count) for k in range(len(segments[0]))):
        columns = [
            Column(
                one.name,
                np.concatenate([channels[k].values for channels in segments]),
                one.unit,
                one.dt,
                one.start + offsets[k],
            )
            for k, one in enumerate(segments[0])
        ]
        return columns, statements, f"{count} segments are joined: their headers state that time goes on"
    columns = []
    for s, channels in enumerate(segments):
        moved = [starts[s][k] - one.start + offsets[k] for k, one in enumerate(channels)]
        columns += _columns(channels, moved, s + 1)
    return (
        columns,
        statements,
        f"{count} segments are read as columns of their own: their headers do not state that time goes on",
    )


def _start(segments: Segments, s: int, k: int, relative: bool) -> float:
    """Time of the first sample of a segment, s: X0 where it differs between segments, else date and time."""
    one, first = segments[s][k], segments[0][k]
    if relative or one.began is None or first.began is None or any(channels[k].start != first.start for channels in segments):
        return one.start
    return first.start + one.began - first.began


def _clocks(segments: Segments, k: int) -> list[Statement]:
    """The start of each segment by date and time, beside X0 where X0 differs between segments."""
    first = segments[0][k]
    if all(channels[k].start == first.start for channels in segments):
        return []
    result = []
    for s, channels in enumerate(segments[1:], 2):
        one = channels[k]
        if one.began is not None and first.began is not None:
            what = f"start of segment {s} of {one.name} after segment 1 by date and time"
            later = one.start - first.start
            result.append(Statement(what, "Time", one.began - first.began, later, "s", _CLOCK + (one.dt or 0.0)))
    return result


def _continues(segments: Segments, starts: Sequence[Sequence[float]], s: int, k: int) -> bool:
    before = segments[s - 1][k]
    if before.dt is None or before.times is not None:
        return False
    return abs(starts[s][k] - starts[s - 1][k] - len(before.values) * before.dt) <= _HALF * before.dt


FORMAT = Format(
    key="lvm",
    title="LabVIEW measurement file (.lvm)",
    of="measurement",
    extensions=("lvm", "txt"),
    defined="LabVIEW Measurement File Specification, National Instruments",
    header="channels, units, samples, step, start, date and time of each segment, separator, decimal sign, comments",
    compared="number of channels and samples, Delta_X and X0 with X_Value, date and time of segments with X0",
    looks_like=looks_like,
    read=read,
    public=6,
    public_check="lvm_read 1.26; four more are refused: two are cut, in two time restarts without a header",
)
