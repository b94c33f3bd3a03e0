"""Read a file of measurements of any known format; the content decides the format."""

from __future__ import annotations

from rths_engine.foundation.errors import Issue, MeasuredError, MotionError
from rths_engine.parts.ground_motions.text import lines_of
from rths_engine.recordings.measured.readers import apart, binary, ground_motion, json_file, text
from rths_engine.recordings.measured.table import Table, checked

FORMATS = ("CSV, TSV or columns", "JSON", "MATLAB", "Parquet", "HDF5", "PEER AT2", "COSMOS V2")


def read(raw: bytes, filename: str) -> Table:
    """Raises MeasuredError with what is wrong and how to mend it."""
    return checked(_read(raw, filename))


def _read(raw: bytes, filename: str) -> Table:
    if not raw.strip():
        raise MeasuredError(Issue("file", "is empty", fix="choose a file of measurements"))
    if binary.looks_like(raw, filename):
        return apart.read(raw)
    if json_file.looks_like(raw):
        return json_file.read(raw)
    try:
        lines = lines_of(raw)
        return ground_motion.read(lines) if ground_motion.looks_like(lines) else text.read(lines)
    except MotionError as error:
        raise MeasuredError(error.issues) from None
