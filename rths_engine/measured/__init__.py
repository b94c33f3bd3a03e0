"""Measured recordings: files of measurements, their mapping to channels in SI, checks, and the form they are kept in."""

from __future__ import annotations

from rths_engine.measured.finding import Finding
from rths_engine.measured.guess import Guess, guess
from rths_engine.measured.importing import Examined, examine, imported
from rths_engine.measured.mapping import Mapping
from rths_engine.measured.readers import FORMATS, read
from rths_engine.measured.store import Measured, MeasuredChannel, load, save
from rths_engine.measured.table import Column, Table

__all__ = [
    "FORMATS",
    "Column",
    "Examined",
    "Finding",
    "Guess",
    "Mapping",
    "Measured",
    "MeasuredChannel",
    "Table",
    "examine",
    "guess",
    "imported",
    "load",
    "read",
    "save",
]
