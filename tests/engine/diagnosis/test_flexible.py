"""The rival that knows no physics."""

from __future__ import annotations

import numpy as np

from rths_engine.diagnosis.flexible import flexible
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.foundation.arrays import Array
from tests.engine.diagnosis.made import SIGMA, Gain, drive, driven, linear, noisy, recordings

COUNT = 3000


def strange(seed: int) -> Array:
    x = drive(COUNT)
    return np.asarray(2 * x + 0.8 * x * x * np.tanh(x) + SIGMA * np.random.default_rng(seed).standard_normal(COUNT))


def test_it_learns_a_law_that_no_effect_has() -> None:
    used = recordings(linear(), driven(strange(1), drive(COUNT)))
    held = HeldOut.of(used, (driven(strange(2), drive(COUNT)),))
    before, after = held.error(held.residuals([Gain()])), held.error(flexible(used, held, [Gain()]))
    assert after < 0.2 * before and after < 2 * held.noise


def test_it_learns_nothing_from_noise() -> None:
    used = recordings(linear(), noisy([Gain()], 3, COUNT))
    held = HeldOut.of(used, (noisy([Gain()], 4, COUNT),))
    assert held.error(flexible(used, held, [Gain()])) < 1.1 * held.error(held.residuals([Gain()]))
