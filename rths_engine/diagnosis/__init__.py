"""From "simulation and recording differ" to a better model: replay, detect, locate, select, verify, describe."""

from rths_engine.diagnosis.verdict import Diagnosis, diagnose

__all__ = ["Diagnosis", "diagnose"]
