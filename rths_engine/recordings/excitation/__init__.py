"""The recorded excitation of a test: smoothed motion, start, and the plan that follows it."""

from rths_engine.recordings.excitation.recorded import Excitation
from rths_engine.recordings.excitation.same import Difference, differences, lead, under_recorded

__all__ = ["Difference", "Excitation", "differences", "lead", "under_recorded"]
