"""No structure, for tests of a specimen or an actuator alone."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.part import Value
from rths_engine.parts.structures.assembled import Assembled, no_members


class NoStructure(Value):
    """No structure is computed: the station follows the drive of the plan."""

    kind: Literal["none"] = "none"
    title: ClassVar[str] = "No structure"

    def assemble(self) -> Assembled:
        none = np.zeros((0, 0))
        return Assembled(none, none, none, none, np.zeros(0), (), np.zeros((1, 0)), no_members())
