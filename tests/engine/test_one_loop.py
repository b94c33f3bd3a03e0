"""Plans of all kinds share few compiled loops: another layout of an array would compile the loop again for half a minute."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from rths_engine.parts.physics.structure.coulomb_friction import CoulombFriction
from rths_engine.planning import templates
from rths_engine.running.run import Run
from tests.engine.plans import LIBRARY

ALONE = [name for name in templates.names() if templates.template(name).test != "client"]


def arrays(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(value, np.ndarray):
        yield name, value
    elif hasattr(value, "_asdict"):
        for field, inside in value._asdict().items():
            yield from arrays(f"{name}.{field}", inside)


@pytest.mark.parametrize("name", ALONE)
def test_the_loop_gets_every_array_in_one_layout(name: str) -> None:
    plan = templates.template(name).model_copy(update={"duration": 0.1})
    plans = [plan]
    if plan.test in ("hybrid", "structure"):
        plans.append(plan.model_copy(update={"structure_physics": (CoulombFriction(),)}))
    for one in plans:
        run = Run(one, LIBRARY)
        for data in (run._setup, run._state, run._left_out, run._record):
            assert [where for where, array in arrays("", data) if not array.flags.c_contiguous] == []
