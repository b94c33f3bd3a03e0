"""`python -m rths_engine.warm`: compile the loop once, so that the first test starts at once."""

from __future__ import annotations

import numpy as np

from rths_engine import replay, templates
from rths_engine.physics.specimen.asymmetry import Asymmetry
from rths_engine.run import simulate


def warm() -> None:
    """Run one integration step of a small plan, without and with a left-out effect, and the replay of its specimen."""
    plan = templates.template("linear-damper").model_copy(update={"duration": 0.01})
    simulate(plan)
    station = plan.stations[0].model_copy(update={"specimen_physics": (Asymmetry(),)})
    simulate(plan.model_copy(update={"stations": (station,)}))
    replay.specimen(station.specimen, (), np.zeros(2), np.ones(2), plan.substep)


if __name__ == "__main__":
    warm()
