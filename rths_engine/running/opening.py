"""The run of a plan as a context: on the models of its stations, or connected with its external rigs."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.connections import external
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.running.external import ExternalRun
from rths_engine.running.run import Run


@contextmanager
def opened(planned: Plan | Model, motions: MotionLibrary, folder: Path | None = None) -> Iterator[Run]:
    """The run of a plan, ready to advance. At the end of the block every external rig gets its safe end.

    `folder` holds the service's files for connections. Raises PlanError or MotionError when the plan cannot run, and RigError
    where an external rig does not answer or contradicts the plan.
    """
    model = Model.of(planned)
    if external(model.plan):
        with ExternalRun(model, motions, folder) as run:
            yield run
    else:
        yield Run(model, motions)
