"""The client of a test: another program, such as OpenSees, that computes the structure and sends displacements to the rig."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from rths_engine.foundation.part import Value, quantity

# chosen; see docs/decisions/0023
LONGEST_UNKNOWN = 600.0  # s, of a test that its client ends


class Client(Value):
    """How the client reaches the rig: by the protocol of OpenSees' `genericClient`, see docs/opensees-rig.md."""

    transport: Literal["tcp", "udp"] = Field(
        "tcp", title="Transport", json_schema_extra={"titles": {"tcp": "TCP", "udp": "UDP"}}
    )
    port: int = Field(8090, title="Port", ge=0, le=65_535, description="0: any free port")
    waiting: float = quantity("Longest wait for the client", "s", gt=0, le=86_400, default=600.0)
    patience: float = quantity(
        "Longest silence of the client", "s", gt=0, le=3600, default=60.0, help="the test ends when the client is silent longer"
    )
    step: float | None = quantity(
        "Step of a client that sends no time", "s", gt=0, le=10, default=None, help="empty: the client sends its time"
    )
