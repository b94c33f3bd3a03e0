"""NI TDMS: the channels of every group, each with its own start and step, scaled as National Instruments defines it."""

from __future__ import annotations

import io
import struct
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from rths_engine.formats import damage, optional
from rths_engine.formats.attributes import Attributes
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.statement import SAME_STEP, Statement, count
from rths_engine.formats.table import Column, Table, distinct, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# scales that npTDMS applies; another scale would leave the numbers unscaled
_SCALES = {"Linear", "Polynomial", "Strain", "Table", "RTD", "Thermistor", "Thermocouple", "Add", "Subtract", "AdvancedAPI"}
_LEAD, _OPEN = 28, 2**64 - 1  # by definition: bytes of a lead-in, and the length of a segment that was not closed
_BIG_ENDIAN = 1 << 6  # by definition: a bit of the table of contents
_SIGN = "NI's sign: a bridge that reads a positive voltage gives a negative strain"


def looks_like(source: Source) -> bool:
    """Whether the content is a TDMS file or its index."""
    return source.head[:4] in (b"TDSm", b"TDSh")


def read(source: Source) -> Table:
    """Read the file. Raises FileError for errors of any kind, which a damaged file can cause."""
    if source.head.startswith(b"TDSh"):
        raise FileError(Issue("file", "is the index of a TDMS file, which contains no samples", fix="give the .tdms file"))
    nptdms = optional.package("nptdms", "a TDMS file")
    raw = source.bytes()
    size = _stated_size(raw)
    with damage.refused("TDMS"), nptdms.TdmsFile.open(io.BytesIO(raw)) as file:
        refuse_many(sum(len(channel) for group in file.groups() for channel in group.channels()))
        found = _table(file)
    return replace(found, statements=(*size, *found.statements))


def _stated_size(raw: bytes) -> tuple[Statement, ...]:
    """The size of the file by the lengths of its segments, beside its real size. The last segment can be without a length."""
    at = 0
    while at + _LEAD <= len(raw) and raw[at : at + 4] == b"TDSm":
        big = raw[at + 4] & _BIG_ENDIAN
        (length,) = struct.unpack_from(">Q" if big else "<Q", raw, at + 12)
        if length == _OPEN:
            return ()
        at += _LEAD + length
    return (Statement("size of its segments", "lead-in", at if at >= len(raw) else at + _LEAD, len(raw), "bytes"),)


def _table(file: Any) -> Table:
    columns: list[Column] = []
    notes: list[str] = []
    statements = list(_statements(file))
    groups = file.groups()
    channels = [(group.name, channel) for group in groups for channel in group.channels()]
    begins = [begun for _, channel in channels if (begun := _begun(channel.properties)) is not None]
    for group, channel in channels:
        name = f"{group.strip()}/{channel.name.strip()}" if len(groups) > 1 else channel.name.strip()
        scales = _scales({**file.properties, **file[group].properties, **channel.properties})
        unknown = [kind for _, kind, _ in scales if kind not in _SCALES]
        if len(channel) == 0:
            notes.append(f"channel {name} contains no samples")
        elif unknown:
            notes.append(f"channel {name} is left out: its scale {', '.join(unknown)} is not known")
        elif (values := _values(channel)) is None:
            notes.append(f"channel {name} contains no numbers")
        else:
            column = _column(name, values, channel.properties, scales, min(begins, default=None), notes)
            column, compared = _with_properties(
                column, channel.properties, {**file.properties, **file[group].properties}, notes
            )
            columns.append(column)
            statements += compared
    about = {key: str(value) for key, value in file.properties.items() if isinstance(value, str) and value}
    header = "\n".join(f"{name}: {dict(channel.properties)}" for name, channel in channels)
    return Table("TDMS", distinct(columns), notes=tuple(notes), statements=tuple(statements), header=header, about=about)


def _column(
    name: str, values: Array, about: Mapping[str, Any], scales: list[tuple[int, str, str]], first: Any, notes: list[str]
) -> Column:
    unit = str(about.get("unit_string") or about.get("NI_UnitDescription") or "")
    dt, start = about.get("wf_increment"), float(about.get("wf_start_offset") or 0.0)
    of_time = str(about.get("wf_xunit_string") or "s").strip() == "s" and str(about.get("wf_xname") or "Time") == "Time"
    known = any(key in about for key in ("wf_start_time", "wf_start_offset", "wf_xunit_string"))
    if dt is not None and dt > 0 and not (of_time and known):
        stated = f"{about.get('wf_xname', '')} {about.get('wf_xunit_string', '')}".strip() or "no unit"
        notes.append(f"channel {name} states an increment of {dt:g} with {stated}: it is not taken as the time step")
        dt = None
    begun = _begun(about)
    if begun is not None and first is not None:
        start += float((begun - first) / np.timedelta64(1, "ns")) * 1e-9
    applied = "; ".join(text for _, _, text in scales)
    return Column(name, values, unit, float(dt) if dt is not None and dt > 0 else None, start, applied=applied)


def _with_properties(
    column: Column, own: Mapping[str, Any], around: Mapping[str, Any], notes: list[str]
) -> tuple[Column, list[Statement]]:
    """The column with the step that properties state (`SampleRate`) where no waveform does, and what else they state."""
    name, samples = column.name, len(column.values)
    of_channel, of_others = Attributes.of(own), Attributes.of(around)
    statements = of_channel.statements(name, [samples], column.dt)
    notes += [f"channel {name}: {doubt}" for doubt in (*of_channel.doubts, *of_others.doubts)]
    if of_channel.scaling:
        notes.append(f"channel {name}: {', '.join(of_channel.scaling)} not applied: TDMS states its scales as NI_Scale")
    step = of_channel.step
    if column.dt is not None and step is not None:
        where = of_channel.step_name
        statements.append(Statement(f"time step of {name}", where, step, column.dt, "s", SAME_STEP * column.dt))
    elif column.dt is not None and (wider := of_others.step) is not None and abs(wider / column.dt - 1) > SAME_STEP:
        notes.append(
            f"channel {name}: its waveform has a step of {column.dt:.7g} s; {of_others.step_name} states {wider:.7g} s"
        )
    return replace(column, dt=column.dt or step or of_others.step), statements


def _values(channel: Any) -> Array | None:
    found = channel[:]
    if found.dtype.kind == "M":  # time stamps: seconds from the first
        return np.asarray((found - found[0]) / np.timedelta64(1, "ns") * 1e-9, dtype=float)
    return np.asarray(found, dtype=float) if found.dtype.kind in "fiub" else None


def _begun(about: Mapping[str, Any]) -> Any:
    found = about.get("wf_start_time")
    return found.astype("datetime64[ns]") if isinstance(found, np.datetime64) and not np.isnat(found) else None


def _scales(about: Mapping[str, Any]) -> list[tuple[int, str, str]]:
    """Number, kind and description of each scale that the channel is read with."""
    if str(about.get("NI_Scaling_Status", "unscaled")) == "scaled":
        return []
    found = []
    for number in range(64):
        kind = about.get(f"NI_Scale[{number}]_Scale_Type")
        if kind is None:
            continue
        opening = f"NI_Scale[{number}]_{kind}_"
        facts = [f"{key[len(opening) :]} {value:g}" for key, value in about.items() if _fact(key, value, opening)]
        words = [f"scale {kind}", *facts, *([_SIGN] if kind == "Strain" else [])]
        found.append((number, str(kind), ", ".join(words).replace("_", " ")))
    return found


def _fact(key: str, value: Any, opening: str) -> bool:
    return key.startswith(opening) and isinstance(value, int | float | np.number) and not key.endswith("Input_Source")


def _statements(file: Any) -> tuple[Statement, ...]:
    """The number of samples of the last segment of an incomplete file, beside the number in it."""
    parts = file.file_status.channel_statuses or {}
    return tuple(
        count(one.expected_length, one.read_length, "last segment", path)
        for path, one in parts.items()
        if one.expected_length != one.read_length
    )


FORMAT = Format(
    key="tdms",
    title="NI TDMS",
    of="measurement",
    extensions=("tdms",),
    defined="TDMS File Format Internal Structure, National Instruments",
    header="channel names, units, scales, start and step of each channel; a rate in properties",
    compared="number of samples of the last segment; number of samples and time step of properties",
    looks_like=looks_like,
    read=read,
    public=25,
    public_check="a decoder of raw samples written for this check; these files contain no scale",
    library="npTDMS (extra `formats`)",
    apart=True,
)
