"""From a plan and its recording to a verdict: order, progress and the share of the false-alarm rate."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from rths_engine.diagnosis import verdict as stage
from rths_engine.diagnosis.components import Actuator
from rths_engine.diagnosis.verdict import Diagnosis, diagnose
from rths_engine.foundation.errors import RecordingError
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.recordings.measured import Measured, MeasuredChannel
from tests.engine import recorded_specimens as made
from tests.engine.diagnosis.test_recorded import X, measured, plan


def test_a_specimen_with_play_is_judged_to_have_play(played: Diagnosis) -> None:
    (one,) = played.judged
    assert (one.verdict, one.component.name) == ("mismatch", "specimen:1")
    (effect,) = one.effects
    assert isinstance(effect, Backlash) and effect.gap == pytest.approx(0.002, rel=0.05)  # 1 % noise over 12 s
    assert played.digital == ()  # a specimen test computes nothing


def test_linear_algebra_has_one_thread_during_a_diagnosis(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its threads would wait for each other beside the threads of the replays."""
    seen: list[int] = []

    def judged(*given: Any) -> Any:
        seen.extend(pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas")
        raise Stopped

    monkeypatch.setattr(stage, "judged", judged)
    with threadpool_limits(limits=2, user_api="blas"), pytest.raises(Stopped):
        diagnose(made.plan(), made.recording(2))
    assert set(seen) == {1}


class Stopped(Exception):
    """Ends a diagnosis once its first component has been asked for."""


def test_the_actuator_is_judged_first_with_its_share_of_the_level(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two components each has half of the level (Bonferroni), and half of the progress."""
    given: list[tuple[type, float]] = []
    heard: list[float] = []

    def judged(component: Any, name: str, data: Any, heldout: Any, level: float, random: Any, told: Any) -> Any:
        given.append((type(component), level))
        told(0.5)
        raise Stopped

    monkeypatch.setattr(stage, "judged", judged)
    force = 2e6 * X + 3e5 * np.gradient(X, 1 / 128)
    recording = measured(x_comp=X, x_meas=X, f_meas=force)
    with pytest.raises(Stopped):
        diagnose(plan(), recording, level=0.02, told=lambda what, share: heard.append(share))
    assert given == [(Actuator, 0.01)] and heard == [0.0, 0.25]


def test_a_listener_may_stop_a_diagnosis() -> None:
    def told(what: str, share: float) -> None:
        raise InterruptedError(what)

    with pytest.raises(InterruptedError, match="specimen of"):
        diagnose(made.plan(), made.recording(1), told=told)


def test_a_wrong_unit_is_refused_before_anything_is_fitted() -> None:
    plain = made.recording(1)
    channels = tuple(MeasuredChannel(one.role, 1, 1e3 * one.values, one.unit) for one in plain.channels if one.role == "f_meas")
    rest = tuple(one for one in plain.channels if one.role != "f_meas")
    with pytest.raises(RecordingError, match="Check the units"):
        diagnose(made.plan(), Measured(plain.dt, (*rest, *channels)))
