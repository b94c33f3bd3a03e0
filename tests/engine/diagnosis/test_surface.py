"""The surface of a remaining force: means, counts and standard errors of its cells, its words, and the next test."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rths_engine.diagnosis.components import Specimen, SpecimenData
from rths_engine.diagnosis.fitting import Recordings
from rths_engine.diagnosis.surface import CELLS, STOREY_CELLS, Surface, surfaces
from rths_engine.foundation.arrays import Array
from rths_engine.parts.specimens.linear import LinearSpecimen
from tests.engine.diagnosis.made import recordings
from tests.engine.diagnosis.test_structure import TIME as SHAKEN
from tests.engine.diagnosis.test_structure import component, plan, shaken

DT, COUNT, SIGMA = 0.01, 4000, 50.0
SPRING = LinearSpecimen(stiffness=2e6, damping=0.0)
TIME = DT * np.arange(COUNT)
X = 0.02 * np.sin(2 * np.pi * 0.31 * TIME) * (0.2 + 0.8 * np.abs(np.sin(2 * np.pi * 0.023 * TIME)))
V = np.gradient(X, DT)
TOP_X, TOP_V = np.max(np.abs(X)), np.max(np.abs(V))


def moved(extra: Array, x: Array = X, seed: int = 1) -> SpecimenData:
    noise = SIGMA * np.random.default_rng(seed).standard_normal(len(x))
    data = SpecimenData(DT, 0.0, True, x, SPRING.stiffness * x + extra + noise, np.ones(len(x)))
    data.__dict__["smooth"] = x
    return data


def used(extra: Array) -> Recordings:
    return recordings(Specimen("specimen:1", (SPRING,)), moved(extra), sigma=SIGMA)


def surface(extra: Array) -> Surface:
    (found,) = surfaces(used(extra), [SPRING])
    return found


def test_the_cells_hold_every_fitted_sample_and_the_mean_of_the_remaining_force() -> None:
    found = surface(3e3 * np.sign(V))
    assert found.mean.shape == (CELLS, CELLS) and found.samples.sum() == COUNT
    assert (found.visits <= found.samples).all() and np.array_equal(found.visited, found.samples > 0)
    middle = CELLS // 2
    faster = found.mean[middle, middle + 2 :][found.visited[middle, middle + 2 :]]
    assert faster == pytest.approx(np.full(len(faster), 3e3), abs=5 * SIGMA)
    assert found.at(np.array([0.0]), np.array([-0.9 * TOP_V]))[0] == pytest.approx(-3e3, abs=5 * SIGMA)
    assert found.at(np.array([2 * TOP_X]), np.array([0.0]))[0] == 0.0


def test_samples_that_are_not_fitted_are_not_in_the_surface() -> None:
    whole = used(np.zeros(COUNT))
    half = replace(whole, masks=(np.arange(COUNT) < COUNT // 2,))
    (found,) = surfaces(half, [SPRING])
    assert found.samples.sum() == COUNT // 2


def test_two_recordings_of_different_amplitudes_share_one_surface() -> None:
    pair = (moved(0 * X), moved(0 * X, 2 * X))
    (found,) = surfaces(recordings(Specimen("specimen:1", (SPRING,)), *pair, sigma=SIGMA), [SPRING])
    assert found.x.values[-1] == pytest.approx(2 * TOP_X) and found.samples.sum() == 2 * COUNT


def test_the_standard_error_is_that_of_noise_between_visits() -> None:
    """White noise: the error of a cell is sigma over the root of its samples, within the scatter of few visits."""
    found = surface(np.zeros(COUNT))
    many = found.visits > 4
    ratio = found.error[many] * np.sqrt(found.samples[many]) / SIGMA
    assert many.sum() > 5 and float(np.median(ratio)) == pytest.approx(1.0, abs=0.3)
    assert np.isnan(found.error[found.visits < 2]).all()


def test_a_storey_force_is_found_from_the_motion_that_it_makes() -> None:
    """Friction of 5 % of the largest elastic force in the one storey of a shaken building, seen as a displacement."""
    building = component(plan())
    still = shaken(np.sin(2 * np.pi * 1.5 * SHAKEN) * np.sin(0.3 * SHAKEN), ("x", 1, np.zeros(len(SHAKEN))))
    (state,), top = building.states(still), building.seen(still)[0].f
    moved = building.loaded(building.base, still, [0.05 * top * np.sign(state.v.values)])[0]
    noise = 1e-4 * np.std(moved)
    data = replace(still, floors=(("x", 1, moved + noise * np.random.default_rng(1).standard_normal(len(moved))),))
    (found,) = surfaces(recordings(building, data, sigma=noise), building.base)
    centre = STOREY_CELLS // 2
    assert found.place == "storey 1" and found.samples.sum() == len(SHAKEN)
    assert found.mean[centre, -1] / top == pytest.approx(0.05, rel=0.2)
    assert found.mean[centre, 0] / top == pytest.approx(-0.05, rel=0.2)
    assert found.error[centre, -1] < 0.01 * top
