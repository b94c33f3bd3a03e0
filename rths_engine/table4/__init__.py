"""Table IV of Chen and Ricles (2012) on an emulated laboratory: its plans and the comparison with the paper.

`rths_engine.table4.running` runs them.
"""

from rths_engine.planning.laboratory import BUNDLED, LABORATORY, Laboratory, PlannedRecord, name, plans
from rths_engine.table4.comparison import DRIFTS_PERCENT, FLOORS_PEAK_MM, PAPER, Comparison, Row, comparison

__all__ = [
    "BUNDLED",
    "DRIFTS_PERCENT",
    "FLOORS_PEAK_MM",
    "LABORATORY",
    "PAPER",
    "Comparison",
    "Laboratory",
    "PlannedRecord",
    "Row",
    "comparison",
    "name",
    "plans",
]
