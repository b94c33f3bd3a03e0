"""The MR damper with current against the damper at constant current, its coil and published strengths."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import compiled
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.specimens.mr_damper_current import MrDamperCurrent
from rths_engine.running import replay

DT = 1 / 1024
TIME = DT * np.arange(2048)
X = 0.03 * np.sin(2 * np.pi * TIME) + 0.004 * np.sin(2 * np.pi * 7 * TIME)


def energised(part: MrDamperCurrent, currents: Array) -> tuple[Array, Array]:
    """Coil current (A) and yield force (N) after each substep."""
    parameters, state = part.build(DT)
    rows = []
    for current in currents.tolist():
        MrDamperCurrent.energise(parameters, state, current, DT)
        rows.append((state[2], state[4]))
    coil, strength = np.array(rows).T
    return coil, strength


@pytest.mark.parametrize("current", [0.0, 0.7, 2.5])
def test_at_a_constant_current_the_force_is_that_of_the_passive_damper(current: float) -> None:
    part = MrDamperCurrent()
    passive = replay.specimen(part.at(current), [], X, np.ones(len(X)), DT)
    np.testing.assert_allclose(replay.specimen(part, [], X, np.full(len(X), current), DT), passive, rtol=1e-12, atol=1e-6)


def test_at_the_largest_current_of_its_tests_it_is_the_passive_damper_of_the_same_source() -> None:
    found, passive = MrDamperCurrent().at(2.5), MrDamper()
    assert found.yield_force == pytest.approx(passive.yield_force, rel=1e-3)  # two digits of the ratio r_a
    assert found.rate_coefficient == pytest.approx(passive.rate_coefficient, rel=1e-2)
    assert (found.stiffness, found.damping, found.rate_exponent) == (passive.stiffness, passive.damping, passive.rate_exponent)


def test_the_strength_rises_with_current_as_yang_et_al_measured() -> None:
    """alpha(i) = 16566 i^3 - 87071 i^2 + 168326 i + 15114 N, Yang et al. (2004), over its value at 2.5 A."""
    currents = np.linspace(0.0, 2.5, 26)
    measured = np.polynomial.Polynomial([15114, 168326, -87071, 16566])(currents)
    ours = np.array([MrDamperCurrent().at(current).yield_force for current in currents])
    np.testing.assert_allclose(ours / ours[-1], measured / measured[-1], atol=0.1)  # their cubic is flat from 1.5 to 2 A


def test_the_coil_follows_a_step_of_current_with_its_time_constant() -> None:
    part = MrDamperCurrent(coil_lag=0.05)
    coil, strength = energised(part, np.where(TIME < 0.1, 0.5, 2.0))
    after = TIME >= 0.1
    passed = DT * np.arange(1, after.sum() + 1)
    assert coil[~after] == pytest.approx(0.5) and coil[after] == pytest.approx(2.0 - 1.5 * np.exp(-passed / 0.05), rel=1e-12)
    assert strength == pytest.approx([part.at(one).yield_force for one in coil.tolist()], rel=1e-12)


def test_the_sign_of_the_current_does_not_matter_and_without_lag_the_coil_carries_the_command() -> None:
    coil, _ = energised(MrDamperCurrent(coil_lag=0.0), np.array([-1.0, 2.0, -0.5]))
    assert coil.tolist() == [1.0, 2.0, 0.5]


def test_the_compiled_energising_equals_that_in_python() -> None:
    part, fast = MrDamperCurrent(), compiled(MrDamperCurrent.energise)
    (parameters, state), (_, compiled_state) = part.build(DT), part.build(DT)
    for current in np.random.default_rng(1).uniform(-3, 3, 100).tolist():
        MrDamperCurrent.energise(parameters, state, current, DT)
        fast(parameters, compiled_state, current, DT)
    assert compiled_state == pytest.approx(state, rel=1e-12)
