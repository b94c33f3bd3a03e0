"""The components of a plan, each with the recorded signals at its ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rths_engine.diagnosis.components import (
    Actuator,
    ActuatorData,
    Chain,
    ChainData,
    ClockSkew,
    Component,
    Specimen,
    SpecimenData,
    StepError,
    Structure,
    StructureData,
    based,
)
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RecordingError
from rths_engine.foundation.part import Part
from rths_engine.parts.actuators.velocity_drive import VelocityDrive
from rths_engine.parts.physics.sensor.channel import Reading
from rths_engine.parts.specimens.commanded import Commanded
from rths_engine.planning.coupling_checks import not_diagnosed
from rths_engine.planning.plan import Plan, Station
from rths_engine.recordings.excitation.start import released_start
from rths_engine.recordings.measured import Measured
from rths_engine.running import replay

# chosen; see docs/decisions/0023
LEAST = 200  # fewest samples: with fewer, noise and physics cannot be separated
MOST = 4_000_000  # samples of a channel
FAR_OFF = 30.0  # ratio of measured to simulated size that indicates a wrong unit
Pair = tuple[Component, Any]
FLOORS = ("x_floor", "v_floor", "a_floor")


def components(plan: Plan, recording: Measured, where: str) -> list[Pair]:
    """The components that can be replayed, each with its data.

    Raises RecordingError, which names the input `where`, if the recording does not match the plan.
    """
    _checked(plan, recording, where)
    found = _structure(plan, recording, where) if plan.test == "structure" else _stations(plan, recording, where)
    if not found:
        motions = "the motion of at least one floor"
        ends = "the displacement or the force of a station, and its command or displacement"
        needed = motions if plan.test == "structure" else ends
        fix = f"the recording has the channels {', '.join(recording.keys)}"
        raise RecordingError(Issue(where, f"has no component with recorded signals at both ends: it needs {needed}", None, fix))
    return found


def _checked(plan: Plan, recording: Measured, where: str) -> None:
    if (shared := not_diagnosed(plan)) is not None:
        raise RecordingError(shared)
    if recording.samples < LEAST:
        raise RecordingError(Issue(where, f"has {recording.samples} samples; a diagnosis needs at least {LEAST}"))
    if recording.samples > MOST:
        problem = f"has {recording.samples} samples; a diagnosis accepts at most {MOST}"
        raise RecordingError(Issue(where, problem, None, "import a shorter part of the recording"))
    if recording.test and recording.test != plan.test:
        fix = "give the plan of this test, or import the recording with this kind of test"
        problem = f"is of a {recording.test!r} test; the plan describes a {plan.test!r} test"
        raise RecordingError(Issue(where, problem, None, fix))
    stations = recording.numbers("station")
    if stations and max(stations) > len(plan.stations):
        problem = f"has a channel of station {max(stations)}; the number of stations in the plan is {len(plan.stations)}"
        raise RecordingError(Issue(where, problem, None, "give the plan of this recording"))
    if recording.of_run and len(stations) != len(plan.stations):
        problem = f"has channels of {len(stations)} stations; the number of stations in the plan is {len(plan.stations)}"
        raise RecordingError(Issue(where, problem, None, "give the plan of this recording"))
    if (recording.of_run or plan.test in ("hybrid", "actuator")) and not _same_rate(plan, recording):
        rate = f"the controller rate of the plan is {plan.controller_rate:g} Hz"
        problem = f"has a sampling rate of {1 / recording.dt:g} Hz; {rate}"
        fix = "give the plan of this recording, or import the recording again with this target_rate"
        raise RecordingError(Issue(where, problem, None, fix))
    floors = recording.numbers("floor")
    count = len(plan.structure.assemble().floors) if plan.structure.kind != "none" else 0
    if floors and plan.test in ("structure", "hybrid") and max(floors) > count:
        problem = f"has a channel of floor {max(floors)}; the number of floors in the plan is {count}"
        raise RecordingError(Issue(where, problem, None, "give the plan of this recording"))


def _same_rate(plan: Plan, recording: Measured) -> bool:
    return bool(np.isclose(recording.dt, plan.substep, rtol=1e-6))


def _stations(plan: Plan, recording: Measured, where: str) -> list[Pair]:
    found: list[Pair] = []
    skew = () if recording.of_run else (ClockSkew(), StepError())
    base = (recording.dt, recording.start, recording.of_run)
    for number, station in enumerate(plan.stations, start=1):
        x, force = _moving(recording, "x_meas", number), _moving(recording, "f_meas", number)
        command = _command(plan, station, recording, number)
        if x is not None and command is not None and _same_rate(plan, recording):
            moved = Actuator(f"actuator:{number}", (station.actuator, *station.actuator_physics), known=plan.known)
            found.append((moved, ActuatorData(*base, command, x, force, isinstance(station.actuator, VelocityDrive))))
        if force is not None and x is not None:
            specimen, current = _commanded(station, recording, number, where)
            warm = recording.has("temperature", number)
            temperature = recording.get("temperature", number) if warm else np.full(1, station.temperature)
            pressed = Specimen(f"specimen:{number}", (specimen, *station.specimen_physics, *skew), known=plan.known)
            found.append((pressed, SpecimenData(*base, x, force, current, temperature=temperature)))
        if force is not None and x is None and command is not None:
            specimen, current = _commanded(station, recording, number, where)
            planned = (station.actuator, specimen, *station.actuator_physics, *station.specimen_physics, *skew)
            chain = Chain(f"specimen:{number}", planned, known=plan.known)
            found.append((chain, ChainData(*base, command, command, force, current=current)))
    return found


def _commanded(station: Station, recording: Measured, number: int, where: str) -> tuple[Part, Array]:
    """The specimen and its current (A): as recorded, from a recorded coil voltage, or as its controller holds it.

    A specimen that follows a current is replaced by the specimen at this current where the current is constant.
    """
    least, largest = station.controller.range
    if recording.has("current", number):
        current = recording.get("current", number)
    elif recording.has("coil_voltage", number):
        current = recording.get("coil_voltage", number) / (station.coil_resistance or 1.0)
    elif isinstance(station.specimen, Commanded) and least < largest:
        problem = f"has no current of station {number}, which the force of its specimen '{station.specimen.title}' follows"
        fix = "import the column with the role current or coil_voltage, or plan a constant current"
        raise RecordingError(Issue(where, problem, None, fix))
    else:
        current = np.full(recording.samples, station.controller.mean)
    if isinstance(station.specimen, Commanded) and not np.ptp(current) > 0:
        return station.specimen.at(float(current[0])), current
    return station.specimen, current


def foreseen(actuator: Actuator, parts: Sequence[Any], pressed: Specimen, recorded: dict[str, Any]) -> None:
    """Give the specimen's data the motion that the fitted actuator makes of its command.

    `parts` are the fitted actuator and its effects. The motion is computed against the planned force, because the measured
    force shares its noise with the compared signal. Errors of the displacement sensor are removed from the measured
    displacement.
    """
    if not {actuator.name, pressed.name} <= recorded.keys():
        return
    sent, data = recorded[actuator.name], recorded[pressed.name]
    against = sent if sent.force is None else replace(sent, force=pressed.force(pressed.base, data))
    expected = actuator.moved([part for part in parts if not isinstance(part, Reading)], against)
    added = actuator.moved(parts, against) - expected
    recorded[pressed.name] = replace(data, x=data.x - added, expected=expected)


def _moving(recording: Measured, role: str, number: int) -> Array | None:
    """A recorded channel that is not constant; None where there is no such channel."""
    if not recording.has(role, number):
        return None
    values = recording.get(role, number)
    return values if np.ptp(values) > 0 else None


def _command(plan: Plan, station: Station, recording: Measured, number: int) -> Array | None:
    """The command that the actuator received: as recorded, or as its compensator computes it; None where neither is known."""
    if (sent := _moving(recording, "x_comp", number)) is not None:
        return sent
    command = _moving(recording, "x_cmd", number)
    if command is None and number == 1 and plan.driven:
        command = _moving(recording, "drive", 1)
    if command is None:
        return None
    if station.compensator.kind == "none":
        return command
    x = _moving(recording, "x_meas", number)
    if x is None or not _same_rate(plan, recording):
        return None
    return replay.compensator(station.compensator, command, x, recording.dt)


def _structure(plan: Plan, recording: Measured, where: str) -> list[Pair]:
    floors: list[Any] = []
    for one in recording.channels:
        if one.role in FLOORS and one.number and np.ptp(one.values) > 0:
            floors.append((one.role[0], one.number, one.values))
    if not floors:
        return []
    ground = recording.get("ag") if recording.has("ag") else np.zeros(recording.samples)
    forces = {one.number: one.values for one in recording.channels if one.role == "force_ext" and one.number}
    released = None if recording.of_run else released_start(plan, recording, ground, forces)
    if recording.of_run:
        plan_start = plan.start
        count = len(plan.structure.assemble().floors)
        full = [tuple(one) + (0.0,) * (count - len(one)) for one in (plan_start.displacement, plan_start.velocity)]
        released = None if plan_start.at_rest else (full[0], full[1])
    if released is None and not ground.any() and not any(np.any(force) for force in forces.values()):
        problem = "has no excitation: the floors start at rest and move, but no ground acceleration or force was recorded"
        raise RecordingError(Issue(where, problem, None, "import the recording with the role ag or force_ext"))
    data = StructureData(
        recording.dt, recording.start, recording.of_run, ground, forces, tuple(floors), released, plan.substeps
    )
    read = [floor for kind, floor, _ in floors if kind == "x"]
    return [(Structure("structure", based(plan, released is not None and not recording.of_run, read), plan), data)]


def suspicious(pairs: Sequence[Pair]) -> list[str]:
    """Components whose unit is probably wrong: measured and simulated output differ in size by a factor of FAR_OFF or more."""
    found = []
    for component, data in pairs:
        simulated = component.predicted(component.base, data)
        for real, ours in zip(data.measured, simulated, strict=True):
            size, plan = float(np.std(real)), float(np.std(ours))
            if plan > 0 and size > 0 and not 1 / FAR_OFF < size / plan < FAR_OFF:
                found.append(
                    f"{component.name}: the measured {component.output} is {size / plan:.3g} times as large as the simulated "
                    f"{component.output}. Check the units of the input and output channels"
                )
    return found
