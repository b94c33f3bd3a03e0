"""The settings that compensators derive from a transfer system, against its closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from rths_engine.parts import compensators
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.parts.compensators.compensator import TransferSystem
from rths_engine.parts.compensators.derivative import DerivativeFeedForward
from rths_engine.parts.compensators.dual import DualCompensation
from rths_engine.parts.compensators.inverse import InverseCompensation

LAG = TransferSystem((1.0,), (0.02, 1.0), rate=1024.0, step=1 / 1024, displacement=0.01, velocity=0.1)
SECOND_ORDER = TransferSystem((2.0, 400.0), (1.0, 30.0, 410.0), rate=1024.0, step=1 / 1024, displacement=0.01, velocity=0.1)


def test_the_delay_of_a_first_order_lag_is_its_time_constant() -> None:
    assert (LAG.gain, LAG.delay) == pytest.approx((1.0, 0.02))
    assert InverseCompensation.tuned_for(LAG).alpha_es == pytest.approx(1 + 0.02 * 1024)


def test_the_inverse_series_times_the_transfer_function_is_one_up_to_its_order() -> None:
    series = np.array(SECOND_ORDER.inverse(4))[::-1]
    product = np.polymul(series, SECOND_ORDER.numerator)
    assert product[-5:][::-1] == pytest.approx([410.0, 30.0, 1.0, 0.0, 0.0], abs=1e-9)
    assert SECOND_ORDER.delay == pytest.approx(30 / 410 - 2 / 400)


def test_the_critical_gain_of_a_lag_and_one_step_of_delay_solves_its_equation() -> None:
    fast = TransferSystem((1.0,), (0.02, 1.0), rate=100.0, step=0.01, displacement=0.01, velocity=0.1)
    omega = 2 * math.pi * 29.9  # near the solution of omega dt + atan(omega T) = pi
    for _ in range(50):
        omega = (math.pi - math.atan(0.02 * omega)) / 0.01
    assert fast.critical_gain == pytest.approx(math.hypot(1, 0.02 * omega), rel=3e-3)


def test_adaptive_inverse_compensation_removes_a_wrong_delay_within_a_second_of_the_expected_motion() -> None:
    """TI grows by v^2 d for a delay error d under RMS velocity v, and alpha by kp TI: the error falls as exp(-kp v^2 dt t)."""
    part = AdaptiveInverseCompensation.tuned_for(LAG)
    assert part.kp * LAG.velocity**2 * LAG.dt == pytest.approx(1.0)


def test_derivative_feed_forward_leaves_out_the_acceleration_of_a_ramped_command() -> None:
    ramped = TransferSystem((1.0,), (1e-4, 0.02, 1.0), rate=1024.0, step=10 / 1024, displacement=0.01, velocity=0.1)
    smooth = TransferSystem((1.0,), (1e-4, 0.02, 1.0), rate=1024.0, step=1 / 1024, displacement=0.01, velocity=0.1)
    assert DerivativeFeedForward.tuned_for(smooth).acceleration_root == pytest.approx(1e-2)
    assert DerivativeFeedForward.tuned_for(ramped).acceleration_root == 0.0


def test_dual_compensation_keeps_a_gain_margin_of_four() -> None:
    slow = TransferSystem((1.0,), (1e-6, 3e-4, 3e-2, 1.0), rate=1024.0, step=1 / 1024, displacement=0.01, velocity=0.1)
    assert DualCompensation.tuned_for(slow).kp == pytest.approx(min(1.0, slow.critical_gain / 4))


@pytest.mark.parametrize("part", compensators.KINDS, ids=lambda part: part.__name__)
@pytest.mark.parametrize("system", [LAG, SECOND_ORDER], ids=["lag", "second_order"])
def test_every_compensator_settles_on_valid_settings_for_a_transfer_system(part: Any, system: TransferSystem) -> None:
    tuned = part.tuned_for(system)
    assert type(tuned) is part
    assert part.model_validate(tuned.model_dump()) == tuned
