"""Preflight: a dry run of a plan at the fastest pace and its predicted stability, before the plan is queued.

`preflight(plan)` returns one JSON object; `rths_engine.preflight.report` defines it.
"""

from rths_engine.preflight.report import preflight
from rths_engine.preflight.uses import Capacity

__all__ = ["Capacity", "preflight"]
