"""Identification of a station's delay by a short random test."""

from rths_engine.identification.identify import identify
from rths_engine.identification.random_test import RandomTest

__all__ = ["RandomTest", "identify"]
