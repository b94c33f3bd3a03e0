"""A test plan: one immutable value that reproduces its run to the bit."""

from __future__ import annotations

import hashlib
import json
from typing import Annotated, Any, ClassVar, Literal

from pydantic import ConfigDict, Field

from rths_engine.foundation.part import Part, Value, quantity
from rths_engine.parts.actuators import Actuator
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.compensators import Compensator
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.parts.connections import Connection
from rths_engine.parts.connections.emulated import Emulated
from rths_engine.parts.controllers import Controller
from rths_engine.parts.controllers.no_control import NoControl
from rths_engine.parts.integrators import Integrator
from rths_engine.parts.integrators.cr import CrIntegrator
from rths_engine.parts.physics import ActuatorEffect, InputEffect, SensorEffect, SpecimenEffect, StructureEffect
from rths_engine.parts.physics.effect import PART, Effect, amended
from rths_engine.parts.specimens import Specimen
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.structures import Structure
from rths_engine.parts.structures.no_structure import NoStructure
from rths_engine.planning.client import LONGEST_UNKNOWN, Client
from rths_engine.planning.coupling import Coupling
from rths_engine.planning.excitation import Drive, FloorForce, Start
from rths_engine.planning.kinds_of_test import DRIVEN, FOLLOWING, TESTS
from rths_engine.planning.known import HOW, How
from rths_engine.planning.motion import NoMotion, PlannedMotion
from rths_engine.planning.safety import Limits

# chosen; see docs/decisions/0023
COMPUTED: dict[str, Any] = {"tests": ["hybrid", "structure"]}
TESTED: dict[str, Any] = {"tests": ["hybrid", *FOLLOWING], "one_in": [*DRIVEN]}
ONLY_DRIVEN: dict[str, Any] = {"tests": [*DRIVEN]}
ONLY_CLIENT: dict[str, Any] = {"tests": ["client"]}
ONLY_HYBRID = ["hybrid"]
LINEARISED = ["hybrid", "client"]
COUPLED: dict[str, Any] = {"tests": ONLY_HYBRID, "item": "Shared specimen"}
MOST_STATIONS = 32
MOST_COUPLINGS = 8
ROOM = 293.15  # K, 20 degrees Celsius

# fields of a compensator that earlier plans do not have, as ADDED; by definition their defaults
ADDED_TO_COMPENSATORS: dict[str, dict[str, Any]] = {
    "ats": {"fit_step": None, "start_gain": 1.0, "acceleration_root": None},
}
# fields of a station that earlier plans do not have, with the value under which they leave the digest of a plan unchanged
ADDED: dict[str, Any] = {
    "connection": {"kind": "emulated"},
    "controller": {"kind": "none"},
    "coil_resistance": None,
    "temperature": ROOM,
}


class Noise(Value):
    """Standard deviation of the white Gaussian sensor noise that every substep adds to the measured values."""

    displacement: float = quantity("Displacement noise (standard deviation)", "m", "mm", ge=0, le=0.1, default=0.0)
    force: float = quantity("Force noise (standard deviation)", "N", "kN", ge=0, le=1e7, default=0.0)


class Station(Value):
    """One experimental substructure: actuator, specimen and sensors. It represents `dampers` equal dampers in its storey.

    Where its `connection` is an external rig, actuator, specimen and sensors are the models that predict it.
    """

    name: str = Field("Station", title="Name", min_length=1, max_length=80)
    storey: int = quantity("Storey", ge=1, le=100, default=1, help="storey 1 is the lowest", tests=ONLY_HYBRID)
    dampers: int = quantity("Dampers in the storey", ge=1, le=1000, default=1, tests=ONLY_HYBRID)
    equivalent_stiffness: float = quantity(
        "Equivalent stiffness of one damper", "N/m", "kN/m", ge=0, le=1e12, default=0.0, tests=LINEARISED
    )
    equivalent_damping: float = quantity(
        "Equivalent damping of one damper", "N*s/m", "kN*s/m", ge=0, le=1e12, default=0.0, tests=ONLY_HYBRID
    )
    compensator: Compensator = Field(AdaptiveInverseCompensation(), title="Delay compensator")
    actuator: Actuator = Field(FirstOrderDelay(), title="Actuator")
    specimen: Specimen = Field(MrDamper(), title="Specimen")
    controller: Controller = Field(NoControl(), title="Controller of the current")
    coil_resistance: float | None = quantity(
        "Coil resistance", "ohm", gt=0, le=1e6, default=None, help="empty: 1 ohm; converts a recorded coil voltage to a current"
    )
    temperature: float = quantity("Temperature of the specimen", "K", gt=0, le=2000, default=ROOM, help="293.15 K is 20 °C")
    noise: Noise = Field(Noise(), title="Sensor noise")
    limits: Limits = Field(Limits(), title="Safety limits")
    actuator_physics: tuple[ActuatorEffect, ...] = Field((), title="Left-out physics of the actuator", max_length=8)
    specimen_physics: tuple[SpecimenEffect, ...] = Field((), title="Left-out physics of the specimen", max_length=8)
    sensor_physics: tuple[SensorEffect, ...] = Field((), title="Errors of the sensors", max_length=8)
    connection: Connection = Field(Emulated(), title="Connection", json_schema_extra={"folded": True})

    @property
    def rig(self) -> tuple[Part, Part, Part, Part]:
        """Compensator, actuator, specimen and controller as they are built, with the effects that change a part."""
        moved, pressed = amended(self.actuator, self.actuator_physics), amended(self.specimen, self.specimen_physics)
        return self.compensator, moved, pressed, self.controller

    @property
    def physics(self) -> tuple[Effect, ...]:
        """All effects that have their own step."""
        return tuple(one for one in (*self.actuator_physics, *self.specimen_physics, *self.sensor_physics) if one.hook != PART)


class Fastest(Value):
    """The test runs as fast as the computer allows."""

    kind: Literal["fastest"] = "fastest"
    title: ClassVar[str] = "As fast as possible"


class RealTime(Value):
    """The test runs in real time times a speed factor; 2 is twice as fast. Every controller step is measured.

    The operating system is asked for `core` and `priority` for the loop. Where it refuses, the test runs without and says so.
    """

    kind: Literal["real_time"] = "real_time"
    factor: float = quantity("Speed factor", shown="1", ge=0.01, le=1000, default=1.0, help="1: real time")
    core: int | None = quantity(
        "Processor core", strict=True, ge=0, le=4095, default=None, help="empty: any core; counted from 0"
    )
    priority: int | None = quantity(
        "Real-time priority",
        strict=True,
        ge=1,
        le=99,
        default=None,
        help="empty: ordinary priority; the operating system must permit it",
    )
    title: ClassVar[str] = "Real time"


Pace = Annotated[Fastest | RealTime, Field(discriminator="kind")]


class Plan(Value):
    """A test plan. `digest` covers everything that decides its result.

    `reading.read_plan` checks everything that does not need the ground motion. `test` is the kind of test: `hybrid` computes
    the structure and tests the specimens; `structure` tests nothing; `specimen` and `actuator` compute no structure, and their
    one station follows `drive`; the stations of a `client` test follow another program. Fields name the kinds that use them. In
    a plan of another kind they keep their default.
    """

    model_config = ConfigDict(validate_by_name=True, validate_by_alias=True)

    schema_: Literal["rths-plan/1"] = Field("rths-plan/1", alias="schema", title="Format of the plan")
    name: str = Field("Untitled test", title="Name", min_length=1, max_length=200)
    notes: str = Field("", title="Notes", max_length=10_000)
    template: str | None = Field(None, title="Template", max_length=80)
    test: Literal["hybrid", "specimen", "actuator", "structure", "client"] = Field(
        "hybrid", title="Kind of test", json_schema_extra={"titles": {**TESTS}}
    )
    motion: PlannedMotion = Field(NoMotion(), title="Ground motion", json_schema_extra=COMPUTED)
    forces: tuple[FloorForce, ...] = Field((), title="Forces on floors", max_length=32, json_schema_extra=COMPUTED)
    start: Start = Field(Start(), title="Start", json_schema_extra={"tests": ["structure"]})
    drive: Drive = Field(Drive(), title="Drive", json_schema_extra=ONLY_DRIVEN)
    client: Client = Field(Client(), title="Client", json_schema_extra=ONLY_CLIENT)
    structure: Structure = Field(NoStructure(), title="Structure", json_schema_extra=COMPUTED)
    integrator: Integrator = Field(CrIntegrator(), title="Integration", json_schema_extra=COMPUTED)
    controller_rate: float = quantity("Controller rate", "Hz", ge=1, le=100_000, default=1024.0)
    stations: tuple[Station, ...] = Field((), title="Stations", max_length=MOST_STATIONS, json_schema_extra=TESTED)
    couplings: tuple[Coupling, ...] = Field(
        (),
        title="Specimens that stations share",
        max_length=MOST_COUPLINGS,
        description="Several actuators on one specimen. Such a station has no specimen of its own.",
        json_schema_extra=COUPLED,
    )
    structure_physics: tuple[StructureEffect, ...] = Field(
        (), title="Left-out physics of the structure", max_length=8, json_schema_extra=COMPUTED
    )
    motion_physics: tuple[InputEffect, ...] = Field(
        (), title="Errors of the ground motion", max_length=8, json_schema_extra=COMPUTED
    )
    known: dict[str, How] = Field(
        {},
        title="How well the numbers are known",
        max_length=200,
        description="Diagnoses refit a number within the tolerance that its statement gives. Runs do not use it.",
        json_schema_extra={"titles": {**HOW}},
    )
    seed: int = Field(0, title="Seed of the sensor noise", ge=0, le=2**63 - 1)
    duration: float | None = quantity(
        "Duration",
        "s",
        gt=0,
        le=3600,
        default=None,
        help="empty: duration of the excitation; 600 s where a client ends the test",
    )
    pace: Pace = Field(Fastest(), title="Pace")

    def as_dict(self) -> dict[str, Any]:
        return self.model_dump(mode="json", by_alias=True)

    @property
    def digest(self) -> str:
        """Hex SHA-256 over the canonical JSON of everything that decides the result."""
        decisive = self.model_dump(mode="json", by_alias=True, exclude={"name", "notes", "template", "pace", "known"})
        for station in decisive["stations"]:
            for name in [name for name, default in ADDED.items() if station[name] == default]:
                del station[name]
            compensator = station["compensator"]
            for name, default in ADDED_TO_COMPENSATORS.get(compensator["kind"], {}).items():
                if compensator[name] == default:
                    del compensator[name]
        step = decisive.pop("client")["step"]  # how the client is reached decides nothing
        if step is not None:
            decisive["client"] = {"step": step}
        if not self.couplings:  # earlier plans have none
            del decisive["couplings"]
        return hashlib.sha256(json.dumps(decisive, sort_keys=True, separators=(",", ":")).encode()).hexdigest()

    @property
    def substep(self) -> float:
        """Controller step (s)."""
        return 1.0 / self.controller_rate

    @property
    def driven(self) -> bool:
        """Whether the stations follow a drive or a client, and no structure is computed."""
        return self.test in FOLLOWING

    @property
    def substeps(self) -> int:
        """Number of controller steps in a step of the loop."""
        return 1 if self.driven else self.integrator.substeps

    @property
    def step(self) -> float:
        """Step of the loop (s): the integration step, or the controller step of a test without structure."""
        return self.substep if self.driven else self.integrator.dt

    def length(self, record: float) -> float:
        """Duration (s) of the test: as planned, else that of the excitation; `record` (s) is that of the ground motion.

        The client of a test ends it; the duration is then the longest that is recorded.
        """
        if self.test == "client":
            return self.duration or LONGEST_UNKNOWN
        return self.duration or self.moved(record)

    def moved(self, record: float) -> float:
        """Time (s) at which ground motion, forces and drive end."""
        forces = (force.shape.duration for force in self.forces)
        return max(0.0 if self.motion.kind == "none" else record, self.drive.shape.duration, *forces)
