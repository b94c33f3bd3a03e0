"""All published data sets that the program scores."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from rths_engine.scores import friction, oscillator, positioning
from rths_engine.scores.score import Score

BENCHMARKS: tuple[Callable[[Path], Score], ...] = (oscillator.score, positioning.score, friction.score)
