"""Stability of the closed loop of a hybrid test about rest: `summary(plan)`, `mapped(plan, points)`, `warning(plan)`."""

from rths_engine.stability.closed_loop import ClosedLoop, Mode, stable
from rths_engine.stability.margins import Axis, Map, delay_map, margin
from rths_engine.stability.report import SHARED, mapped, summary, unpredicted, warning

__all__ = [
    "SHARED",
    "Axis",
    "ClosedLoop",
    "Map",
    "Mode",
    "delay_map",
    "mapped",
    "margin",
    "stable",
    "summary",
    "unpredicted",
    "warning",
]
