"""Ground motions: records, readers, the library, response spectra and scaling."""

from __future__ import annotations

from rths_engine.parts.ground_motions.from_file import Channel, channels, contents, read
from rths_engine.parts.ground_motions.library import MotionLibrary, Summary
from rths_engine.parts.ground_motions.record import Motion, slug
from rths_engine.parts.ground_motions.spectrum import response_spectrum, spectral_acceleration

__all__ = [
    "Channel",
    "Motion",
    "MotionLibrary",
    "Summary",
    "channels",
    "contents",
    "read",
    "response_spectrum",
    "slug",
    "spectral_acceleration",
]
