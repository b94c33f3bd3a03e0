"""Intervals hold the true numbers as often as they say."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
import pytest
from scipy.stats import binom, norm

from rths_engine.diagnosis.detect import null_misfits
from rths_engine.diagnosis.fitting import fit
from rths_engine.diagnosis.ranges import NORMAL_90, RISE, deviations, ranges
from rths_engine.foundation.arrays import Array
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from tests.engine.diagnosis.made import Gain, Wave, WaveSearch, linear, noisy, recordings

TRUE = [Gain(gain=2.1), Wave(size=0.3, storey=1)]


def test_ninety_percent_is_the_normal_laws() -> None:
    assert pytest.approx(norm.ppf(0.95), rel=1e-12) == NORMAL_90
    assert pytest.approx(2.7055, abs=1e-4) == RISE  # table of chi^2 of one number


def test_deviations_are_those_of_the_normal_equations() -> None:
    """Of 400 replicates: a relative deviation of 1 / sqrt(800); four of it."""
    used = recordings(linear(), noisy(TRUE, 1))
    fitted = fit(used, TRUE)
    misfits = np.random.default_rng(2).standard_normal((400, len(fitted.misfit)))
    expected = np.sqrt(np.diag(np.linalg.inv(fitted.jacobian.T @ fitted.jacobian)))
    assert deviations(fitted, misfits) == pytest.approx(expected, rel=4 / np.sqrt(800))


def test_nine_intervals_of_ten_hold_the_true_number() -> None:
    """Of 120 recordings a binomial number, within its 99.9 % bounds of 0.9; one more of a hundred for replicates that are 99,
    and for an effect's end, found on a grid of a sixteenth."""
    held = np.zeros(2)
    count = 120
    for seed in range(count):
        used = recordings(linear(), noisy(TRUE, seed, count=200))
        fitted = fit(used, TRUE)
        found = ranges(used, fitted, null_misfits(used, fitted, np.random.default_rng(seed)), 1.0)
        ends = [[number.from_z(end) for end in one] for number, one in zip(fitted.free, found, strict=True)]
        held += [low < one < high for (low, high), one in zip(ends, (2.1, 0.3), strict=True)]
    least, most = binom.ppf(0.0005, count, 0.89), binom.ppf(0.9995, count, 0.93)
    assert np.all((least <= held) & (held <= most)), held


def test_of_a_linear_model_the_profile_ends_where_the_normal_law_does() -> None:
    """The end of an effect's interval lies on a grid of a sixteenth, and no nearer than by the normal law."""
    used = recordings(linear(), noisy(TRUE, 3))
    fitted = fit(used, TRUE)
    noise = null_misfits(used, fitted, np.random.default_rng(4))
    (low, high), (less, more) = ranges(used, fitted, noise, 1.0)
    gain, size = NORMAL_90 * deviations(fitted, noise)
    assert (low, high) == pytest.approx((fitted.z[0] - gain, fitted.z[0] + gain), rel=1e-12)
    assert np.all(size * (1 - 1e-9) <= np.array([fitted.z[1] - less, more - fitted.z[1]]))
    assert np.all(np.array([fitted.z[1] - less, more - fitted.z[1]]) <= size * (1 + 1 / 16 + 1e-9))


def test_intervals_do_not_depend_on_where_the_fit_began() -> None:
    """A number is counted in units of the value that its fit began with."""
    used = recordings(linear(), noisy(TRUE, 7))
    noise = np.random.default_rng(8).standard_normal((99, used.samples))
    ends = []
    for size in (0.3, 0.2, -0.5):
        fitted = fit(used, [Gain(), Wave(size=size, storey=1)])
        (_, _), found = ranges(used, fitted, noise, 1.0)
        ends.append(sorted(fitted.free[1].from_z(end) for end in found))
    assert ends[1] == pytest.approx(ends[0], rel=2e-3) and ends[2] == pytest.approx(ends[0], rel=2e-3)  # of the grid's rounding


def test_an_interval_widens_with_the_root_of_the_temper() -> None:
    used = recordings(linear(), noisy(TRUE, 4))
    fitted = fit(used, TRUE)
    noise = null_misfits(used, fitted, np.random.default_rng(5))
    widths = [[high - low for low, high in ranges(used, fitted, noise, temper)] for temper in (1.0, 4.0)]
    assert np.array(widths[1]) == pytest.approx(2 * np.array(widths[0]), rel=0.07)  # an end is found on a grid of a sixteenth


def test_numbers_that_the_fit_holds_widen_the_others_by_what_they_may_as_well_be(monkeypatch: pytest.MonkeyPatch) -> None:
    """`otherwise` moves the held number by a known change d of the output: root of the squares of both."""

    class Held(Wave):
        shape: float = 1.0

        def output(self, x: Array) -> Array:
            return self.shape * super().output(x)

    class HeldSearch(WaveSearch):
        held = ("shape",)
        otherwise: ClassVar[Mapping[str, float]] = {"shape": 1.1}

    kind: type[Effect] = Held
    monkeypatch.setitem(physics.SEARCHES, kind, HeldSearch(Held))
    used = recordings(linear(), noisy(TRUE, 5))
    plain = fit(used, TRUE)
    held = [plain.parts[0], Held(size=plain.parts[1].size, storey=1)]  # type: ignore[attr-defined]
    fitted = fit(used, held)
    noise = null_misfits(used, fitted, np.random.default_rng(6))
    (narrow,), (wide,) = ([ranges(used, one, noise, 1.0)[1]] for one in (plain, fitted))
    # a tenth more of the shape moves the size by as much as a tenth of it, in units of its scale
    reach = NORMAL_90 * 0.1 * fitted.z[1]
    for end in (0, 1):
        expected = np.hypot(narrow[end] - plain.z[1], reach)
        assert abs(wide[end] - fitted.z[1]) == pytest.approx(expected, rel=0.02)  # two fits that end within 1e-6 of the misfit
