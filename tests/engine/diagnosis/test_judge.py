"""The verdict on one component, of recordings whose truth is known."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.detect import Detection
from rths_engine.diagnosis.ends import ENDS, inner
from rths_engine.diagnosis.fitting import Fitted, evaluated
from rths_engine.diagnosis.judge import (
    BLOCKS,
    HELD_OUT,
    MORE_THAN_HALF,
    NOT_WHOLE,
    PLAIN,
    Judged,
    fitted_blocks,
    judged,
)
from tests.engine.diagnosis.made import (
    DT,
    SHAPES,
    SIGMA,
    Driven,
    Gain,
    Linear,
    Wave,
    as_judged,
    drive,
    driven,
    linear,
    noisy,
    recordings,
    selected,
)

COUNT = 1000


def verdict_on(component: Linear, *data: Driven, heldout: tuple[Driven, ...] = (), level: float = 0.01) -> Judged:
    return judged(component, "specimen", data, heldout, level, np.random.default_rng(1), lambda share: None)


def test_a_recording_of_the_plan_is_consistent() -> None:
    found = verdict_on(linear(gain=2.0), noisy([Gain(gain=2.0)], 2, COUNT))
    assert found.verdict == "consistent" and found.effects == () and not found.unknown


def test_a_number_off_its_plan_is_recalibrated() -> None:
    found = verdict_on(linear(gain=2.0), noisy([Gain(gain=2.2)], 3, COUNT))
    assert found.verdict == "recalibrate" and found.effects == ()
    assert found.selection.chosen.parts[0].gain == pytest.approx(2.2, abs=5 * SIGMA / np.sqrt(400))  # type: ignore[attr-defined]


def test_an_effect_of_the_library_is_named() -> None:
    found = verdict_on(linear(), noisy([Gain(gain=2.1), Wave(size=0.5, storey=4)], 4, COUNT))
    assert found.verdict == "mismatch" and [one.id for one in found.effects] == ["wave_4"]  # type: ignore[attr-defined]
    assert found.unproved < 0.3


def test_a_law_outside_the_library_is_unknown() -> None:
    """x^2, of which no wave has a part; the component's general law has it."""
    x = drive(COUNT)
    out = 2 * x + 0.5 * x**2 + SIGMA * np.random.default_rng(5).standard_normal(COUNT)
    found = verdict_on(linear(waves=1), driven(out, x))
    assert found.verdict == "mismatch" and found.unknown and found.effects == ()


def test_a_verdict_with_the_same_seed_is_the_same_to_the_bit() -> None:
    data = noisy([Gain(gain=2.1), Wave(size=0.5, storey=4)], 8, COUNT)
    one, other = (verdict_on(linear(), data).selection for _ in range(2))
    assert np.array_equal(one.chosen.z, other.chosen.z)
    assert (one.chances, one.ranges) == (other.chances, other.ranges)
    assert [each.p_value for each in one.detections] == [each.p_value for each in other.detections]


def test_three_blocks_of_ten_are_held_out_and_the_ends_left_out() -> None:
    used = fitted_blocks(1000, DT)
    inside = inner(1000, DT)
    assert np.flatnonzero(inside)[[0, -1]].tolist() == [round(ENDS / DT), 1000 - round(ENDS / DT) - 1]
    held = inside & ~used
    assert sorted({int(place) * BLOCKS // 1000 for place in np.flatnonzero(held)}) == list(HELD_OUT)
    assert held.sum() == 300


def test_another_recording_held_out_leaves_every_block_fitted() -> None:
    found = verdict_on(linear(), noisy([Gain()], 6), heldout=(noisy([Gain()], 7),))
    assert np.array_equal(found.recordings.masks[0], inner(600, DT))


def simulated(gain: float, heldout: tuple[Driven, ...] = ()) -> Judged:
    """The planned model beside a recording of another gain, without noise."""
    data = driven(gain * drive())
    used = replace(recordings(linear(), data), masks=(fitted_blocks(600, DT),))
    model = evaluated(used, [Gain(gain=2.0)])
    return as_judged(selected(used, model, model), heldout=heldout)


@pytest.mark.parametrize("fitted", [True, False, None])
def test_the_error_is_over_the_spread_of_what_was_measured(fitted: bool | None) -> None:
    """Of a drive g too large, (g - 2) of the RMS over g of the deviation about the mean."""
    found = simulated(2.5)
    inside = inner(600, DT)
    used = {True: fitted_blocks(600, DT), False: inside & ~fitted_blocks(600, DT), None: inside}[fitted]
    x = drive()[used]
    assert found.nrmse([Gain(gain=2.0)], fitted) == pytest.approx(0.2 * np.sqrt(np.mean(x**2)) / np.std(x), rel=1e-9)


def test_recordings_held_out_are_what_the_error_of_the_unfitted_is_of() -> None:
    x = drive()[inner(600, DT)]
    found = simulated(2.5, heldout=(driven(4.0 * drive()),))
    assert found.nrmse([Gain(gain=2.0)], False) == pytest.approx(0.5 * np.sqrt(np.mean(x**2)) / np.std(x), rel=1e-9)


def test_the_noise_is_over_the_same_spread() -> None:
    assert simulated(2.5).noise == pytest.approx(SIGMA / np.std(2.5 * drive()), rel=1e-9)


def test_the_share_left_unproved_is_of_the_power_held_out() -> None:
    data = driven(2.0 * drive() + SHAPES[0](drive()))
    used = replace(recordings(linear(), data), masks=(fitted_blocks(600, DT),))
    before, after = (evaluated(used, parts) for parts in ([Gain(gain=2.0)], [Gain(gain=2.0), Wave(size=0.9, storey=1)]))
    assert as_judged(selected(used, before, after)).unproved == pytest.approx(0.01, rel=1e-6)  # a tenth of the deviation left


def left(gain: float, explained: float, chance: float) -> Judged:
    """A selection that gains `gain` of chi^2 beside a general law that could still explain so much."""
    used = recordings(linear(), driven(drive()))
    plain: Any = evaluated(used, [Gain(gain=1.0)])
    before = Fitted(plain.parts, plain.free, plain.z, np.array([np.sqrt(gain)]), plain.jacobian[:1], 1)
    after = Fitted(plain.parts, plain.free, plain.z, np.array([0.0]), plain.jacobian[:1], 1)
    last = Detection(np.zeros(0), 0.0, 1.0, chance, 1.0, explained + 3.0, 3.0)
    return as_judged(selected(used, before, after, detections=(last,)))


@pytest.mark.parametrize(
    ("gain", "explained", "chance", "remains"),
    [
        (1000.0, 0.9 * PLAIN, 1e-9, False),  # little beyond noise, whatever its share
        (0.0, 1.1 * PLAIN, 1e-9, True),
        (1000.0, 400.0, 1e-9, False),  # 400 of 1400 is less than a third
        (1000.0, 600.0, 1e-9, True),  # 600 of 1600 is more
        (1000.0, 600.0, 0.03, False),  # by a doubtful chance, more than half is needed
        (500.0, 600.0, 0.03, True),
        (500.0, 600.0, 0.2, False),
    ],
)
def test_more_than_a_third_of_what_is_beyond_the_plan_is_another_law(
    gain: float, explained: float, chance: float, remains: bool
) -> None:
    found = left(gain, explained, chance)
    assert found.gain == pytest.approx(gain + explained) and found.left == pytest.approx(explained)
    assert found.remains(0.01) is remains
    assert pytest.approx(1 / 3) == NOT_WHOLE and MORE_THAN_HALF == 0.5
