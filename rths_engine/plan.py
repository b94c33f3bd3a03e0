"""A test plan: one immutable value from which a run is reproducible to the bit."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import ConfigDict, Field

from rths_engine import plan_yaml
from rths_engine.actuators import Actuator
from rths_engine.actuators.first_order_delay import FirstOrderDelay
from rths_engine.arrays import Array
from rths_engine.compensators import Compensator
from rths_engine.compensators.aic import AdaptiveInverseCompensation
from rths_engine.errors import Issue, PlanError
from rths_engine.factor import Factor, factorised
from rths_engine.integrators import Integrator
from rths_engine.integrators.cr import CrIntegrator
from rths_engine.motion import PlannedMotion
from rths_engine.part import Value, quantity, validated
from rths_engine.safety import Limits
from rths_engine.specimens import Specimen
from rths_engine.specimens.mr_damper import MrDamper
from rths_engine.structures import Structure
from rths_engine.structures.modes import circular_frequencies


class Noise(Value):
    """Standard deviation of white Gaussian sensor noise added every substep to what the loop measures."""

    displacement: float = quantity("Displacement noise (standard deviation)", "m", "mm", ge=0, le=0.1, default=0.0)
    force: float = quantity("Force noise (standard deviation)", "N", "kN", ge=0, le=1e7, default=0.0)


class Station(Value):
    """One experimental substructure: actuator, specimen and sensors; it stands for `dampers` equal ones in its storey."""

    name: str = Field("Station", title="Name", min_length=1, max_length=80)
    storey: int = quantity("Storey", ge=1, le=100, default=1, help="counted from 1 at the ground")
    dampers: int = quantity("Dampers in the storey", ge=1, le=1000, default=1)
    equivalent_stiffness: float = quantity("Equivalent stiffness of one damper", "N/m", "kN/m", ge=0, le=1e12, default=0.0)
    equivalent_damping: float = quantity("Equivalent damping of one damper", "N*s/m", "kN*s/m", ge=0, le=1e12, default=0.0)
    compensator: Compensator = Field(AdaptiveInverseCompensation(), title="Delay compensator")
    actuator: Actuator = Field(FirstOrderDelay(), title="Actuator")
    specimen: Specimen = Field(MrDamper(), title="Specimen")
    noise: Noise = Field(Noise(), title="Sensor noise")
    limits: Limits = Field(Limits(), title="Safety limits")


class Fastest(Value):
    """As fast as the machine can."""

    kind: Literal["fastest"] = "fastest"
    title: ClassVar[str] = "As fast as possible"


class RealTime(Value):
    """At the wall clock, times a factor (2 is twice as fast as the test)."""

    kind: Literal["real_time"] = "real_time"
    factor: float = quantity("Speed", shown="1", ge=0.01, le=1000, default=1.0, help="1 is real time")
    title: ClassVar[str] = "Real time"


Pace = Annotated[Fastest | RealTime, Field(discriminator="kind")]


class Plan(Value):
    """A hybrid test. `digest` names what decides its result; `Plan.read` checks everything that needs no ground motion."""

    model_config = ConfigDict(validate_by_name=True, validate_by_alias=True)

    schema_: Literal["rths-plan/1"] = Field("rths-plan/1", alias="schema", title="Form of the plan")
    name: str = Field("Untitled test", title="Name", min_length=1, max_length=200)
    notes: str = Field("", title="Notes", max_length=10_000)
    template: str | None = Field(None, title="Template", max_length=80)
    motion: PlannedMotion = Field(title="Ground motion")
    structure: Structure = Field(title="Structure")
    integrator: Integrator = Field(CrIntegrator(), title="Integration")
    controller_rate: float = quantity("Controller rate", "Hz", ge=1, le=100_000, default=1024.0)
    stations: tuple[Station, ...] = Field((), title="Stations", max_length=32)
    seed: int = Field(0, title="Seed of the sensor noise", ge=0, le=2**63 - 1)
    duration: float | None = quantity("Duration", "s", gt=0, le=3600, default=None, help="empty: as long as the record")
    pace: Pace = Field(Fastest(), title="Pace")

    @classmethod
    def read(cls, data: Any) -> Plan:
        """A plan from its JSON form. Raises PlanError listing every issue."""
        if not isinstance(data, Mapping):
            raise PlanError(Issue("", "a plan is a mapping of fields", fix="start from a template"))
        plan = validated(cls, data)
        issues = tuple(plan._issues())
        if issues:
            raise PlanError(issues)
        plan.integration()
        return plan

    @classmethod
    def from_yaml(cls, text: str) -> Plan:
        """A plan from YAML. Raises PlanError for bad YAML as for a bad plan."""
        return cls.read(plan_yaml.parse(text))

    def to_yaml(self) -> str:
        """YAML in SI with each number's unit as a comment; `from_yaml` reads it back to the same plan."""
        return plan_yaml.write(self)

    def as_dict(self) -> dict[str, Any]:
        return self.model_dump(mode="json", by_alias=True)

    @property
    def digest(self) -> str:
        """Hex SHA-256 over the canonical JSON of everything that decides the result."""
        decisive = self.model_dump(mode="json", by_alias=True, exclude={"name", "notes", "template", "pace"})
        return hashlib.sha256(json.dumps(decisive, sort_keys=True, separators=(",", ":")).encode()).hexdigest()

    @property
    def substep(self) -> float:
        """Controller step (s)."""
        return 1.0 / self.controller_rate

    def drifts(self) -> Array:
        """L (stations, DOF): row j takes displacements to the stroke of station j."""
        rows = self.structure.assemble().drifts
        return rows[[station.storey - 1 for station in self.stations]]

    def integration(self) -> Factor:
        """The integrator's M_e factorised, from M, C and the initial K with the stations' equivalents. Raises PlanError."""
        built = self.structure.assemble()
        damping, stiffness = built.damping.copy(), built.stiffness.copy()
        for station, drift in zip(self.stations, self.drifts(), strict=True):
            outer = station.dampers * np.outer(drift, drift)
            damping += station.equivalent_damping * outer
            stiffness += station.equivalent_stiffness * outer
        return factorised(self.integrator.build(built.mass, damping, stiffness))

    def periods(self) -> Array:
        """Natural periods (s) of the analytical substructure, the first mode's first."""
        built = self.structure.assemble()
        periods: Array = 2 * np.pi / circular_frequencies(built.mass, built.stiffness)
        return periods

    def _issues(self) -> Iterator[Issue]:
        dt, n, rate = self.integrator.dt, self.integrator.substeps, self.controller_rate
        if not math.isclose(dt * rate, n, rel_tol=1e-9):
            fix = f"with {n} substeps at {rate:g} Hz the step is {n / rate:.9g} s"
            yield Issue("integrator.dt", f"is {dt * rate:.6g} controller steps, but a step has {n} substeps", dt, fix)
        storeys = len(self.structure.storeys)
        for index, station in enumerate(self.stations):
            if station.storey > storeys:
                yield Issue(
                    f"stations.{index}.storey", f"the structure has {storeys} storeys", station.storey, f"give 1 to {storeys}"
                )
        names = [station.name for station in self.stations]
        for index, name in enumerate(names):
            if name in names[:index]:
                yield Issue(
                    f"stations.{index}.name", "is another station's name already", name, "give each station its own name"
                )
