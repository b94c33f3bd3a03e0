"""One diagnosis that several tests read: a specimen with 2 mm of play. Verdict and plots are compared in their JSON form."""

from __future__ import annotations

import json
from typing import Any

import pytest

from rths_engine.diagnosis.pictures import pictures
from rths_engine.diagnosis.verdict import Diagnosis, diagnose
from rths_engine.parts.physics.specimen.backlash import Backlash
from tests.engine import recorded_specimens as made


@pytest.fixture(scope="session")
def played() -> Diagnosis:
    return diagnose(made.plan(), made.recording(2, Backlash(gap=0.002)))


@pytest.fixture(scope="session")
def told(played: Diagnosis) -> Any:
    return json.loads(json.dumps(played.verdict.as_dict(), allow_nan=False))


@pytest.fixture(scope="session")
def shown(played: Diagnosis) -> Any:
    return json.loads(json.dumps(pictures(played).as_dict(), allow_nan=False))
