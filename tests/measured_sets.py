"""The measured sets ($RTHS_RECORDINGS) by the plans and mappings in `examples/`."""

from __future__ import annotations

from typing import Any

import pytest

from rths_engine.diagnosis.schema import Verdict
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_from_yaml
from rths_engine.recordings.measured import Measured, imported, read
from tests.conftest import RECORDINGS
from tests.test_example_mappings import EXAMPLES, example


def plan(name: str) -> Plan:
    return plan_from_yaml((EXAMPLES / name / "plan.yaml").read_text(encoding="utf-8"))


def measured(folder: str, file: str, **cut: Any) -> Measured:
    path = RECORDINGS / folder / file
    if not path.is_file():
        pytest.skip(f"no recording {path}: set RTHS_RECORDINGS to the folder that holds the sets")
    mapping = example(folder).model_copy(update=cut)
    return imported(read(path.read_bytes(), path.name), mapping, path.name)


def heldout(verdict: Verdict, model: str) -> float:
    """The error of the baseline or of the extended model on what was not fitted."""
    error: float | None = getattr(verdict.fit, model).heldout_nrmse
    assert error is not None
    return error
