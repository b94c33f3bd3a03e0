"""Components of a test, each with the recorded signals at its ends."""

from rths_engine.diagnosis.components.actuator import Actuator, ActuatorData
from rths_engine.diagnosis.components.chain import Chain, ChainData
from rths_engine.diagnosis.components.component import Component, Data
from rths_engine.diagnosis.components.specimen import ClockSkew, Specimen, SpecimenData, StepError
from rths_engine.diagnosis.components.structure import Structure, StructureData, based

__all__ = [
    "Actuator",
    "ActuatorData",
    "Chain",
    "ChainData",
    "ClockSkew",
    "Component",
    "Data",
    "Specimen",
    "SpecimenData",
    "StepError",
    "Structure",
    "StructureData",
    "based",
]
