"""The records that come with the program: AT2 files and an index of their origin. Each file is read once."""

from __future__ import annotations

import gzip
import json
from functools import cache
from importlib.resources import files

from rths_engine.parts.ground_motions.from_file import read
from rths_engine.parts.ground_motions.record import Motion

_DATA = files("rths_engine.parts.ground_motions") / "data"


@cache
def names() -> tuple[str, ...]:
    """Names of the bundled records, sorted."""
    return tuple(sorted(_index()))


@cache
def bundled(name: str) -> Motion:
    """The bundled record `name`. Raises KeyError where there is none of this name."""
    entry = _index()[name]
    parsed = read(gzip.decompress((_DATA / f"{name}.at2.gz").read_bytes()), f"{name}.at2", format="at2")
    return Motion(
        name=name,
        title=entry["title"],
        dt=parsed.dt,
        acceleration=parsed.acceleration,
        provenance=entry["provenance"],
        event=entry["event"],
        component=entry["component"],
        station=entry["station"],
    )


@cache
def _index() -> dict[str, dict[str, str]]:
    index: dict[str, dict[str, str]] = json.loads((_DATA / "records.json").read_text(encoding="utf-8"))
    return index
