"""Steel sections, by name."""

from __future__ import annotations

from typing import NamedTuple

from rths_engine.foundation.units import INCH


class Section(NamedTuple):
    """Area (m^2), second moment of area (m^4) and plastic section modulus (m^3) about the strong axis."""

    area: float
    inertia: float
    plastic_modulus: float


def _wide_flange(area: float, inertia: float, plastic_modulus: float) -> Section:
    return Section(area * INCH**2, inertia * INCH**4, plastic_modulus * INCH**3)


# AISC Steel Construction Manual: A (in^2), Ix (in^4), Zx (in^3)
SECTIONS = {
    "W14x120": _wide_flange(35.3, 1380.0, 212.0),
    "W14x132": _wide_flange(38.8, 1530.0, 234.0),
    "W14x159": _wide_flange(46.7, 1900.0, 287.0),
    "W14x193": _wide_flange(56.8, 2400.0, 355.0),
    "W14x257": _wide_flange(75.6, 3400.0, 487.0),
    "W14x311": _wide_flange(91.4, 4330.0, 603.0),
    "W18x40": _wide_flange(11.8, 612.0, 78.4),
    "W18x46": _wide_flange(13.5, 712.0, 90.7),
    "W21x50": _wide_flange(14.7, 984.0, 110.0),
    "W24x55": _wide_flange(16.2, 1350.0, 134.0),
    "W24x68": _wide_flange(20.1, 1830.0, 177.0),
    "W24x84": _wide_flange(24.7, 2370.0, 224.0),
    "W27x94": _wide_flange(27.7, 3270.0, 278.0),
    "W30x99": _wide_flange(29.1, 3990.0, 312.0),
    "W30x116": _wide_flange(34.2, 4930.0, 378.0),
    "W33x118": _wide_flange(34.7, 5900.0, 415.0),
    "W36x135": _wide_flange(39.7, 7800.0, 509.0),
}
