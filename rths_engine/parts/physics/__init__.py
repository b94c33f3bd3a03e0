"""Left-out effects: physics that can be added to a model. One file for each effect, one folder for each component."""

from typing import Any

from rths_engine.parts.physics import actuator, input, sensor, specimen, structure
from rths_engine.parts.physics.actuator import ActuatorEffect
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.input import InputEffect
from rths_engine.parts.physics.search import Search
from rths_engine.parts.physics.sensor import SensorEffect
from rths_engine.parts.physics.specimen import SpecimenEffect
from rths_engine.parts.physics.structure import StructureEffect

SPECIMEN = specimen.KINDS
ACTUATOR = actuator.KINDS
SENSOR = sensor.KINDS
STRUCTURE = structure.KINDS
INPUT = input.KINDS
KINDS = (*SPECIMEN, *ACTUATOR, *SENSOR, *STRUCTURE, *INPUT)
SEARCHES: dict[type[Effect], Search[Any]] = {
    search.effect: search for room in (specimen, actuator, sensor, structure, input) for search in room.SEARCHES
}

__all__ = [
    "ACTUATOR",
    "INPUT",
    "KINDS",
    "SEARCHES",
    "SENSOR",
    "SPECIMEN",
    "STRUCTURE",
    "ActuatorEffect",
    "InputEffect",
    "SensorEffect",
    "SpecimenEffect",
    "StructureEffect",
]
