"""Period and damping of a free decay against the closed form."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.results.metrics.decay import free_decay

DT = 1 / 1024
TIME = np.arange(20 * 1024) * DT


def decaying(period: float, ratio: float, phase: float = 0.0) -> np.ndarray:
    omega = 2 * np.pi / period
    return np.asarray(np.exp(-ratio * omega * TIME) * np.cos(omega * np.sqrt(1 - ratio**2) * TIME + phase))


@pytest.mark.parametrize(("period", "ratio", "phase"), [(0.54, 0.02, 0.0), (1.5, 0.05, 1.0), (0.3, 0.002, -2.0)])
def test_period_and_damping_of_one_mode_are_found(period: float, ratio: float, phase: float) -> None:
    found = free_decay(0.03 * decaying(period, ratio, phase), DT)
    assert found is not None
    assert found.period == pytest.approx(period / np.sqrt(1 - ratio**2), rel=1e-5)  # crossings by straight lines, (omega dt)^2
    assert found.ratio == pytest.approx(ratio, rel=1e-3)  # peaks to the next sample, (omega dt)^2 / 8


def test_a_higher_mode_that_dies_out_is_not_counted_as_cycles() -> None:
    found = free_decay(decaying(0.5, 0.02) + 0.2 * decaying(0.11, 0.05), DT)
    assert found is not None
    assert found.period == pytest.approx(0.5, rel=2e-3)
    assert found.ratio == pytest.approx(0.02, rel=0.05)


@pytest.mark.parametrize("x", [np.zeros(0), np.zeros(5000), np.ones(5000), np.exp(-TIME), decaying(12.0, 0.02)])
def test_what_does_not_swing_has_no_decay(x: np.ndarray) -> None:
    assert free_decay(x, DT) is None
