"""Units as strong-motion headers write them: `cm/sec2`, `CMS/SEC/SEC`, `g.`, `counts`."""

from __future__ import annotations

import re

from rths_engine.foundation import unit_names, units

_SAME = {"gal": "cm/s^2"}  # so that two spellings of one unit do not contradict each other


def acceleration_unit(text: str) -> str:
    """The unit of acceleration that `text` names; empty for other units."""
    found = unit_named(text)
    return found if found and units.dimension(found) == "acceleration" else ""


def unit_named(text: str) -> str:
    """The unit that `text` names; empty for a unit that is not known."""
    plain = unit_names.read(re.sub(r"^\s*cms\b", "cm", text.strip(" ,()"), flags=re.IGNORECASE)).plain or ""
    return _SAME.get(plain, plain)
