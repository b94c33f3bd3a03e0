"""`python -m rths_engine.warm`: compile the loop once, so that the first test starts at once."""

from __future__ import annotations

from rths_engine import templates
from rths_engine.physics.specimen.asymmetry import Asymmetry
from rths_engine.run import simulate


def warm() -> None:
    """Run one integration step of a small plan, without and with a left-out effect."""
    plan = templates.template("linear-damper").model_copy(update={"duration": 0.01})
    simulate(plan)
    station = plan.stations[0].model_copy(update={"specimen_physics": (Asymmetry(),)})
    simulate(plan.model_copy(update={"stations": (station,)}))


if __name__ == "__main__":
    warm()
