"""The library of ground motions of the laboratory."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from app import contents
from app.motions.schemas import MotionChannel, MotionFile
from app.problems import NotFound
from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.parts import ground_motions
from rths_engine.parts.ground_motions import Channel, Motion, MotionLibrary, read, response_spectrum, slug

PERIODS = np.geomspace(0.02, 6.0, 120)  # s
DAMPING = 0.05
PREVIEW_POINTS = 6000


class MotionService:
    """Rules of the library of ground motions: list, preview, add, remove."""

    def __init__(self, library: MotionLibrary):
        self.library = library

    def listed(self) -> list[dict[str, Any]]:
        return [summary.as_dict() for summary in self.library.summaries()]

    def summary(self, name: str) -> dict[str, Any]:
        self._known(name)
        return self.library.summary(name).as_dict()

    def preview(self, name: str) -> dict[str, Any]:
        self._known(name)
        return preview(self.library.get(name))

    def read(self, raw: bytes, filename: str, unit: str, dt: str, channel: str, name: str) -> Motion:
        """Read a record from an uploaded file. Raises MotionError.

        Without a name it is named after the file, and after its channel where one was chosen.
        """
        chosen = channel.strip()
        motion = read(raw, filename or "record", unit=unit or None, dt=_step(dt), channel=chosen or None)
        which = (motion.component or f"channel {chosen}") if chosen else ""
        own = slug(name or f"{filename.rsplit('.', 1)[0]} {which}")
        return replace(motion, name=own, title=name or motion.title)

    def contents(self, raw: bytes, filename: str) -> MotionFile:
        """What stands in a file. Raises MotionError where it cannot be read or has no acceleration."""
        found = ground_motions.contents(raw, filename or "record")
        return MotionFile(
            filename=filename,
            **contents.of(found.table),
            columns=[one.name for one in found.table.columns],
            notes=list(found.table.notes),
            channels=[_channel(one) for one in found.channels],
        )

    def add(self, motion: Motion) -> dict[str, Any]:
        self.library.add(motion)
        return self.summary(motion.name)

    def remove(self, name: str) -> None:
        self._known(name)
        self.library.remove(name)

    def _known(self, name: str) -> None:
        if name not in self.library.names():
            raise NotFound(f"There is no ground motion '{name}'.")


def _channel(one: Channel) -> MotionChannel:
    column = one.column
    known = np.abs(column.values[np.isfinite(column.values)])
    return MotionChannel(
        number=one.number,
        name=one.name,
        unit=column.unit,
        dt_s=column.dt,
        samples=len(column.values),
        largest=float(np.max(known, initial=0.0)),
        applied=column.applied,
        asks=list(one.asks),
    )


def preview(motion: Motion) -> dict[str, Any]:
    """Samples and response spectrum of a record, SI; a long record is decimated to the extremes of equal parts."""
    acceleration = np.asarray(motion.acceleration)
    time = np.arange(len(acceleration)) * motion.dt
    kept = _peaks(acceleration)
    sa = response_spectrum(acceleration, motion.dt, PERIODS, DAMPING)
    return {
        "name": motion.name,
        "title": motion.title,
        "dt": motion.dt,
        "duration": motion.duration,
        "samples": len(acceleration),
        "pga": motion.pga,
        "provenance": motion.provenance,
        "time": time[kept].tolist(),
        "acceleration": acceleration[kept].tolist(),
        "spectrum": {"periods": PERIODS.tolist(), "sa": sa.tolist(), "damping": DAMPING},
    }


def _peaks(samples: Any) -> Any:
    """Indices of the smallest and largest sample of equal parts, in order; all indices for a short record."""
    size = -(-len(samples) // (PREVIEW_POINTS // 2))
    if size <= 2:
        return np.arange(len(samples))
    padded = np.pad(samples, (0, -len(samples) % size), mode="edge").reshape(-1, size)
    base = np.arange(len(padded)) * size
    chosen = np.concatenate([base + padded.argmin(axis=1), base + padded.argmax(axis=1)])
    return np.unique(np.minimum(chosen, len(samples) - 1))


def _step(text: str) -> float | None:
    if not text.strip():
        return None
    try:
        return float(text)
    except ValueError:
        raise MotionError(Issue("dt", "needs a number: the time step in s", text, "for example 0.01")) from None
