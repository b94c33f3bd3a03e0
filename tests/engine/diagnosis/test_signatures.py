"""Signatures beside finite differences of the misfit and beside projections in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.components import Specimen, SpecimenData
from rths_engine.diagnosis.fitting import evaluated, fit
from rths_engine.diagnosis.signatures import absorber, best_first, general, general_terms, signatures
from rths_engine.foundation.arrays import Array
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import F_SENSOR, FORCE, Effect
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.specimen.cubic_stiffness import CubicStiffness
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.running import replay
from tests.engine.diagnosis.made import DT, SHAPES, SIGMA, Gain, Wave, drive, linear, noisy, recordings


def beyond(change: Array, columns: Array) -> Array:
    """The unit vector of a change without its part in the span of the columns, by least squares."""
    left = change - columns @ np.linalg.lstsq(columns, change, rcond=None)[0]
    found: Array = left / np.linalg.norm(left)
    return found


def test_a_signature_is_the_effect_without_what_the_fitted_numbers_absorb() -> None:
    used = recordings(linear(), noisy([Gain(gain=2.1)], 1))
    found = signatures(used, fit(used, [Gain()]))
    x = drive()
    for effect, row, size in zip(found.effects, found.rows, found.sizes, strict=True):
        assert isinstance(effect, Wave)
        shape = SHAPES[effect.storey - 1](x)
        assert row == pytest.approx(np.sign(effect.size) * beyond(shape, x[:, None]), abs=1e-9)
        left = shape - x * (x @ shape) / (x @ x)
        assert size == pytest.approx(abs(effect.size) * np.linalg.norm(left) / SIGMA, rel=1e-6)
    assert len(found.effects) == len(SHAPES)


def test_the_signature_of_a_small_effect_is_its_slope_by_central_differences() -> None:
    """A spring that hardens, in the compiled replay: the force is linear in k_3, so that the two agree to rounding."""
    time = np.arange(1000) / 100
    x = 0.02 * np.sin(2 * np.pi * 0.6 * time) * np.sin(0.5 * time)
    spring = LinearSpecimen(stiffness=2e6, damping=3e5)
    force = spring.stiffness * x + spring.damping * np.gradient(x, 0.01)
    data = SpecimenData(0.01, 0.0, True, x, force, np.ones(len(x)))
    data.__dict__["smooth"] = x
    used = recordings(Specimen("specimen:1", (spring,)), data, sigma=100.0)
    fitted = evaluated(used, [spring])
    found = signatures(used, fitted, sized=False)
    (place,) = (place for place, effect in enumerate(found.effects) if isinstance(effect, CubicStiffness))
    up, down = (used.misfit([spring, CubicStiffness(stiffness=size)]) for size in (1e6, -1e6))
    slope = (down - up) / 2e6  # a signature is of the output; the misfit is what was measured less it
    assert found.rows[place] == pytest.approx(beyond(slope, fitted.jacobian), abs=1e-6)


def test_an_effect_is_looked_at_in_the_size_that_the_misfit_has_along_it() -> None:
    used = recordings(linear(), noisy([Gain(), Wave(size=-0.06, storey=1)], 2, sigma=1e-3), sigma=1e-3)
    found = signatures(used, fit(used, [Gain()]))
    (wave,) = (effect for effect in found.effects if effect.id == "wave_1")
    assert isinstance(wave, Wave) and wave.size == pytest.approx(-0.06, rel=0.02)  # noise: 1e-3 over sqrt(600) of x^3
    plain = signatures(used, fit(used, [Gain()]), sized=False)
    assert [effect.size for effect in plain.effects if isinstance(effect, Wave)] == [0.3] * len(SHAPES)


def test_scores_are_standard_normal_where_there_is_only_noise() -> None:
    """Of 400 draws: means within 4 / sqrt(400), deviations within 4 / sqrt(800)."""
    used = recordings(linear(), noisy([Gain()], 3))
    found = signatures(used, fit(used, [Gain()]))
    along = np.random.default_rng(4).standard_normal((400, found.rows.shape[1])) @ found.rows.T
    assert np.abs(along.mean(axis=0)).max() < 0.2 and np.abs(along.std(axis=0) - 1).max() < 0.15
    scores = found.scores(along @ np.linalg.pinv(found.rows).T)
    assert scores == pytest.approx(np.abs(along), abs=1e-9)  # a wave may be of either sign


def test_what_the_fitted_numbers_absorb_whole_has_no_signature() -> None:
    used = recordings(linear(), noisy([Gain(), Wave(size=0.2, storey=1)], 5))
    present = signatures(used, fit(used, [Gain(), Wave(size=0.2, storey=1)]))
    assert "wave_1" not in [effect.id for effect in present.effects]
    still = recordings(linear(), noisy([Gain()], 6, count=100))
    again = signatures(still, evaluated(still, [Gain(), Wave(size=1.0, storey=1), Wave(size=1.0, storey=2)]))
    assert {effect.id for effect in again.effects} == {"wave_3", "wave_4"}


def test_the_best_of_each_effect_comes_first_and_once() -> None:
    used = recordings(linear(), noisy([Gain(), Wave(size=0.4, storey=3)], 7))
    fitted = fit(used, [Gain()])
    found = signatures(used, fitted)
    order = best_first(found, found.scores(fitted.misfit))
    assert found.effects[order[0]].id == "wave_3"
    assert sorted(order) == list(range(len(SHAPES)))


def test_the_absorber_is_an_orthonormal_basis_of_the_slopes_without_those_that_follow_from_others() -> None:
    random = np.random.default_rng(8)
    columns = random.standard_normal((50, 3)) * [1.0, 1e8, 1e-8]
    basis = absorber(np.column_stack([columns, columns[:, 0] + columns[:, 1] / 1e8, np.zeros(50)]))
    assert basis.shape == (50, 3)
    assert basis.T @ basis == pytest.approx(np.eye(3), abs=1e-12)
    assert basis @ (basis.T @ columns) == pytest.approx(columns, rel=1e-6, abs=1e-14)
    assert absorber(np.zeros((50, 2))).shape == (50, 0)


def test_a_general_law_is_what_its_terms_span_beyond_fitted_numbers_and_drifts() -> None:
    used = recordings(linear(), noisy([Gain()], 9))
    fitted = fit(used, [Gain()])
    basis, terms = general(used, fitted), general_terms(used, fitted)
    assert terms.shape[1] == 3  # x^2, x^3, x^5; the gain absorbs x
    assert basis.T @ basis == pytest.approx(np.eye(3), abs=1e-9)
    assert np.abs(basis.T @ absorber(fitted.jacobian)).max() < 1e-6  # basis of rows that were made so
    slow = np.cos(np.pi * (np.arange(len(drive())) + 0.5) / len(drive()))  # half a wave over six seconds
    assert np.linalg.norm(basis.T @ slow) / np.linalg.norm(slow) < 1e-6
    assert DT * len(drive()) == 6.0


PROPORTIONAL = [kind for kind, search in physics.SEARCHES.items() if search.proportional and kind.hook in (FORCE, F_SENSOR)]


@pytest.mark.parametrize("kind", PROPORTIONAL, ids=lambda kind: kind.__name__)
def test_the_change_by_a_proportional_effect_is_proportional_to_its_size(kind: type[Effect]) -> None:
    x = 0.02 * np.sin(np.arange(2000) / 60) * np.sin(np.arange(2000) / 300)
    spring, seen = LinearSpecimen(stiffness=2e6, damping=3e5), Seen(0.02, 0.07, 6e4, 20.0, 5e3, 0.01)
    search, still = physics.SEARCHES[kind], np.ones(len(x))
    for guess in search.guesses(seen):
        plain, whole, part = (
            replay.specimen(spring, effects, x, still, 0.01) for effects in ((), (guess,), (search.times(guess, 0.03),))
        )
        assert part - plain == pytest.approx(0.03 * (whole - plain), abs=1e-9 * float(np.max(np.abs(whole))))


def test_a_proportional_effect_is_resized_as_a_replay_would() -> None:
    x = 0.02 * np.sin(np.arange(2000) / 60) * np.sin(np.arange(2000) / 300)
    spring = LinearSpecimen(stiffness=2e6, damping=3e5)
    force = replay.specimen(spring, (CubicStiffness(stiffness=-2e7),), x, np.ones(len(x)), 0.01)
    data = SpecimenData(0.01, 0.0, True, x, force, np.ones(len(x)))
    data.__dict__["smooth"] = x
    used = recordings(Specimen("specimen:1", (spring,)), data, sigma=100.0)
    fitted = evaluated(used, [spring])
    found = signatures(used, fitted)
    checked = 0
    for effect, row, size in zip(found.effects, found.rows, found.sizes, strict=True):
        if physics.SEARCHES[type(effect)].proportional:
            change = used.misfit([spring]) - used.misfit([spring, effect])
            left = change - absorber(fitted.jacobian) @ (absorber(fitted.jacobian).T @ change)
            assert np.linalg.norm(left) == pytest.approx(size, rel=1e-6)
            assert row == pytest.approx(left / size, abs=1e-6)
            checked += 1
    assert checked > 8
