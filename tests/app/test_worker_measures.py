"""The worker tells a running test's measures."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from app.worker.engine import Job, _Telling
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.reading import read_plan
from rths_engine.running.run import Run
from tests.app.conftest import plan


class Heard:
    """The end of a pipe that remembers what it was sent and never has an answer."""

    def __init__(self) -> None:
        self.messages: list[Any] = []

    def send(self, message: Any) -> None:
        self.messages.append(message)

    def poll(self, timeout: float) -> bool:
        return False


def test_progress_tells_the_measures_so_far_and_at_last_those_of_the_whole_test(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.worker.engine.PROGRESS_S", 0.0)
    run = Run(read_plan(plan()), MotionLibrary(None))
    heard: Any = Heard()
    _Telling(run, Job("id", 1, plan(), Path("unused.h5"), Path("unused")), heard).run_to_end()
    told = [message for message in heard.messages if isinstance(message, dict) and message["type"] == "progress"]
    peaks = [message["measures"]["stations"][0]["peak_stroke_mm"] for message in told]
    assert len(peaks) > 1 and peaks == sorted(peaks)
    json.dumps(told, allow_nan=False)
    last, whole = told[-1]["measures"], run.result("completed", 0.0).summary()
    for name in ("mte_mm", "mee_kNm", "delay_ms", "nrms_percent", "energy_error_percent"):
        # sums in another order
        assert last["stations"][1][name] == pytest.approx(whole["stations"][1][name], rel=1e-7, abs=1e-9)
    assert last["input_energy_kNm"] == pytest.approx(whole["input_energy_kNm"], rel=1e-9)
