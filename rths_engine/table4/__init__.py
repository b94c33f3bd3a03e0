"""Table IV of Chen and Ricles (2012) on an emulated laboratory: its plans, their runs, and the comparison with the paper."""

from rths_engine.table4.comparison import FLOORS_PEAK_MM, PAPER, Comparison, comparison
from rths_engine.table4.laboratory import BUNDLED, LABORATORY, Laboratory, PlannedRecord, name, plans
from rths_engine.table4.rows import Row, drifts_percent, run_all
from rths_engine.table4.scale import design_basis

__all__ = [
    "BUNDLED",
    "FLOORS_PEAK_MM",
    "LABORATORY",
    "PAPER",
    "Comparison",
    "Laboratory",
    "PlannedRecord",
    "Row",
    "comparison",
    "design_basis",
    "drifts_percent",
    "name",
    "plans",
    "run_all",
]
