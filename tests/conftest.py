"""Tests are never timed, and see none of the caller's settings."""

from __future__ import annotations

import os
from pathlib import Path

from hypothesis import settings

settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")

RECORDINGS = Path(os.environ.get("RTHS_RECORDINGS") or Path(__file__).parents[2] / "shared" / "recordings")
KEPT = ("RTHS_CACHE", "RTHS_TEST_DATABASE_URL", "RTHS_GROUND_MOTIONS", "RTHS_OPENSEES_PYTHON")
for name in [name for name in os.environ if name.startswith("RTHS_") and name not in KEPT]:
    del os.environ[name]
