"""Connections of stations: where the actuator and the specimen of a station are.

An emulated station is the models of its plan. Every other kind of connection makes an `Adapter`, which drives an external rig
by open, command, measure and close: `connection`. The models of the plan then predict that rig, in preflight and stability. A
further kind of rig is one file with its class, and one name in `Connection`.
"""

from typing import Annotated

from pydantic import Field

from rths_engine.foundation.part import kinds
from rths_engine.parts.connections.emulated import Emulated
from rths_engine.parts.connections.epics import Epics
from rths_engine.parts.connections.fmu import Fmu
from rths_engine.parts.connections.generic_client import GenericClient

Connection = Annotated[Emulated | GenericClient | Epics | Fmu, Field(discriminator="kind")]
KINDS = kinds(Connection)
