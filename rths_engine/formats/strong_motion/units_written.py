"""Units as strong-motion headers write them: `cm/sec2`, `CM/SEC/SEC`, `g.`, `counts`."""

from __future__ import annotations

_SECONDS = (("cms", "cm"), ("sec", "s"), ("s/s", "s^2"), ("s**2", "s^2"), ("s2", "s^2"))
_NAMES = {"gal": "cm/s^2", "g": "g", "mg": "mg", "g/10": "g/10", "count": "counts", "counts": "counts"}


def unit_named(text: str) -> str:
    """The unit that `text` names, in one spelling; empty for a unit that is not known."""
    plain = text.strip().strip(".,()").lower().replace(" ", "")
    for written, spelling in _SECONDS:
        plain = plain.replace(written, spelling)
    if plain in ("cm/s^2", "cm/s", "cm", "m/s^2", "m/s", "m", "mm/s^2", "mm/s", "mm", "in/s^2", "in/s", "in"):
        return plain
    return _NAMES.get(plain, "")
