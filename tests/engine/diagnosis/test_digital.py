"""Computed parts replay to rounding, and nothing else does."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.digital import ROUNDING, replayed
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured import Measured
from rths_engine.recordings.of_run import of_run
from rths_engine.recordings.run_file import Recording, write
from tests.engine.plans import building, completed, make, shaking
