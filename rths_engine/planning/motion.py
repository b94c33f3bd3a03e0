"""The ground motion of a plan: the record and its scaling."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.foundation.part import Value, quantity
from rths_engine.parts.ground_motions import Motion, MotionLibrary, read
from rths_engine.parts.ground_motions.from_file import check_size
from rths_engine.parts.ground_motions.scaling import Factor, Scale


class RecordMotion(Value):
    """A record of the library by name. If `sha256` is given, it must equal the SHA-256 of the record."""

    kind: Literal["record"] = "record"
    record: str = Field(title="Record", min_length=1, max_length=200)
    sha256: str | None = Field(None, title="SHA-256 of the record", pattern="^[0-9a-f]{64}$")
    scale: Scale = Field(Factor(), title="Scaling")
    title: ClassVar[str] = "Record of the library"

    def unscaled(self, library: MotionLibrary) -> Motion:
        try:
            motion = library.get(self.record)
        except MotionError as error:
            raise MotionError(replace(issue, where="motion.record") for issue in error.issues) from None
        if self.sha256 and motion.sha256 != self.sha256:
            problem = f"record '{self.record}' differs from the planned record: its SHA-256 is {motion.sha256}"
            raise MotionError(Issue("motion.sha256", problem, self.sha256, "choose the record again"))
        return motion


class InlineMotion(Value):
    """Ground acceleration written in the plan itself."""

    kind: Literal["inline"] = "inline"
    dt: float = quantity("Time step of the record", "s", gt=0, le=1)
    acceleration: tuple[float, ...] = quantity("Ground acceleration", "m/s^2", min_length=2, max_length=1_000_000)
    scale: Scale = Field(Factor(), title="Scaling")
    title: ClassVar[str] = "Written in the plan"

    def unscaled(self, library: MotionLibrary) -> Motion:
        samples = np.array(self.acceleration)
        return Motion(
            name="inline", title="Acceleration written in the plan", dt=self.dt, acceleration=samples, provenance="the plan"
        )


class FileMotion(Value):
    """A record file beside the plan (PEER AT2, COSMOS V2 or columns); for the command line."""

    kind: Literal["file"] = "file"
    path: str = Field(title="Record file", min_length=1, max_length=4096)
    unit: str | None = Field(None, title="Unit, or acceleration of one count, if the file does not give it")
    dt: float | None = quantity("Time step, if the file does not give it", "s", gt=0, le=1, default=None)
    scale: Scale = Field(Factor(), title="Scaling")
    title: ClassVar[str] = "Record file"

    def unscaled(self, library: MotionLibrary) -> Motion:
        path = Path(self.path)
        try:
            check_size(path.stat().st_size)
            with path.open("rb"):
                pass
        except OSError as error:
            raise MotionError(
                Issue("motion.path", f"cannot be read: {error.strerror}", self.path, "give the path of a record file")
            ) from None
        return read(path, path.name, unit=self.unit, dt=self.dt)


class NoMotion(Value):
    """The ground does not move."""

    kind: Literal["none"] = "none"
    scale: ClassVar[Scale] = Factor()
    title: ClassVar[str] = "No ground motion"

    def unscaled(self, library: MotionLibrary) -> Motion:
        return Motion(name="none", title="No ground motion", dt=1.0, acceleration=np.zeros(2))


PlannedMotion = Annotated[RecordMotion | InlineMotion | FileMotion | NoMotion, Field(discriminator="kind")]


def scaled(planned: Any, library: MotionLibrary, periods: Array) -> Motion:
    """The planned record times its scale factor. `periods` (s) are those of the structure, T1 first. Raises MotionError."""
    motion: Motion = planned.unscaled(library)
    if isinstance(planned, NoMotion):
        return motion
    return motion.scaled(planned.scale.factor_for(motion, float(periods[0])))
