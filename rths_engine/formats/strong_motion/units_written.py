"""Units as strong-motion headers write them: `cm/sec2`, `CMS/SEC/SEC`, `g.`, `counts`."""

from __future__ import annotations

import re

from rths_engine.foundation import unit_names, units
from rths_engine.foundation.errors import FileError, Issue

GAL = "cm/s^2"
_SAME = {"gal": GAL}  # so that two spellings of one unit do not contradict each other


def acceleration_unit(text: str) -> str:
    """The unit of acceleration that `text` names; empty for other units."""
    found = unit_named(text)
    return found if found and units.dimension(found) == "acceleration" else ""


def gal_only(text: str, where: str) -> str:
    """`cm/s^2`, where `text` names it in any spelling. Raises FileError for another unit: the format has only this one."""
    if acceleration_unit(text) != GAL:
        known = acceleration_unit(text)
        problem = "states a unit that is not gal or cm/s^2, the unit of this format"
        raise FileError(Issue(where, problem, known or text, "get the file again, or give the record as columns of text"))
    return GAL


def unit_named(text: str) -> str:
    """The unit that `text` names; empty for a unit that is not known."""
    plain = unit_names.read(re.sub(r"^\s*cms\b", "cm", text.strip(" ,()"), flags=re.IGNORECASE)).plain or ""
    return _SAME.get(plain, plain)
