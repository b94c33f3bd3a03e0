"""A rig that is a Functional Mock-up Unit: FMI 3.0 or 2.0 co-simulation, through FMPy."""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from pathlib import Path
from typing import Any, ClassVar, Literal

from pydantic import Field, model_validator

from rths_engine.parts.connections.connection import Adapter, External, Lost, Reading, RigError, Terms
from rths_engine.parts.connections.fmu_units import contradiction
from rths_engine.parts.connections.optional import package

VARIABLES = ("command", "displacement", "force", "current")  # fields of a connection that name a variable of the FMU
MOST_NAME = 200  # characters of a name; chosen; see docs/decisions/0023


class Fmu(External):
    """An FMU that replaces the actuator, the specimen, or both.

    A communication step is a controller step. The FMU holds its input during a step, so an input given for the time of the
    step's start acts a whole step late. The command of a controller step is that of the step's end, and is set before the step:
    y = u answers in the same step, and a lag of time constant T follows a ramp by dt a / (1 - a) with a = exp(-dt / T), nearly
    T - dt/2. Source: FMI 3.0.2, section 4.2; FMI 2.0.5, section 4.2.
    """

    kind: Literal["fmu"] = "fmu"
    title: ClassVar[str] = "FMU (FMI 3.0 or 2.0 co-simulation)"
    physical: ClassVar[bool] = False
    path: str = Field(
        title="File of the FMU",
        min_length=1,
        max_length=4096,
        description="in the control room the name of a file in the folder `fmus` of its data folder; no other file works",
    )
    command: str = Field("command", title="Input that takes the displacement", min_length=1, max_length=MOST_NAME)
    displacement: str = Field(
        "",
        title="Output with the displacement",
        max_length=MOST_NAME,
        description="empty: a specimen that the actuator of the plan moves",
    )
    force: str = Field(
        "force",
        title="Output with the force",
        max_length=MOST_NAME,
        description="empty: an actuator that the specimen of the plan loads",
    )
    current: str = Field("", title="Input that takes the current", max_length=MOST_NAME, description="in A; empty: no current")

    @model_validator(mode="after")
    def _measures(self) -> Fmu:
        if not self.displacement and not self.force:
            raise ValueError("needs an output with the displacement, the force, or both")
        return self

    @property
    def gives(self) -> Reading:
        return Reading(0.0 if self.displacement else None, 0.0 if self.force else None)

    @property
    def takes_current(self) -> bool:
        return bool(self.current)

    @property
    def peer(self) -> str:
        return f"FMU {Path(self.path).name}"

    def adapter(self, terms: Terms) -> Adapter:
        return FmuRig(self, terms)


class FmuRig(Adapter):
    """One instance of an FMU."""

    def __init__(self, connection: Fmu, terms: Terms):
        self.given, self.terms, self.scale = connection, terms, connection.scale
        self._unit: Any = None
        self._folder: str | None = None
        self._inputs: list[float] = []
        self._steps = 0

    def open(self) -> Reading:
        fmpy = package("fmpy", "fmi", self.terms)
        path = self._path()
        try:
            described = fmpy.read_model_description(str(path))
            self._variables(described)
            self._folder = tempfile.mkdtemp(prefix="rths-fmu-")
            fmpy.extract(str(path), self._folder)
            self._start(described)
            return self._outputs()
        except RigError:
            self.close()
            raise
        except Exception as error:  # FMPy raises many kinds, for files as for the FMU's own errors
            self.close()
            raise self.terms.refused("path", f"cannot be opened: {error}", self.given.path, "check the FMU with FMPy") from None

    def command(self, displacement: float, current: float, time: float) -> None:
        self._inputs = [displacement / self.scale.displacement, *([current] if self.given.current else [])]

    def measure(self) -> Reading:
        start = self._steps * self.terms.dt
        try:
            self._set(self._sent, self._inputs)
            ended = self._unit.doStep(start, self.terms.dt)
            self._steps += 1
            if ended is not None and (ended[1] or ended[2]):
                raise Lost(f"it {'ended its simulation' if ended[1] else 'returned early'} at {ended[3]:.6g} s")
            return self._outputs()
        except Lost:
            raise
        except Exception as error:
            raise Lost(f"its step at {start:.6g} s failed: {error}") from None

    def close(self) -> None:
        if self._unit is not None:
            with contextlib.suppress(Exception):
                self._unit.terminate()
            with contextlib.suppress(Exception):
                self._unit.freeInstance()
            self._unit = None
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None

    def _path(self) -> Path:
        """The file of the FMU. In the service only a file of the folder for FMUs: an FMU is machine code."""
        path, folder = Path(self.given.path), self.terms.folder
        if folder is not None:
            if path.name != self.given.path:
                raise self.terms.refused(
                    "path", "is not the name of a file", self.given.path, f"put the FMU into {folder.name}/"
                )
            path = folder / path
        try:
            found = path.is_file()
        except OSError as error:  # such as a name that is too long; the error itself tells the folder
            problem = f"cannot be opened: {error.strerror}"
            raise self.terms.refused("path", problem, self.given.path, "give the path of an .fmu file") from None
        if not found:
            raise self.terms.refused("path", "does not exist", self.given.path, "give the path of an .fmu file")
        return path

    def _variables(self, described: Any) -> None:
        """Find the variables and compare their units with the plan. Raises RigError."""
        given, terms = self.given, self.terms
        if described.coSimulation is None:
            raise terms.refused("path", "has no co-simulation interface", given.path, "export the model for co-simulation")
        self._version = int(str(described.fmiVersion).partition(".")[0])
        if self._version not in (2, 3):
            raise terms.refused("path", f"is an FMU of FMI {described.fmiVersion}; FMI 3.0 and 2.0 are read", given.path)
        known = {one.name: one for one in described.modelVariables}
        found: dict[str, int] = {}
        for field in VARIABLES:
            name = getattr(given, field)
            if not name:
                continue
            causality = "output" if field in ("displacement", "force") else "input"
            one = known.get(name)
            if one is None or one.causality != causality or one.type not in ("Real", "Float64"):
                offered = ", ".join(other.name for other in known.values() if other.causality == causality) or "none"
                problem = f"is not an {causality} of the FMU that is a number"
                raise terms.refused(field, problem, name, f"its {causality}s are: {offered}")
            unit = {"force": given.force_unit, "current": "A"}.get(field, given.displacement_unit)
            if (differs := contradiction(one, described, unit)) is not None:
                fix = "change the unit in the plan" if field != "current" else "give a variable in A"
                raise terms.refused(field, differs, name, fix)
            found[field] = one.valueReference
        self._sent = [found[field] for field in ("command", "current") if field in found]
        self._read = [found[field] for field in ("displacement", "force") if field in found]

    def _start(self, described: Any) -> None:
        module = package(f"fmpy.fmi{self._version}", "fmi", self.terms)
        kind = module.FMU3Slave if self._version == 3 else module.FMU2Slave
        unit = kind(
            guid=described.guid,
            unzipDirectory=self._folder,
            modelIdentifier=described.coSimulation.modelIdentifier,
            instanceName=self.terms.where,
        )
        unit.instantiate()
        self._unit = unit
        if self._version == 2:
            unit.setupExperiment(startTime=0.0)
            unit.enterInitializationMode()
        else:
            unit.enterInitializationMode(startTime=0.0)
        self._set(self._sent, [0.0] * len(self._sent))
        unit.exitInitializationMode()

    def _set(self, references: list[int], values: list[float]) -> None:
        (self._unit.setFloat64 if self._version == 3 else self._unit.setReal)(references, values)

    def _outputs(self) -> Reading:
        values = iter((self._unit.getFloat64 if self._version == 3 else self._unit.getReal)(self._read))
        given = self.given
        return Reading(
            next(values) * self.scale.displacement if given.displacement else None,
            next(values) * self.scale.force if given.force else None,
        )
