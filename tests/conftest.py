"""Tests are never timed, and see none of the caller's settings."""

from __future__ import annotations

import gc
import os
from pathlib import Path
from typing import Any

import pytest
from hypothesis import is_hypothesis_test, settings

gc.disable()  # until all tests are collected: what they import stays to the end

settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")

RECORDINGS = Path(os.environ.get("RTHS_RECORDINGS") or Path(__file__).parents[2] / "shared" / "recordings")
KEPT = ("RTHS_CACHE", "RTHS_TEST_DATABASE_URL", "RTHS_GROUND_MOTIONS", "RTHS_OPENSEES_PYTHON")
for name in [name for name in os.environ if name.startswith("RTHS_") and name not in KEPT]:
    del os.environ[name]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Lines count where an example executes them: of drawn values they would change with the draw, at twice the time."""
    for item in items:
        if is_hypothesis_test(getattr(item, "obj", None)):
            item.add_marker(pytest.mark.no_cover)


def pytest_collection_finish() -> None:
    """Leave what was imported out of every later collection of garbage, which would go through all of it again and again."""
    gc.freeze()
    gc.enable()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    if config.getvalue("dist") != "loadfile":
        return None
    from tests.both_ends import BothEnds

    return BothEnds(config, log)
