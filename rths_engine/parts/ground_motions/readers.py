"""Read a record file of any known format; the content decides the format."""

from __future__ import annotations

from pathlib import PurePath

from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.parts.ground_motions import at2, columns, cosmos
from rths_engine.parts.ground_motions.checks import checked
from rths_engine.parts.ground_motions.parsed import Parsed
from rths_engine.parts.ground_motions.record import Motion, slug
from rths_engine.parts.ground_motions.text import lines_of

# chosen; see docs/decisions/0023
FORMATS = {"at2": "PEER AT2", "cosmos": "COSMOS or CSMIP V2", "columns": "plain columns"}
_LARGEST_FILE = 100_000_000  # bytes: ten channels of a million samples


def read(
    raw: bytes,
    filename: str,
    unit: str | None = None,
    dt: float | None = None,
    format: str | None = None,
    channel: int = 1,
) -> Motion:
    """The motion in a file, named after the file. `unit` and `dt` (s) are used where the file does not state them.

    `format` is a key of FORMATS. Raises MotionError with every issue: what, where, value, bound and how to mend it.
    """
    parsed = _parsed(raw, filename, format, channel)
    acceleration, step = checked(parsed, unit, dt)
    file = _file(filename)
    which = f", channel {parsed.channel} of {len(parsed.channels)}" if len(parsed.channels) > 1 else ""
    return Motion(
        name=slug(PurePath(file).stem),
        title=parsed.title or PurePath(file).stem or "Motion",
        dt=step,
        acceleration=acceleration,
        provenance=f"read from {file} ({FORMATS[parsed.format]}{which})",
        event=parsed.event,
        component=parsed.component,
        station=parsed.station,
    )


def channels(raw: bytes, filename: str, format: str | None = None) -> tuple[str, ...]:
    """Names of the acceleration channels in a file, in the order of the numbers of `channel`, from 1."""
    return _parsed(raw, filename, format, 1).channels or ("acceleration",)


def check_size(size: int) -> None:
    """Raises MotionError for a file that is larger than the limit."""
    if size > _LARGEST_FILE:
        raise MotionError(Issue("file", f"is larger than {_LARGEST_FILE:,} bytes", size, "cut or resample the record"))


def _parsed(raw: bytes, filename: str, format: str | None, channel: int) -> Parsed:
    if format is not None and format not in FORMATS:
        raise MotionError(Issue("format", "is not a known format", format, "choose one of " + ", ".join(FORMATS)))
    check_size(len(raw))
    lines = lines_of(raw)
    found = format or _detected(lines, filename)
    if found == "cosmos":
        return cosmos.parse(lines, channel)
    if found == "columns":
        return columns.parse(lines, channel)
    if channel != 1:
        raise MotionError(Issue("channel", "an AT2 file has one channel", channel, "choose channel 1"))
    return at2.parse(lines)


def _detected(lines: list[str], filename: str) -> str:
    """The format according to the content. For text of no known format: the format of its file name."""
    if cosmos.looks_like(lines):
        return "cosmos"
    if at2.looks_like(lines):
        return "at2"
    promised = filename.lower().endswith(".at2") and not columns.looks_like(lines)
    return "at2" if promised else "columns"


def _file(filename: str) -> str:
    return filename.replace("\\", "/").rsplit("/", 1)[-1]
