"""miniSEED 2.4 records and StationXML, byte by byte: 32-bit integers, 64-bit floats, or Steim-1 of 32-bit differences."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from itertools import pairwise

_RECORD, _DATA = 512, 64
START = datetime(2019, 11, 3, 20, 34, 52, tzinfo=UTC)
INTEGERS, DOUBLES, STEIM1 = 3, 5, 10


@dataclass(frozen=True)
class Channel:
    """A channel by its code (`BK.VALB.40.HN1`), its samples from `start`, in one of the encodings."""

    code: str
    values: Sequence[float]
    rate: int = 200
    start: datetime = START
    encoding: int = INTEGERS


def written(*channels: Channel) -> bytes:
    return b"".join(record for one in channels for record in records(one))


def records(one: Channel) -> list[bytes]:
    room = {INTEGERS: (_RECORD - _DATA) // 4, DOUBLES: (_RECORD - _DATA) // 8, STEIM1: 15 * 7 - 2}[one.encoding]
    found = []
    for number, at in enumerate(range(0, len(one.values), room), start=1):
        part = one.values[at : at + room]
        data = {INTEGERS: _integers, DOUBLES: _doubles, STEIM1: _steim}[one.encoding](part)
        found.append(_header(one, number, len(part), at) + data.ljust(_RECORD - _DATA, b"\0"))
    return found


def _header(one: Channel, number: int, samples: int, at: int) -> bytes:
    network, station, location, channel = one.code.split(".")
    began = one.start + timedelta(seconds=at / one.rate)
    time = struct.pack(
        ">HHBBBBH", began.year, began.timetuple().tm_yday, began.hour, began.minute, began.second, 0, began.microsecond // 100
    )
    names = f"{number:06d}D {station:<5s}{location:<2s}{channel:<3s}{network:<2s}".encode()
    fixed = names + time + struct.pack(">HhhBBBBiHH", samples, one.rate, 1, 0, 0, 0, 1, 0, _DATA, 48)
    return (fixed + struct.pack(">HHBBBB", 1000, 0, one.encoding, 1, 9, 0)).ljust(_DATA, b"\0")


def _integers(values: Sequence[float]) -> bytes:
    return struct.pack(f">{len(values)}i", *(int(one) for one in values))


def _doubles(values: Sequence[float]) -> bytes:
    return struct.pack(f">{len(values)}d", *values)


def _steim(values: Sequence[float]) -> bytes:
    """Frames of 16 words: a word of 2-bit codes (3: a 32-bit difference), then differences; the first has first and last."""
    whole = [int(one) for one in values]
    differences = [whole[0], *(second - first for first, second in pairwise(whole))]
    frames: list[bytes] = []
    at = 0
    while at < len(differences):
        words: list[tuple[int, int]] = [(0, whole[0]), (0, whole[-1])] if not frames else []
        words += [(3, one) for one in differences[at : at + 15 - len(words)]]
        at += sum(1 for code, _ in words if code)
        words += [(0, 0)] * (15 - len(words))
        codes = 0
        for code, _ in [(0, 0), *words]:
            codes = codes << 2 | code
        frames.append(struct.pack(">I15i", codes, *(value for _, value in words)))
    return b"".join(frames)


def station_xml(*channels: tuple[str, str, str, float, str, float]) -> bytes:
    """StationXML of channels: code, first and last day of the epoch, sensitivity, its unit, sampling rate."""
    parts = []
    for code, start, end, counts, unit, rate in channels:
        network, station, location, channel = code.split(".")
        parts.append(
            f'<Network code="{network}"><Station code="{station}"><Channel code="{channel}" locationCode="{location}" '
            f'startDate="{start}T00:00:00" endDate="{end}T00:00:00"><SampleRate>{rate}</SampleRate><Response>'
            f"<InstrumentSensitivity><Value>{counts}</Value><Frequency>10.0</Frequency><InputUnits><Name>{unit}</Name>"
            f"</InputUnits><OutputUnits><Name>COUNTS</Name></OutputUnits></InstrumentSensitivity></Response></Channel>"
            f"</Station></Network>"
        )
    root = '<FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1" schemaVersion="1.0">'
    return f'<?xml version="1.0" encoding="UTF-8"?>{root}{"".join(parts)}</FDSNStationXML>'.encode()
