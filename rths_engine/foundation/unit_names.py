"""Units as files write them: `sec`, `kips`, `g's`, `Newtons`."""

from __future__ import annotations

import re

from rths_engine.foundation import units

# unit -> (SI value of one, SI value at its zero), by definition
WITH_ZERO = {"degC": (1.0, 273.15), "degF": (5 / 9, 255.3722222222222)}
UNITS = (*units.UNITS, *WITH_ZERO)

_SPELLED = {
    "sec": "s", "secs": "s", "second": "s", "seconds": "s", "msec": "ms", "usec": "us", "µs": "us", "minutes": "min",
    "inch": "in", "inches": "in", '"': "in", "feet": "ft", "µm": "um", "μm": "um", "micron": "um", "microns": "um",
    "millimeter": "mm", "millimeters": "mm", "millimetre": "mm", "meter": "m", "meters": "m", "metre": "m",
    "kips": "kip", "klb": "kip", "klbf": "kip", "lbs": "lb", "pound": "lb", "pounds": "lb", "newton": "N", "newtons": "N",
    "kn": "kN", "mn": "MN", "kilonewton": "kN", "volt": "V", "volts": "V", "v": "V", "millivolt": "mV", "mv": "mV",
    "amp": "A", "amps": "A", "ampere": "A", "amperes": "A", "a": "A", "ma": "mA", "gals": "gal", "g's": "g", "gs": "g",
    "c": "degC", "degc": "degC", "deg c": "degC", "°c": "degC", "celsius": "degC", "degf": "degF", "deg f": "degF",
    "°f": "degF",
    "f": "degF", "kelvin": "K", "k": "K", "%": "%", "-": "1", "hz": "Hz", "ips": "in/s",
}  # fmt: skip
_BY_CASE = {name.lower(): name for name in UNITS if name not in {"g", "MN"}}


def written_unit(text: str) -> str:
    """The unit of UNITS that the text names; empty where it names no unit."""
    plain = text.strip().strip("()[]{}").strip()
    known = plain if plain in UNITS else units.named(plain)
    if known in UNITS:
        return known
    lower = re.sub(r"\s+", " ", plain.lower())
    if lower in _SPELLED or lower in _BY_CASE:
        return _SPELLED.get(lower) or _BY_CASE[lower]
    over = re.fullmatch(r"(.+?)\s*(?:/|\bper\b|\s)\s*(?:s|sec|second|s\^?-1|sec\^?-1)(?:\s*(?:/\s*s(?:ec)?|\^?2))?", lower)
    if over:
        squared = bool(re.search(r"2$|/\s*s(?:ec)?\s*/\s*s(?:ec)?$", lower))
        found = f"{_SPELLED.get(over[1].strip(), over[1].strip())}/s{'^2' if squared else ''}"
        return found if found in UNITS else ""
    return ""
