"""The paper's own ground motion, which is not bundled."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

FOLDER = Path(os.environ.get("RTHS_GROUND_MOTIONS", Path(__file__).parents[3] / "shared" / "ground_motions"))
RECORD = FOLDER / "NR94cnp.txt"

needs_record = pytest.mark.skipif(not RECORD.is_file(), reason=f"the paper's record is not bundled, and there is no {RECORD}")
