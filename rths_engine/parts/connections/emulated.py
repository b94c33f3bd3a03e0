"""The station is the models of its plan."""

from __future__ import annotations

from typing import ClassVar, Literal

from rths_engine.foundation.part import Value


class Emulated(Value):
    """The models of the plan are the actuator and the specimen of the station."""

    kind: Literal["emulated"] = "emulated"
    title: ClassVar[str] = "Emulated by the models of the plan"
    external: ClassVar[bool] = False
    physical: ClassVar[bool] = False
