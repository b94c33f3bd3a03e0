"""HBM catman binary (.bin): the channels in calibrated units, with the sampling interval of each channel.

Layout: file header, one header for each channel, then the samples of one channel after the other, as 8-byte or 4-byte reals or
as 2-byte whole numbers between the least and the largest value of the channel.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

import numpy as np

from rths_engine.formats import damage
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.stamps import equal_steps
from rths_engine.formats.statement import Statement
from rths_engine.formats.table import Column, Table, distinct, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# by definition of the format
_IDS = range(5007, 5100)
_RESERVED = 32  # texts after the comment of the file
_OVERFLOW = -1_000_000.0  # what catman stores where a transducer is not connected or out of range
_SIZES = {0: 8, 1: 4, 2: 2}  # export format -> bytes of a sample
_WHOLE = 32767  # steps between the least and the largest value
_NUMERIC = 0
_EXTENDED = 141  # bytes of the extended header up to the export format
_DAY_ZERO = datetime(1899, 12, 30, tzinfo=UTC)
_MOST_CHANNELS = 4096


@dataclass(frozen=True)
class _Channel:
    name: str
    unit: str
    comment: str
    samples: int
    kind: int
    begun: float
    dt: float
    form: int


class _Bytes:
    """Numbers and texts one after the other. Raises FileError at the end of the file."""

    def __init__(self, raw: bytes) -> None:
        self.raw, self.at = raw, 0

    def numbers(self, form: str) -> tuple[float, ...]:
        form = "<" + form
        found = struct.unpack(form, self.take(struct.calcsize(form)))
        return found

    def whole(self, form: str = "h") -> int:
        return int(self.numbers(form)[0])

    def text(self, form: str = "h") -> str:
        return self.take(self.whole(form)).decode("cp1252", "replace").rstrip("\0")

    def take(self, length: int) -> bytes:
        found = self.raw[self.at : self.at + length] if length >= 0 else b""
        if length < 0 or len(found) != length:
            fix = "the file is cut or is not of this format: export it again"
            raise FileError(Issue(f"byte {self.at}", f"needs {length} bytes; the file has {len(found)}", fix=fix))
        self.at += length
        return found


def looks_like(source: Source) -> bool:
    """Whether the content begins with the identification of catman and an offset of the samples within the file."""
    if source.extension != "bin" or len(source.head) < 8:
        return False
    number, offset, length = struct.unpack_from("<hih", source.head)
    return number in _IDS and 0 < offset <= source.size and 0 <= length < offset


def read(source: Source) -> Table:
    """Read the file. Raises FileError where it does not follow the layout."""
    with damage.refused("catman"):
        return _table(_Bytes(source.bytes()))


def _table(raw: _Bytes) -> Table:
    number, offset, comment = raw.whole(), raw.whole("i"), raw.text()
    reserved = [raw.text() for _ in range(_RESERVED)]
    count = raw.whole()
    if not 0 < count <= _MOST_CHANNELS:
        raise FileError(Issue(f"byte {raw.at}", f"states {count} channels", fix="the file is damaged: export it again"))
    raw.numbers(f"i{count}ii")  # greatest length, places of the channels, reduction
    channels = [_channel(raw) for _ in range(count)]
    refuse_many(sum(one.samples for one in channels))
    if raw.at > offset:
        raise FileError(Issue("byte 2", f"states that samples begin at byte {offset}; the headers end at {raw.at}"))
    raw.at = offset
    columns: list[Column] = []
    notes: list[str] = []
    statements: list[Statement] = []
    for one in channels:
        if one.kind != _NUMERIC:
            problem = "contains text, whose length the format does not state"
            raise FileError(Issue(f"channel {one.name}", problem, fix="export the file without this channel"))
        values, agreed = _samples(raw, one)
        statements += agreed
        missing = values == _OVERFLOW
        if missing.any():
            mark = f"catman's mark for overflow, {_OVERFLOW:g}"
            notes.append(f"{one.name}: {missing.sum()} of {len(values)} samples are {mark}: they are missing")
            values = np.where(missing, np.nan, values)
        if len(values) == 0:
            notes.append(f"{one.name} contains no samples")
            continue
        statements += _step(one, values)
        dt = one.dt / 1000 if one.dt > 0 else None
        columns.append(Column(one.name, values, one.unit, dt, quantity="time" if _time(one) else ""))
    about = {"begun": _date(channels[0].begun), "title": comment, "version": str(number)}
    header = "\n".join([comment, *(text for text in reserved if text.strip()), *(f"{one}" for one in channels)])
    return Table("catman", distinct(columns), notes=tuple(notes), statements=tuple(statements), header=header, about=about)


def _channel(raw: _Bytes) -> _Channel:
    raw.whole()
    samples, name, unit, comment = raw.whole("i"), raw.text(), raw.text(), raw.text()
    kind, _ = raw.whole(), raw.whole()
    raw.numbers("d")
    extended = raw.take(raw.whole("i"))
    begun, dt = struct.unpack_from("<dd", extended) if len(extended) >= 16 else (0.0, 0.0)
    form = extended[_EXTENDED - 1] if len(extended) >= _EXTENDED else 0
    raw.take(2)  # linearisation, scaling
    raw.take(8 * raw.take(1)[0])  # points of the linearisation
    raw.whole()  # thermocouple
    raw.text()  # formula
    raw.text("i")  # sensor
    if form not in _SIZES or samples < 0:
        raise FileError(Issue(f"channel {name}", f"states {samples} samples in the form {form}", fix="export it again"))
    return _Channel(name.strip(), unit.strip(), comment, samples, kind, begun, dt if np.isfinite(dt) else 0.0, form)


def _samples(raw: _Bytes, one: _Channel) -> tuple[Array, list[Statement]]:
    size = _SIZES[one.form]
    if size > 2:
        return np.frombuffer(raw.take(size * one.samples), f"<f{size}").astype(float), []
    least, most = raw.numbers("dd")
    found = np.frombuffer(raw.take(size * one.samples), "<u2")
    step = (most - least) / _WHOLE
    values = least + found * step
    beyond = one.samples > 0 and int(found.max()) > _WHOLE
    told = [Statement("largest value", f"channel {one.name}", most, float(values.max()), one.unit)] if beyond else []
    return values, told


def _time(one: _Channel) -> bool:
    return one.unit == "s" and one.name.lower().startswith(("time", "zeit"))


def _step(one: _Channel, values: Array) -> list[Statement]:
    """The interval that the header of a time channel states, beside its values."""
    found = equal_steps(values)
    if not _time(one) or one.dt <= 0 or found is None:
        return []
    return [Statement("time step", f"channel {one.name}", one.dt / 1000, found[1], "s", 1e-3 * found[1])]


def _date(days: float) -> str:
    return str(_DAY_ZERO + timedelta(days=days)) if 0 < days < 2**16 else ""


FORMAT = Format(
    key="catman",
    title="HBM catman binary",
    of="measurement",
    extensions=("bin",),
    defined="catman data format, Hottinger Brüel & Kjær",
    header="channel names, units, number of samples, sampling interval, form of the samples",
    compared="number of samples, range of 2-byte samples, interval of the time channel",
    looks_like=looks_like,
    read=read,
    public=4,
    public_check="APReader 1.1.3",
)
