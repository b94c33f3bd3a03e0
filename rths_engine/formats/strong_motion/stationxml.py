"""FDSN StationXML: the sensitivity of a channel at a time, which turns counts into a physical quantity.

Source: FDSN StationXML 1.2, InstrumentSensitivity: counts per `InputUnits` at one frequency of the flat band.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from defusedxml import ElementTree
from defusedxml.common import DefusedXmlException

from rths_engine.foundation.errors import FileError, Issue

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

# chosen; see docs/decisions/0023
_MOST_FILES = 50
_LARGEST = 50_000_000  # bytes
_ROOT = b"FDSNStationXML"
_OPEN_START, _OPEN_END = datetime.min.replace(tzinfo=UTC), datetime.max.replace(tzinfo=UTC)

# input units -> quantity, unit and its factor, by definition; SEED writes them in capitals
_UNITS = {
    "m/s**2": ("acceleration", "m/s^2", 1.0),
    "m/s": ("velocity", "m/s", 1.0),
    "m": ("displacement", "m", 1.0),
    "cm/s**2": ("acceleration", "cm/s^2", 1.0),
    "mm/s**2": ("acceleration", "mm/s^2", 1.0),
    "nm/s**2": ("acceleration", "m/s^2", 1e-9),
    "nm/s": ("velocity", "m/s", 1e-9),
    "nm": ("displacement", "m", 1e-9),
    "g": ("acceleration", "g", 1.0),
}


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """Counts per `written` unit of a channel (`BK.VALB.40.HN1`) between `start` and `end`. `where`: the file."""

    channel: str
    start: datetime
    end: datetime
    counts: float
    written: str
    frequency: str
    rate: float | None
    where: str

    @property
    def unit(self) -> tuple[str, str, float]:
        """Quantity, unit and the factor of the written unit to it. Raises FileError for a unit that is not known."""
        found = _UNITS.get(self.written.strip().lower().replace("^", "**").replace("sec", "s"))
        if found is None:
            fix = "remove the StationXML file and give the unit of one count, for example '2.34e-6 m/s^2'"
            raise FileError(Issue(self.where, f"states an input unit of {self.channel} that is not known", self.written, fix))
        return found

    @property
    def shown(self) -> str:
        """The sensitivity as a text: `427819 counts/(m/s**2) at 1.0 Hz`."""
        return f"{self.counts:.9g} counts/({self.written}){self.frequency and f' at {self.frequency} Hz'}"


def beside(path: Path | None) -> list[Sensitivity]:
    """The sensitivities in the StationXML files of the folder of `path`. Raises FileError for a damaged StationXML file."""
    if path is None:
        return []
    files = sorted(one for one in path.parent.iterdir() if one.suffix.lower() == ".xml" and one.is_file())
    small = [one for one in files[:_MOST_FILES] if one.stat().st_size <= _LARGEST]
    return [found for file in small if _ROOT in (raw := file.read_bytes())[:2000] for found in sensitivities(raw, file.name)]


def at(known: list[Sensitivity], channel: str, start: datetime, end: datetime) -> Sensitivity | None:
    """The sensitivity of a channel from `start` to `end`; None where no epoch covers both.

    Raises FileError where several epochs state different sensitivities.
    """
    found = [one for one in known if one.channel == channel and one.start <= start and end <= one.end]
    different = {(one.counts, one.written.lower()) for one in found}
    if len(different) > 1:
        problem = f"state different sensitivities of {channel}"
        values = " and ".join(sorted(one.shown for one in found))
        raise FileError(Issue(", ".join(sorted({one.where for one in found})), problem, values, "keep one epoch"))
    return found[0] if found else None


def sensitivities(raw: bytes, name: str) -> list[Sensitivity]:
    """Every sensitivity in a StationXML file. Raises FileError where it is not well-formed."""
    try:
        root = ElementTree.fromstring(raw, forbid_dtd=True)
        return list(_channels(root, name))
    except DefusedXmlException:
        problem = "contains a document type, which StationXML does not have"
        raise FileError(Issue(name, problem, fix="get the file again")) from None
    except (ElementTree.ParseError, ValueError, KeyError) as error:
        raise FileError(Issue(name, "is not a valid StationXML file", str(error), "get the file again or remove it")) from None


def _channels(root: Element, name: str) -> Iterator[Sensitivity]:
    for network in root.iterfind("{*}Network"):
        for station in network.iterfind("{*}Station"):
            for channel in station.iterfind("{*}Channel"):
                stated = channel.find("{*}Response/{*}InstrumentSensitivity")
                if stated is None:
                    continue
                value, unit = _text(stated, "{*}Value"), _text(stated, "{*}InputUnits/{*}Name")
                counts = float(value)
                if not counts:
                    continue
                codes = (
                    network.attrib["code"],
                    station.attrib["code"],
                    channel.get("locationCode", ""),
                    channel.attrib["code"],
                )
                rate = _text(channel, "{*}SampleRate")
                yield Sensitivity(
                    identity(*codes),
                    _time(channel.get("startDate"), _OPEN_START),
                    _time(channel.get("endDate"), _OPEN_END),
                    counts,
                    unit,
                    _text(stated, "{*}Frequency"),
                    float(rate) if rate else None,
                    name,
                )


def identity(network: str, station: str, location: str, channel: str) -> str:
    """The name of a channel, `BK.VALB.40.HN1`; an empty location is also written `--`."""
    location = location.strip()
    return ".".join((network.strip(), station.strip(), "" if location == "--" else location, channel.strip()))


def _text(node: Element, path: str) -> str:
    found = node.find(path)
    return (found.text or "").strip() if found is not None else ""


def _time(text: str | None, otherwise: datetime) -> datetime:
    if not text:
        return otherwise
    stated = datetime.fromisoformat(text)
    return stated if stated.tzinfo else stated.replace(tzinfo=UTC)
