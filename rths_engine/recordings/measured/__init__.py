"""Measured recordings: files of measurements, their mapping to channels in SI, checks, and the stored format."""

from __future__ import annotations

from rths_engine.formats.scratch import release
from rths_engine.formats.table import Column, Table
from rths_engine.recordings.measured.blocks import extent
from rths_engine.recordings.measured.finding import Finding
from rths_engine.recordings.measured.guess import Guess, guess
from rths_engine.recordings.measured.importing import Examined, Signal, check, examine, imported
from rths_engine.recordings.measured.layout import fingerprint
from rths_engine.recordings.measured.mapping import Mapping
from rths_engine.recordings.measured.reading import read
from rths_engine.recordings.measured.recording import Measured, MeasuredChannel
from rths_engine.recordings.measured.store import save

__all__ = [
    "Column",
    "Examined",
    "Finding",
    "Guess",
    "Mapping",
    "Measured",
    "MeasuredChannel",
    "Signal",
    "Table",
    "check",
    "examine",
    "extent",
    "fingerprint",
    "guess",
    "imported",
    "read",
    "release",
    "save",
]
