"""`python -m rths_engine.warm`: compile the loop once, so that the first test starts at once."""

from __future__ import annotations

from rths_engine import templates
from rths_engine.run import simulate


def warm() -> None:
    """Run one integration step of a small plan."""
    simulate(templates.template("linear-damper").model_copy(update={"duration": 0.01}))


if __name__ == "__main__":
    warm()
