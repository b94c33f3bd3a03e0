"""Predicted stability of a plan, and its map over the delays of two stations."""

from __future__ import annotations

from typing import Any

from rths_engine import stability
from rths_engine.planning.reading import read_model

POINTS = 31


class StabilityService:
    """Predicts the stability of a plan's closed loop."""

    def predict(self, data: Any) -> dict[str, Any]:
        """Spectral radius, verdict, modes, delay margins, and the map (null with fewer than two stations). Raises PlanError."""
        model = read_model(data)
        return {"name": model.plan.name, **stability.summary(model), "map": stability.mapped(model, POINTS)}
