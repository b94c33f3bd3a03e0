"""miniSEED 2 and 3: a column for each channel, in counts, or in the quantity that StationXML files of the same folder state.

value = (counts - mean) / sensitivity, in the input unit of the sensitivity. The mean of the whole record is removed, because
the offset of recorder and sensor is no motion. This holds in the flat band of the sensor; the response is not deconvolved.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement
from rths_engine.formats.strong_motion import stationxml
from rths_engine.formats.strong_motion.keyed import stamp
from rths_engine.formats.table import Column, Table, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_FIRST = re.compile(rb"[0-9 \0]{6}[DRQM][ \0]|MS\x03")
_NANOSECONDS = 1e9  # in a second, by definition
_ACCELEROMETER = "N"  # second letter of a channel's code, SEED manual, appendix A
_COUNTS = "i"  # type of samples: 32-bit integers
_TEXT = "t"
_RATE_WITHIN = 1e-3  # of a sampling rate; chosen, see docs/decisions/0023
_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


@dataclass(frozen=True, slots=True, eq=False)
class _Trace:
    """The samples of a channel without gaps. `start` and `end`: ns after 1970."""

    channel: str
    start: int
    end: int
    rate: float
    samples: Array
    counts: bool

    @property
    def began(self) -> datetime:
        return _EPOCH + timedelta(microseconds=self.start / 1000)

    @property
    def ended(self) -> datetime:
        return _EPOCH + timedelta(microseconds=self.end / 1000)


def looks_like(source: Source) -> bool:
    """Whether the content starts with a data record of miniSEED 2 or 3."""
    return bool(_FIRST.match(source.head))


def read(source: Source) -> Table:
    """Every channel as a column. Raises FileError for gaps, overlaps and damaged records."""
    traces, notes = _traces(source.bytes())
    known = stationxml.beside(source.path)
    first = min(one.start for one in traces)
    columns, statements = [], []
    for trace in traces:
        start = (trace.start - first) / _NANOSECONDS
        found = stationxml.at(known, trace.channel, trace.began, trace.ended)
        if found is not None and found.rate:
            within = _RATE_WITHIN * trace.rate
            what = f"sampling rate of {trace.channel}"
            statements.append(Statement(what, found.where, found.rate, trace.rate, "Hz", within))
        if found is not None and not trace.counts:
            notes.append(f"{trace.channel}: {found.shown} not applied, because the samples are decimal numbers, not counts")
            found = None
        columns.append(_column(trace, start, found))
    station = ".".join(traces[0].channel.split(".")[:2])
    began = min(one.began for one in traces)
    header = "\n".join(f"{one.channel}  {stamp(one.began)}  {one.rate:g} Hz  {len(one.samples)} samples" for one in traces)
    about = {"title": f"{station}, {began:%Y-%m-%d %H:%M:%S} UTC", "station": station, "start": stamp(began)}
    return Table("miniSEED", tuple(columns), notes=tuple(notes), statements=tuple(statements), header=header, about=about)


def _column(trace: _Trace, start: float, found: stationxml.Sensitivity | None) -> Column:
    dt = 1 / trace.rate
    if found is None:
        return Column(trace.channel, trace.samples, "counts" if trace.counts else "", dt, start)
    quantity, unit, factor = found.unit
    if trace.channel.split(".")[-1][1:2] == _ACCELEROMETER and quantity != "acceleration":
        problem = f"states the sensitivity of the accelerometer {trace.channel} for {quantity}, true at one frequency only"
        fix = "remove the StationXML file and give the unit of one count, for example '2.34e-6 m/s^2'"
        raise FileError(Issue(found.where, problem, found.shown, fix))
    mean = float(np.mean(trace.samples))
    values = (trace.samples - mean) / found.counts * factor
    applied = f"(counts - mean) / {found.shown} of {found.where}; the mean, {mean:.6g} counts, is removed"
    return Column(trace.channel, values, unit, dt, start, quantity, applied)


def _traces(raw: bytes) -> tuple[list[_Trace], list[str]]:
    """The traces, and notes on what they do not contain."""
    from pymseed import MS3Record, MS3TraceList, clear_error_messages, get_error_messages, sourceid2nslc

    clear_error_messages()
    try:
        sizes = [one.samplecnt for one in MS3Record.from_buffer(raw)]  # refuses what the list below drops: a cut last record
        refuse_many(sum(sizes))
        listed = MS3TraceList.from_buffer(raw, unpack_data=True)
    except FileError:
        raise
    except Exception as error:
        raise FileError(Issue("file", "cannot be read as miniSEED", str(error), "get the file again")) from None
    if said := get_error_messages():
        raise FileError(Issue("file", "contains a damaged record", said[0].strip(), "get the file again"))
    traces, notes = [], []
    for one in listed:
        channel = stationxml.identity(*sourceid2nslc(one.sourceid))
        segments = [part for part in one if part.sampletype != _TEXT and part.samplecnt]
        if not segments:
            notes.append(f"{channel} left out: it contains no samples")
            continue
        if len(segments) > 1:
            problem = f"{channel} has a gap or an overlap"
            ends, next_start = segments[0].endtime_str(), segments[1].starttime_str()
            value = f"{segments[0].samplecnt} samples end at {ends}, the next start at {next_start}"
            raise FileError(Issue("file", problem, value, "cut the record so that it has no gap"))
        part = segments[0]
        if part.samprate <= 0:
            raise FileError(Issue("file", f"{channel} has no sampling rate", f"{part.samprate:g}", "get the file again"))
        samples = np.array(part.np_datasamples, dtype=float)
        traces.append(_Trace(channel, part.starttime, part.endtime, part.samprate, samples, part.sampletype == _COUNTS))
    if not traces:
        raise FileError(Issue("file", "contains no samples", fix="get the file again"))
    if sum(len(one.samples) for one in traces) != sum(sizes):
        stated, found = sum(sizes), sum(len(one.samples) for one in traces)
        problem = f"states {stated} samples in its records; {found} can be read"
        raise FileError(Issue("file", problem, fix="get the file again: records are repeated or damaged"))
    return traces, notes


FORMAT = Format(
    key="mseed",
    title="miniSEED",
    of="ground motion",
    extensions=("mseed", "miniseed", "ms", "seed"),
    defined="FDSN miniSEED 2.4 and 3; FDSN StationXML",
    header="channel, sampling rate, start (UTC); sensitivity and unit from StationXML files in the same folder",
    compared="samples of each record, check value of each record, gaps, sampling rate and epoch of the StationXML",
    looks_like=looks_like,
    read=read,
    public=92,
    public_check="ObsPy 1.5.1: number of samples, step, and the peak of 66 channels with their StationXML; three more "
    "are refused, because their StationXML states metres for an accelerometer",
    library="pymseed",
    apart=True,
)
