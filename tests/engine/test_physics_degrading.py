"""Effects of a specimen and of a storey that wear, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.specimen import PeakDegradation, StiffnessDegradation, StrengthDegradation, ViscousHeating
from rths_engine.parts.physics.structure import Softening
from rths_engine.parts.physics.structure import StiffnessDegradation as StoreyDegradation
from rths_engine.parts.specimens.bouc_wen import BoucWen
from rths_engine.running import replay
from tests.engine.effects import enclosed, stepped

DT = 1 / 1024
TIME = DT * np.arange(4 * 1024 + 1)
CYCLES = 0.02 * np.sin(2 * np.pi * TIME)


def test_a_constant_force_wears_away_exponentially_and_keeps_a_share() -> None:
    """E = F_0 x while the force is constant: with small steps dE/dx = F_0 (1 - d (1 - exp(-E / E_d)))."""
    x = np.linspace(0, 0.5, 20_001)
    force = stepped(StrengthDegradation(share=0.6, energy=2e3), np.full_like(x, 1e4), x)
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(x))])
    assert force == pytest.approx(1e4 * (1 - 0.6 * -np.expm1(-energy / 2e3)), rel=1e-4)
    assert force[-1] > 4e3  # never below the share that stays


def test_little_degradation_is_viscous_heating() -> None:
    x, force = CYCLES, 1e5 * np.sign(np.gradient(CYCLES))
    worn = stepped(StrengthDegradation(share=0.5, energy=1e6), force, x)
    heated = stepped(ViscousHeating(fade=0.5e-6), force, x)
    differ = np.abs(worn - heated).max() / np.abs(force - heated).max()
    assert differ == pytest.approx(0.5 * 0.032, rel=0.1)  # E / E_d = 0.032 in the end: half of it


def test_a_force_is_lost_with_the_peak_and_stays_lost() -> None:
    x = np.array([0.0, 0.01, -0.02, 0.0, 0.01, 0.03, 0.0])
    kept = stepped(PeakDegradation(rate=20.0), np.ones(7), x)
    assert kept == pytest.approx(np.exp(-20 * np.array([0.0, 0.01, 0.02, 0.02, 0.02, 0.03, 0.03])))


def test_a_worn_specimen_keeps_its_strength_and_needs_more_displacement() -> None:
    """A Bouc-Wen specimen with d: after much energy its slope from zero is (1 - d) k, and its strength is the same."""
    part = BoucWen(stiffness=5e6, yield_force=1e4, post_yield_ratio=0.0, exponent=2.0, fullness=0.5)
    still = np.ones_like(TIME)
    fresh = replay.specimen(part, [], CYCLES, still, DT)
    worn = replay.specimen(part, [StiffnessDegradation(share=0.5, energy=1.0)], CYCLES, still, DT)
    last = slice(3 * 1024, 4 * 1024 + 1)
    assert np.abs(worn[last]).max() == pytest.approx(np.abs(fresh[last]).max(), rel=0.01)
    assert replay.specimen(part, [], 0.5 * CYCLES, still, DT)[last] == pytest.approx(worn[last], abs=50.0)
    assert enclosed(worn[last], CYCLES[last]) < 0.9 * enclosed(fresh[last], CYCLES[last])


def test_a_storey_softens_at_large_drifts_and_regains_its_stiffness() -> None:
    x = np.array([1e-9, 5e-3, 1.0, 1e-9])
    lost = -stepped(Softening(share=0.4, drift=5e-3), np.zeros(4), x, 2e6 * x) / (2e6 * x)
    assert lost == pytest.approx([0.0, 0.2, 0.4, 0.0], abs=3e-3)


def test_a_cycle_of_a_storey_does_the_work_that_wears_it() -> None:
    """A cycle of amplitude X does the work 2 k X^2 in magnitude."""
    w = 2e6 * CYCLES
    lost = -stepped(StoreyDegradation(share=0.5, energy=4e3), np.zeros_like(w), CYCLES, w)
    peak = 1024 + 256
    expected = 0.5 * -np.expm1(-2 * 2e6 * 0.02**2 * 1.25 / 4e3)
    assert lost[peak] / w[peak] == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_no_sentence_has_a_number_of_more_than_four_digits(scale: float) -> None:
    """A wooden connection dissipates some joules: it does not lose 184 000 % for every MJ."""
    made: tuple[Effect, ...] = (
        ViscousHeating(fade=min(5.8e-7 * scale, 1.0)),
        StrengthDegradation(share=0.4, energy=3e3 * scale),
        PeakDegradation(rate=min(5.0 * scale, 1e6)),
    )
    for effect in made:
        said = physics.SEARCHES[type(effect)].says(effect)
        digits = [word for word in said.split() if word[0].isdigit()]
        assert digits and all(len(word.replace(".", "").lstrip("0")) <= 4 for word in digits), said
