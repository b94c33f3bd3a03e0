"""One ground-motion record: acceleration at equal steps, with its origin."""

from __future__ import annotations

import hashlib
import re
import struct
import unicodedata
from dataclasses import dataclass, replace

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, MotionError


@dataclass(frozen=True, eq=False)
class Motion:
    """Ground acceleration (m/s^2, read-only) every `dt` (s). Sample i is at i * dt; linear between samples."""

    name: str
    title: str
    dt: float
    acceleration: Array
    provenance: str = ""
    event: str = ""
    component: str = ""
    station: str = ""

    def __post_init__(self) -> None:
        samples = np.array(self.acceleration, dtype=float)
        if samples.ndim != 1 or len(samples) < 2:
            raise MotionError(Issue("acceleration", "needs a list of at least 2 samples"))
        bad = np.flatnonzero(~np.isfinite(samples))
        if len(bad):
            where = f"acceleration.{bad[0]}"
            raise MotionError(Issue(where, "needs a finite number, not NaN or infinity", str(samples[bad[0]])))
        if not (np.isfinite(self.dt) and self.dt > 0):
            raise MotionError(Issue("dt", "needs a step > 0 s", self.dt))
        samples.setflags(write=False)
        object.__setattr__(self, "acceleration", samples)

    @property
    def sha256(self) -> str:
        """Hex SHA-256 over step and samples, little-endian float64."""
        return hashlib.sha256(struct.pack("<d", self.dt) + self.acceleration.astype("<f8").tobytes()).hexdigest()

    @property
    def pga(self) -> float:
        """Peak ground acceleration (m/s^2)."""
        return float(np.max(np.abs(self.acceleration)))

    @property
    def duration(self) -> float:
        """Time (s) of the last sample."""
        return (len(self.acceleration) - 1) * self.dt

    def resampled(self, dt: float, duration: float | None = None) -> Motion:
        """The same motion every `dt` (s) up to `duration` (s): linear between samples, zero after the end of the record."""
        count = int(np.floor((self.duration if duration is None else duration) / dt + 1e-9)) + 1
        own = np.arange(len(self.acceleration)) * self.dt
        times = np.arange(count) * dt
        inside = times <= self.duration * (1 + 1e-12)
        samples = np.where(inside, np.interp(times, own, self.acceleration), 0.0)
        return replace(self, dt=dt, acceleration=samples)

    def scaled(self, factor: float) -> Motion:
        return replace(self, acceleration=self.acceleration * factor)


def slug(text: str) -> str:
    """A record name made from `text`: at most 80 lower-case letters, digits and hyphens."""
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode().lower()
    return re.sub(r"[^a-z0-9]+", "-", plain).strip("-")[:80].strip("-") or "motion"
