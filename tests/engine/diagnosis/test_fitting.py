"""Fits beside the normal equations of a linear model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.fitting import RUNAWAY, compared, evaluated, fit, problem
from rths_engine.diagnosis.noise import Noise
from rths_engine.foundation.arrays import Array
from tests.engine.diagnosis.made import SAMPLES, SHAPES, SIGMA, Gain, Wave, drive, driven, linear, noisy, recordings

TRUE = [Gain(gain=2.1), Wave(size=0.4, storey=1), Wave(size=-0.2, storey=3)]
START = [Gain(gain=2.0), Wave(size=0.1, storey=1), Wave(size=0.1, storey=3)]


def columns() -> Array:
    """What each number of the models above is multiplied by."""
    x = drive()
    return np.column_stack([x, SHAPES[0](x), SHAPES[2](x)])


def values(parts: object) -> Array:
    return np.array([getattr(one, "gain", None) or one.size for one in parts])  # type: ignore[attr-defined]


def test_a_recording_without_noise_gives_its_numbers_back() -> None:
    fitted = fit(recordings(linear(), noisy(TRUE, 1, sigma=0.0)), START)
    assert values(fitted.parts) == pytest.approx(values(TRUE), rel=1e-5)  # the search ends at 1e-6 of the misfit
    assert fitted.squared < 1e-4


def test_the_fit_is_the_solution_of_the_normal_equations() -> None:
    data = noisy(TRUE, 2)
    fitted = fit(recordings(linear(), data), START)
    solution, squares, _, _ = np.linalg.lstsq(columns(), data.out, rcond=None)
    deviations = SIGMA * np.sqrt(np.diag(np.linalg.inv(columns().T @ columns())))
    assert np.all(np.abs(values(fitted.parts) - solution) < 1e-3 * deviations)
    assert fitted.squared == pytest.approx(float(squares[0]) / SIGMA**2, rel=1e-6)


def test_numbers_scatter_by_the_covariance_of_the_jacobian() -> None:
    """Mean and covariance of 150 fits: their own deviations are 1 / sqrt(150) and sqrt(2 / 150) of it; four of each."""
    fits = [fit(recordings(linear(), noisy(TRUE, seed)), START) for seed in range(150)]
    z = np.array([one.z for one in fits])
    expected = np.linalg.inv(fits[0].jacobian.T @ fits[0].jacobian)
    size = np.sqrt(np.diag(expected))
    true = np.array([2.1 / 2.0, 0.4 / 0.1, -0.2 / 0.1])  # each over its scale, the value that it began with
    assert np.all(np.abs(z.mean(axis=0) - true) < 4 * size / np.sqrt(150))
    assert np.cov(z.T) / np.outer(size, size) == pytest.approx(expected / np.outer(size, size), abs=4 * np.sqrt(2 / 150))


def test_a_planned_number_with_a_tolerance_is_weighed_with_its_plan() -> None:
    """z = (a^T y / sigma^2 + z_0 / s^2) / (a^T a / sigma^2 + 1 / s^2), with a the drive times the plan's gain."""
    data, share = noisy([Gain(gain=2.2)], 3, count=40), 0.03
    fitted = fit(recordings(linear(share=share), data), [Gain(gain=2.0)])
    column = 2.0 * data.x
    precision = float(column @ column) / SIGMA**2 + 1 / share**2
    expected = (float(column @ data.out) / SIGMA**2 + 1 / share**2) / precision
    assert fitted.z[0] == pytest.approx(expected, abs=1e-3 / np.sqrt(precision))
    assert fitted.misfit[fitted.samples :] == pytest.approx([(fitted.z[0] - 1) / share], rel=1e-9)


def test_the_bic_counts_the_numbers_and_the_samples() -> None:
    fitted = fit(recordings(linear(), noisy(TRUE, 4)), START)
    assert fitted.bic == pytest.approx(fitted.squared + 3 * np.log(SAMPLES), rel=1e-12)


def test_samples_that_are_not_fitted_do_not_move_the_numbers() -> None:
    data = noisy(TRUE, 5)
    spoilt = driven(np.where(np.arange(SAMPLES) < 100, 50.0, data.out))
    mask = np.arange(SAMPLES) >= 100
    one, other = (fit(replace(recordings(linear(), each), masks=(mask,)), START) for each in (data, spoilt))
    assert one.samples == SAMPLES - 100
    assert one.z == pytest.approx(other.z, rel=1e-9)


def test_a_sample_of_half_the_weight_counts_a_quarter() -> None:
    data = noisy([Gain(gain=2.2)], 6)
    weight = np.where(np.arange(SAMPLES) < 300, 0.5, 1.0)
    fitted = fit(replace(recordings(linear(), data), weights=(weight[None],)), [Gain()])
    expected = float(weight**2 @ (data.x * data.out)) / float(weight**2 @ data.x**2)
    assert 2.0 * fitted.z[0] == pytest.approx(expected, rel=1e-6)


def test_recordings_are_fitted_together() -> None:
    first, second = noisy(TRUE, 7), noisy(TRUE, 8)
    together = fit(recordings(linear(), first, second), START)
    stacked = np.vstack([columns(), columns()])
    solution = np.linalg.lstsq(stacked, np.concatenate([first.out, second.out]), rcond=None)[0]
    assert values(together.parts) == pytest.approx(solution, rel=1e-4)


def test_a_misfit_is_told_apart_by_channels() -> None:
    used = recordings(linear(), noisy(TRUE, 9), noisy(TRUE, 10))
    misfit = used.misfit(START)
    (rows,) = used.channels(misfit)
    assert np.array_equal(np.concatenate(rows), misfit) and [len(row) for row in rows] == [SAMPLES, SAMPLES]
    assert used.residuals(START)[0][0] / SIGMA == pytest.approx(rows[0], rel=1e-12)


def test_a_model_that_runs_away_is_cut_where_the_misfit_stays_finite() -> None:
    data = noisy(TRUE, 11)
    x = data.x.copy()
    x[5] = np.inf
    used = recordings(linear(), driven(data.out, x))
    assert np.max(np.abs(used.predicted([Gain(gain=1.0)])[0])) == pytest.approx(RUNAWAY * np.max(np.abs(data.out)))
    assert np.isfinite(used.misfit([Gain(gain=1.0)])).all()


def test_a_bound_holds_the_fit() -> None:
    big = driven(1e5 * SHAPES[0](drive()))
    fitted = fit(recordings(linear(), big), [Gain(gain=2.0), Wave(size=100.0, storey=1)])
    assert isinstance(fitted.parts[1], Wave) and fitted.parts[1].size == pytest.approx(1e3)


def test_a_model_evaluated_or_compared_is_not_moved() -> None:
    data = noisy(TRUE, 12)
    used = recordings(linear(), data)
    here = evaluated(used, START)
    assert here.parts == tuple(START)
    assert here.jacobian == pytest.approx(-columns() * [2.0, 0.1, 0.1] / SIGMA, rel=1e-6)  # of z: value over scale
    louder = compared(replace(used, noises=(Noise.white(2 * SIGMA),)), here)
    assert louder.misfit == pytest.approx(here.misfit / 2, rel=1e-12)


def test_a_start_at_its_bound_is_moved_inside() -> None:
    _, _, start, bounds = problem(recordings(linear(), noisy(TRUE, 13)), [Gain(), Wave(size=1e3)])
    assert np.all(start > bounds[:, 0]) and np.all(start < bounds[:, 1])
