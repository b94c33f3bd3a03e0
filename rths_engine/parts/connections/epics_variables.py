"""The process variables that an EPICS connection names."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from rths_engine.parts.connections.connection import External

READINGS = {"get": "Get after the command has completed", "monitor": "Follow monitors"}
NAME = r"^[A-Za-z0-9_:.<>;\[\]{}-]*$"


def _name(title: str, description: str | None = None, needed: bool = False) -> str:
    found: str = Field(
        *([] if needed else [""]), title=title, description=description, min_length=int(needed), max_length=80, pattern=NAME
    )
    return found


class ProcessVariables(External):
    """Names of process variables (PVs), and how the measurements are read."""

    command: str = _name("PV of the command", needed=True)
    displacement: str = _name("PV of the measured displacement", needed=True)
    force: str = _name("PV of the measured force", needed=True)
    current: str = _name("PV of the current", "in A; empty: no current")
    permit: str = _name("PV of the permit", "the test ends when it becomes 0; empty: no permit")
    heartbeat: str = _name("PV of the heartbeat", "gets the number of each step; empty: no heartbeat")
    echo: str = _name("PV of the echo", "the heartbeat that the readings belong to; empty: readings can be old")
    reading: Literal["get", "monitor"] = Field(
        "get", title="How measurements are read", json_schema_extra={"titles": {**READINGS}}
    )

    @property
    def takes_current(self) -> bool:
        return bool(self.current)

    @property
    def peer(self) -> str:
        return f"EPICS record {self.command}"
