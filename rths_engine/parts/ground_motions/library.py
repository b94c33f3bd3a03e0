"""The library of records that a plan can name: the bundled records and those stored in a folder."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.parts.ground_motions import bundled, stored
from rths_engine.parts.ground_motions.record import Motion, slug

_NAME = re.compile(r"[a-z0-9](?:[a-z0-9-]{0,78}[a-z0-9])?")


@dataclass(frozen=True, slots=True)
class Summary:
    """A record's row in a list, in SI. `problem` says why a damaged record cannot be used; its numbers are zero then."""

    name: str
    title: str
    event: str = ""
    station: str = ""
    component: str = ""
    provenance: str = ""
    dt: float = 0.0
    samples: int = 0
    duration: float = 0.0
    pga: float = 0.0
    sha256: str = ""
    bundled: bool = False
    problem: str | None = None

    def as_dict(self) -> dict[str, Any]:
        return asdict(self)


class MotionLibrary:
    """The bundled records, which are read-only, and the records in `folder` (None: bundled records only)."""

    def __init__(self, folder: Path | None):
        self.folder = folder

    def names(self) -> list[str]:
        """All names, sorted."""
        return sorted({*bundled.names(), *(path.stem for path in self._files())})

    def summaries(self) -> list[Summary]:
        """The summary of each record, sorted by name. A damaged record is listed with its problem."""
        return [self.summary(name) for name in self.names()]

    def summary(self, name: str) -> Summary:
        """The summary of the record `name`. Raises MotionError with similar names where there is no such record."""
        if name in bundled.names():
            return _summary(bundled.bundled(name))
        path = self._path(name)
        try:
            about = stored.describe(path)
            return Summary(name=name, **{key: value for key, value in about.items() if key != "schema"})
        except MotionError as error:
            return Summary(name=name, title=name, problem=error.issues[0].problem)

    def get(self, name: str) -> Motion:
        """The record `name`. Raises MotionError where it is damaged, or, with similar names, where there is no such record."""
        return bundled.bundled(name) if name in bundled.names() else stored.load(self._path(name))

    def add(self, motion: Motion) -> None:
        """Store `motion` under its name. Raises MotionError when the name is in use or is not a valid record name."""
        if self.folder is None:
            raise MotionError(Issue("name", "this library has no folder to store records in", motion.name))
        if not _NAME.fullmatch(motion.name):
            problem = "needs 1 to 80 lower-case letters, digits or hyphens"
            raise MotionError(Issue("name", problem, motion.name, f"name it '{slug(motion.name)}'"))
        try:
            if motion.name in bundled.names():
                raise FileExistsError
            stored.save(self.folder, motion)
        except FileExistsError:
            raise MotionError(
                Issue("name", "a record with this name already exists", motion.name, "choose another name")
            ) from None

    def remove(self, name: str) -> None:
        """Delete a stored record. Raises MotionError for a bundled or an unknown record."""
        if name in bundled.names():
            raise MotionError(Issue("record", "comes with the program and cannot be removed", name))
        try:
            self._path(name).unlink()
        except FileNotFoundError:
            raise self._unknown(name) from None

    def _files(self) -> Iterator[Path]:
        if self.folder is not None and self.folder.is_dir():
            yield from (path for path in self.folder.glob(f"*{stored.SUFFIX}") if _NAME.fullmatch(path.stem))

    def _path(self, name: str) -> Path:
        for path in self._files():
            if path.stem == name:
                return path
        raise self._unknown(name)

    def _unknown(self, name: str) -> MotionError:
        near = difflib.get_close_matches(slug(name), self.names(), n=3, cutoff=0.4)
        fix = f"did you mean {' or '.join(near)}?" if near else "choose one of the library's records"
        return MotionError(Issue("record", "no record has this name", name, fix))


def _summary(motion: Motion) -> Summary:
    return Summary(
        name=motion.name,
        title=motion.title,
        event=motion.event,
        station=motion.station,
        component=motion.component,
        provenance=motion.provenance,
        dt=motion.dt,
        samples=len(motion.acceleration),
        duration=motion.duration,
        pga=motion.pga,
        sha256=motion.sha256,
        bundled=True,
    )
