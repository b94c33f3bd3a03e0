"""The worker tells a running test's measures."""

from __future__ import annotations

import json
from typing import Any

import pytest

from app.worker.child import Progress
from app.worker.engine import _Telling
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.reading import read_plan
from rths_engine.running.run import Run
from tests.app.conftest import plan


class Heard:
    """A line that remembers what it was sent and never hears a cancel."""

    def __init__(self) -> None:
        self.messages: list[Any] = []

    def show(self, message: Any) -> None:
        self.messages.append(message)

    def progress(self, doing: str, share: float) -> None:
        self.messages.append(Progress(doing, share))

    def cancelled(self, within_s: float) -> bool:
        return False


def test_progress_tells_the_measures_so_far_and_at_last_those_of_the_whole_test(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.worker.engine.PROGRESS_S", 0.0)
    run = Run(read_plan(plan()), MotionLibrary(None))
    heard: Any = Heard()
    _Telling(run, 1, heard).run_to_end()
    told = [message for message in heard.messages if isinstance(message, dict) and message["type"] == "progress"]
    peaks = [message["measures"]["stations"][0]["peak_stroke_mm"] for message in told]
    assert len(peaks) > 1 and peaks == sorted(peaks)
    shares = [message.share for message in heard.messages if isinstance(message, Progress)]
    assert shares == sorted(shares) and shares[-1] == 1.0
    json.dumps(told, allow_nan=False)
    last, whole = told[-1]["measures"], run.result("completed", 0.0).summary()
    for name in ("mte_mm", "mee_kNm", "delay_ms", "nrms_percent", "energy_error_percent"):
        # sums in another order
        assert last["stations"][1][name] == pytest.approx(whole["stations"][1][name], rel=1e-7, abs=1e-9)
    assert last["input_energy_kNm"] == pytest.approx(whole["input_energy_kNm"], rel=1e-9)
