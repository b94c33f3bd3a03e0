"""A rig behind EPICS process variables, reached by Channel Access."""

from __future__ import annotations

from typing import ClassVar, Literal

from rths_engine.parts.connections.connection import Adapter, Terms
from rths_engine.parts.connections.epics_channels import EpicsRig
from rths_engine.parts.connections.epics_variables import ProcessVariables


class Epics(ProcessVariables):
    """Process variables (PVs) of an input-output controller (IOC). Its addresses come from the environment, EPICS_CA_ADDR_LIST.

    Every controller step puts the command and then the number of the step into the heartbeat. Channel Access reports that a put
    has completed when its record was processed, which does not mean that the rig has measured: only a rig that copies the
    heartbeat into the echo proves that its readings belong to the command.
    """

    kind: Literal["epics"] = "epics"
    title: ClassVar[str] = "EPICS process variables (Channel Access)"

    def adapter(self, terms: Terms) -> Adapter:
        return EpicsRig(self, terms)
