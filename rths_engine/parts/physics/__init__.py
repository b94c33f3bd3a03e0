"""Left-out effects: physics that a model can be extended by, one a file, by the component they belong to."""

from rths_engine.parts.physics import actuator, input, sensor, specimen, structure
from rths_engine.parts.physics.actuator import ActuatorEffect
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.input import InputEffect
from rths_engine.parts.physics.sensor import SensorEffect
from rths_engine.parts.physics.specimen import SpecimenEffect
from rths_engine.parts.physics.structure import StructureEffect

SPECIMEN: tuple[type[Effect], ...] = specimen.KINDS
ACTUATOR: tuple[type[Effect], ...] = actuator.KINDS
SENSOR: tuple[type[Effect], ...] = sensor.KINDS
STRUCTURE: tuple[type[Effect], ...] = structure.KINDS
INPUT: tuple[type[Effect], ...] = input.KINDS
KINDS = (*SPECIMEN, *ACTUATOR, *SENSOR, *STRUCTURE, *INPUT)

__all__ = [
    "ACTUATOR",
    "INPUT",
    "KINDS",
    "SENSOR",
    "SPECIMEN",
    "STRUCTURE",
    "ActuatorEffect",
    "InputEffect",
    "SensorEffect",
    "SpecimenEffect",
    "StructureEffect",
]
