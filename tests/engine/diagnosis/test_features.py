"""Terms of an unknown law beside their formulas."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.components.features import MODULATIONS, RELAXATIONS, WAVES, modulated, of_motion, of_position
from rths_engine.foundation.arrays import Array

DT = 1 / 200
TIME = DT * np.arange(4000)
X = 0.03 * np.sin(2 * np.pi * 0.5 * TIME)
V = 0.03 * np.pi * np.cos(2 * np.pi * 0.5 * TIME)
FORCE = 2e5 * V / np.max(np.abs(V))


def motion() -> dict[str, Array]:
    return {formula: values for formula, _, values in of_motion(X, V, DT, FORCE)}


def test_every_term_is_a_finite_signal_of_its_own_name_with_words() -> None:
    for terms in (of_motion(X, V, DT, FORCE), of_position(X, V, DT)):
        assert len({formula for formula, _, _ in terms}) == len(terms)
        for formula, words, values in terms:
            assert formula and words and values.shape == X.shape and np.isfinite(values).all()


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ("1", np.ones(4000)),
        ("x^3", (X / 0.03) ** 3),
        ("v |v|", (V / np.max(V)) * np.abs(V / np.max(V))),
        ("x |v|", (X / 0.03) * np.abs(V / np.max(V))),
        ("x^2 v", (X / 0.03) ** 2 * V / np.max(V)),
        ("t x", np.linspace(0, 1, 4000) * X / 0.03),
    ],
)
def test_a_term_is_its_formula_of_signals_over_their_largest(formula: str, expected: Array) -> None:
    assert motion()[formula] == pytest.approx(expected, abs=1e-9)


def test_friction_is_the_sign_of_the_velocity_but_near_standstill() -> None:
    """tanh(v / 0.02 of the largest) is within 1e-3 of the sign beyond 0.08 of the largest."""
    fast = np.abs(V) > 0.08 * np.max(V)
    assert motion()["sgn(v)"][fast] == pytest.approx(np.sign(V[fast]), abs=1e-3)


def test_the_energy_is_the_share_dissipated_so_far() -> None:
    """Of f = c v at a steady sine it grows as t / T, but for the ripple of half a period: 1 / (2 pi * 20)."""
    energy = motion()["E x"] / (X / 0.03 + 1e-12)
    away = np.abs(X) > 0.01
    assert energy[away] == pytest.approx((TIME / TIME[-1])[away], abs=1 / (2 * np.pi * 20) + 1e-3)


def test_a_stop_turns_after_twice_its_reach() -> None:
    """An elastic slider of reach r goes from -1 to 1 over 2 r of the amplitude."""
    held = motion()["stop_0.3(x)"]
    turned = (TIME > 1.5) & (TIME < 2.5)  # x rises from -1 to 1
    rising = (X / 0.03)[turned]
    expected = np.clip(-1 + (rising + 1) / 0.3, -1, 1)
    assert held[turned] == pytest.approx(expected, abs=0.02)  # a step of x is 0.016 of the amplitude


def test_waves_over_the_stroke_close_and_stand_for_friction_too() -> None:
    terms = {formula: values for formula, _, values in of_position(X, V, DT)}
    assert len(terms) == 4 * WAVES + 2 * len(RELAXATIONS)
    once = terms["sin(2 pi x / 60 mm)"]
    assert once == pytest.approx(np.sin(np.pi * X / 0.03), abs=1e-9)
    fast = np.abs(V) > 0.1 * np.max(V)
    assert np.abs(terms["cos(2 pi x / 60 mm) sgn(v)"][fast]) == pytest.approx(np.abs(np.cos(np.pi * X / 0.03))[fast], abs=1e-3)


@pytest.mark.parametrize("constant", RELAXATIONS)
def test_what_relaxes_follows_a_step_exponentially(constant: float) -> None:
    step = np.where(TIME >= 1.0, 1.0, 1e-12)
    terms = {formula: values for formula, _, values in of_position(step, np.gradient(step, DT), DT)}
    after = TIME >= 1.0
    expected = 1 - np.exp(-(TIME[after] - 1.0 + DT) / constant)
    assert terms[f"x relaxed over {constant:g} s"][after] == pytest.approx(expected, abs=1e-9)


def test_slow_modulations_are_orthogonal_half_waves() -> None:
    found = modulated(np.ones((2, 1000)), "f", "a strength")
    assert len(found) == MODULATIONS
    rows = np.array([one.response[0] for one in found])
    assert rows @ rows.T == pytest.approx(500 * np.eye(MODULATIONS), abs=1e-8)  # of cosines at the middles
    assert found[0].response.shape == (2, 1000) and found[1].formula == "f cos(2 pi t / T)"
