"""Predicted stability of a plan, and its map over the delays of two stations."""

from __future__ import annotations

from typing import Any

from app.calculations.bound import Bound
from rths_engine import stability
from rths_engine.planning.reading import read_model

POINTS = 31
STABILITY = Bound("stability prediction", seconds=20, megabytes=1500, mend="use fewer storeys or stations")


def predicted(data: Any) -> dict[str, Any]:
    """Spectral radius, verdict, modes, delay margins, and the map (null with fewer than two stations). Raises PlanError."""
    model = read_model(data)
    return {"name": model.plan.name, **stability.summary(model), "map": stability.mapped(model, POINTS)}
