"""Effects of a specimen that slides, sticks or strikes, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.parts.physics.specimen import (
    AsymmetricViscosity,
    CoulombFriction,
    GapContact,
    PendulumFriction,
    SelfCentring,
    StickSlip,
)
from rths_engine.parts.physics.structure import SelfCentring as StoreySelfCentring
from tests.engine.effects import enclosed, stepped

DT = 1 / 4096
TIME = DT * np.arange(2 * 4096 + 1)
CYCLES = 0.02 * np.sin(2 * np.pi * TIME)
NOTHING = np.zeros_like(TIME)
CYCLE = slice(4096, 2 * 4096 + 1)


def test_a_flag_returns_to_its_centre_and_encloses_two_parallelograms() -> None:
    """Each side: height beta F, width X - x_a, between parallel slopes."""
    flag = stepped(SelfCentring(strength=1e4, opening=2e-3, width=0.6), NOTHING, CYCLES)
    assert np.abs(flag[np.abs(CYCLES) < 1e-9]).max() < 10.0  # no force is left at the centre
    assert np.abs(flag).max() == pytest.approx(1e4)
    # a side opens along r up to 1 and closes at 1 - beta: beta F (X - x_a)
    assert enclosed(flag[CYCLE], CYCLES[CYCLE]) == pytest.approx(2 * 0.6 * 1e4 * (0.02 - 2e-3), rel=2e-3)


def test_a_flag_without_width_is_elastic() -> None:
    flag = stepped(SelfCentring(strength=1e4, opening=2e-3, width=0.0), NOTHING, CYCLES)
    assert flag == pytest.approx(1e4 * np.clip(CYCLES / 2e-3, -1, 1), abs=1e-6)


def test_a_storey_centres_itself_as_a_specimen_does() -> None:
    numbers = {"strength": 1e4, "opening": 2e-3, "width": 0.6}
    storey, specimen = (kind(**numbers) for kind in (StoreySelfCentring, SelfCentring))
    assert stepped(storey, NOTHING, CYCLES) == pytest.approx(stepped(specimen, NOTHING, CYCLES))


def test_a_pendulum_is_restored_by_its_weight_and_its_friction_grows_with_velocity() -> None:
    load, radius = 1e6, 2.0
    effect = PendulumFriction(stiffness=load / radius, friction=5e4, velocity=0.02, slow=0.5, presliding=1e-5)
    for velocity in (0.002, 0.1):
        x = velocity * np.arange(400) * DT + 0.01
        expected = load / radius * x[-1] + 5e4 * (1 - 0.5 * np.exp(-velocity / 0.02))
        assert stepped(effect, np.zeros(400), x, dt=DT)[-1] == pytest.approx(expected, rel=1e-6)


def test_a_stop_hardens_beyond_its_gap() -> None:
    x = np.array([0.0, 0.01, 0.012, -0.012, -0.03])
    found = stepped(GapContact(gap=0.01, stiffness=1e6, hardening=100.0), np.zeros(5), x)
    assert found == pytest.approx([0.0, 0.0, 2e3 * 1.2, -2e3 * 1.2, -2e4 * 3.0])
    one_sided = stepped(GapContact(gap=0.01, stiffness=1e6, side="negative"), np.zeros(5), x)
    assert one_sided == pytest.approx([0.0, 0.0, 0.0, -2e3, -2e4])


def test_asymmetric_viscosity_shifts_the_mean_force_and_dissipates_nothing() -> None:
    found = stepped(AsymmetricViscosity(damping=1e5), NOTHING, CYCLES, dt=DT)
    assert found[1:].mean() == pytest.approx(1e5 * 4 * 0.02, rel=1e-3)  # mean |v| = 4 X f
    assert abs(enclosed(found[CYCLE], CYCLES[CYCLE])) < 1.0


def test_a_reversal_sticks_with_its_force_and_slips_over_its_release() -> None:
    x = np.concatenate([np.linspace(0, 0.05, 5001), np.linspace(0.05, 0.0, 5001)[1:]])
    found = stepped(StickSlip(force=1e4, release=1e-3), np.zeros_like(x), x)
    assert found[4900:5000] == pytest.approx(0.0, abs=1.0)  # long after the last reversal
    after = -found[5001:]
    assert after.max() == pytest.approx(1e4, rel=1e-3)  # an adhesion of F_s, against the motion
    assert np.argmax(after) * 1e-5 == pytest.approx(1e-3 * np.log(10) / 9, abs=3e-5)
    assert after[1000] < 1e-3 * 1e4


def test_stick_slip_is_the_difference_of_two_coulomb_frictions() -> None:
    short, long = (stepped(CoulombFriction(friction=1e4, presliding=size), NOTHING, CYCLES) for size in (1e-4, 1e-3))
    assert stepped(StickSlip(force=1.3936e4, release=1e-3), NOTHING, CYCLES) == pytest.approx(short - long, rel=1e-4, abs=0.5)
