"""Physics of the left-out effects of a structure."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.part import validated
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.structure import (
    BaseFlexibility,
    BoucWenHysteresis,
    CoulombFriction,
    CubicStiffness,
    DampingError,
    GapContact,
    MassError,
    PDelta,
    Pinching,
    QuadraticDamping,
    StiffnessDrop,
    StiffnessError,
    Yielding,
)
from rths_engine.parts.structures.moment_frame import MomentFrame
from rths_engine.parts.structures.shear_building import ShearBuilding
from rths_engine.running.restoring import subtract_forces
from tests.engine.effects import building as built_of
from tests.engine.effects import enclosed, stepped
from tests.engine.plans import building, completed, make, shaking
from tests.engine.test_frame import paper_frame

DT = 1 / 1024
STIFFNESSES, MASSES = (4e7, 3e7, 2e7), (3e4, 2e4, 1e4)
CYCLE = 0.02 * np.sin(2 * np.pi * np.arange(3 * 1024 + 1) * DT)


def cycle(effect: Effect, stiffness: float = 0.0) -> float:
    """Work of the last cycle of a sine of 20 mm and 1 Hz against the effect on a storey of that elastic stiffness."""
    x = CYCLE
    return enclosed(stepped(effect, np.zeros_like(x), x, stiffness * x, DT)[-1025:], x[-1025:])


def resists(effect: Effect, x: float, stiffness: float = 0.0) -> float:
    return float(effect.step(*effect.build(DT), 0.0, x, 0.0, stiffness * x, 1.0, DT))


@pytest.mark.parametrize("storey", [1, 2, 3])
@pytest.mark.parametrize("share", [-0.5, 0.2])
def test_a_stiffness_error_is_a_building_of_another_storey(storey: int, share: float) -> None:
    other = tuple(k * (1 + share) if place == storey else k for place, k in enumerate(STIFFNESSES, start=1))
    found = StiffnessError(storey=storey, share=share).assembled(built_of(STIFFNESSES, MASSES))
    assert found.stiffness == pytest.approx(built_of(other, MASSES).stiffness, rel=1e-9)
    assert found.elastic == pytest.approx(found.stiffness)


@pytest.mark.parametrize("storey", [1, 3])
def test_a_mass_error_is_a_building_of_another_floor(storey: int) -> None:
    other = tuple(m * 1.3 if place == storey else m for place, m in enumerate(MASSES, start=1))
    found = MassError(storey=storey, share=0.3).assembled(built_of(STIFFNESSES, MASSES))
    assert found.mass == pytest.approx(built_of(STIFFNESSES, other).mass)


def test_a_damping_error_scales_every_modal_damping_ratio() -> None:
    built = built_of(STIFFNESSES, MASSES)
    _, modes = eigh(built.stiffness, built.mass)
    damped = DampingError(share=0.5).assembled(built)
    assert modes.T @ damped.damping @ modes == pytest.approx(1.5 * modes.T @ built.damping @ modes, abs=1e-9)


def test_a_storey_the_structure_does_not_have_is_refused() -> None:
    with pytest.raises(PlanError, match=r"storey = 4: the structure has 3 storeys"):
        StiffnessError(storey=4, share=0.1).assembled(built_of())
    with pytest.raises(PlanError, match=r"storey = 4: the structure has 3 storeys"):
        MassError(storey=4, share=0.1).assembled(built_of())


def test_p_delta_of_one_storey_takes_its_stability_coefficient_of_the_stiffness() -> None:
    found = PDelta(load=0.1).assembled(built_of((4e7,), (3e4,)))
    assert found.stiffness == pytest.approx(0.9 * 4e7)


def test_p_delta_at_a_share_of_the_buckling_load_takes_that_share_of_the_buckling_shape() -> None:
    built = built_of(STIFFNESSES, MASSES)
    drifts = np.eye(3) - np.eye(3, k=-1)
    geometric = drifts.T @ np.diag([6e4, 3e4, 1e4]) @ drifts  # masses above each storey

    def determinant(load: float) -> float:
        return float(np.linalg.det((built.stiffness - load * geometric) / 1e7))

    buckling = brentq(determinant, 0, 1.01 * 4e7 / 6e4)  # the lowest storey is the weakest: 4e7 / 6e4
    found = PDelta(load=0.3).assembled(built)
    assert found.stiffness == pytest.approx(built.stiffness - 0.3 * buckling * geometric, rel=1e-9)
    assert np.linalg.eigvalsh(PDelta(load=0.95).assembled(built).stiffness)[0] > 0


def test_a_flexible_base_lengthens_the_period_of_a_storey_by_what_its_flexibility_adds() -> None:
    flexibility = 1e-8
    found = BaseFlexibility(flexibility=flexibility).assembled(built_of((4e7,), (3e4,)))
    static = np.linalg.inv(found.stiffness)  # without mass, b follows
    omega = 1 / np.sqrt(3e4 * static[0, 0])
    assert omega == pytest.approx(np.sqrt(4e7 / 3e4 / (1 + flexibility * 4e7)), rel=1e-9)


def test_a_flexible_base_adds_its_flexibility_to_every_floor_and_its_stroke_to_no_damper() -> None:
    built = built_of(STIFFNESSES, MASSES)
    found = BaseFlexibility(flexibility=2e-8).assembled(built)
    flexible = np.linalg.inv(found.stiffness)
    assert flexible[:3, :3] == pytest.approx(np.linalg.inv(built.stiffness) + 2e-8, rel=1e-9)
    assert found.drifts @ np.array([1.0, 1.0, 1.0, 1.0]) == pytest.approx(0.0, abs=1e-15)  # base and floors move as one
    assert found.mass[3].tolist() == [0.0] * 4


def test_a_storey_on_a_flexible_base_shakes_as_the_softer_storey_in_a_run() -> None:
    time = 0.01 * np.arange(200)
    motion, base = shaking(2 * np.sin(12 * time), 0.01), BaseFlexibility(flexibility=1e-8)
    built = base.assembled(ShearBuilding.model_validate(building([3e4], [4e7])).assemble())
    matrices = {"mass": built.mass.tolist(), "stiffness": built.stiffness.tolist(), "damping": built.damping.tolist()}
    swaying = {"kind": "matrices", **matrices, "floors": [1], "influence": built.influence.tolist()}
    found, softer = (
        completed(make(structure, motion, 0.005, duration=1.5)).signals[:, 1]
        for structure in (swaying, building([3e4], [4e7 / (1 + 1e-8 * 4e7)]))
    )
    assert np.abs(softer).max() > 1e-4
    assert np.abs(found - softer).max() < 1e-9 * np.abs(softer).max()


def test_effects_of_the_lowest_storey_are_of_its_drift_from_the_flexible_base() -> None:
    base = BaseFlexibility(flexibility=2e-8)
    for effect in (StiffnessError(storey=1, share=0.2), StiffnessError(storey=2, share=0.2)):
        built = built_of(STIFFNESSES, MASSES)
        below, above = base.assembled(effect.assembled(built)), effect.assembled(base.assembled(built))
        assert above.stiffness == pytest.approx(below.stiffness, rel=1e-9, abs=1e-3)  # of 2e7 N/m


def test_the_inelastic_columns_of_a_frame_stand_on_the_flexible_base() -> None:
    frame = validated(MomentFrame, paper_frame()).assemble()
    built = BaseFlexibility(flexibility=1e-9).assembled(frame)
    assert len(built.members.dofs) > 0
    x = 1e-9 * np.random.default_rng(2).normal(size=len(built.mass))  # far below yield
    force = -built.elastic @ x
    subtract_forces(built.members, x, np.zeros((len(built.members.dofs), 3)), force)
    exact = -built.stiffness @ x
    assert np.abs(force - exact).max() < 1e-9 * np.abs(exact).max()


def test_quadratic_damping_dissipates_eight_thirds_of_omega_squared_and_amplitude_cubed() -> None:
    closed = 8 / 3 * 2e5 * (2 * np.pi) ** 2 * 0.02**3
    assert cycle(QuadraticDamping(coefficient=2e5)) == pytest.approx(closed, rel=1e-4)  # trapezoidal rule


def test_friction_of_a_storey_dissipates_four_times_force_and_amplitude_beyond_presliding() -> None:
    closed = 4 * 1e5 * (0.02 - 1e-3)
    assert cycle(CoulombFriction(friction=1e5, presliding=1e-3)) == pytest.approx(closed, rel=1e-3)  # corners between substeps


@pytest.mark.parametrize("ratio", [0.0, 0.1, 1.0])
def test_a_yielding_storey_dissipates_the_parallelogram_of_bilinear_hysteresis(ratio: float) -> None:
    stiffness, strength = 4e7, 2e5
    closed = 4 * (1 - ratio) * strength * (0.02 - strength / stiffness)
    energy = cycle(Yielding(yield_force=strength, post_yield_ratio=ratio), stiffness)
    assert energy == pytest.approx(closed, rel=1e-3, abs=1e-6)


def test_a_yielding_storey_loaded_once_follows_the_bilinear_curve() -> None:
    x = np.linspace(0, 0.02, 50)
    found = 4e7 * x + stepped(Yielding(yield_force=2e5, post_yield_ratio=0.1), np.zeros(50), x, 4e7 * x, DT)
    assert found == pytest.approx(np.where(x < 5e-3, 4e7 * x, 2e5 + 4e6 * (x - 5e-3)), abs=1e-6)


def test_a_sharp_hysteresis_of_a_storey_dissipates_what_an_elastoplastic_spring_does() -> None:
    effect = BoucWenHysteresis(strength=1e5, yield_displacement=2e-3, exponent=20.0)
    assert cycle(effect) == pytest.approx(4 * 1e5 * (0.02 - 2e-3), rel=0.01)  # the corner is rounded by about 1 / n


def test_elastic_effects_of_a_storey_have_their_force_and_dissipate_nothing() -> None:
    cubic, pinched = CubicStiffness(stiffness=1e9), Pinching(depth=0.5, width=0.01)
    stop = GapContact(gap=0.01, stiffness=1e7)
    assert resists(cubic, 0.02) == pytest.approx(1e9 * 0.02**3)
    assert resists(pinched, 0.01, 4e7) == pytest.approx(-0.5 * 4e5 / np.e)
    assert (resists(stop, 0.015), resists(stop, 0.01), resists(stop, -0.015)) == pytest.approx((5e4, 0.0, -5e4))
    for effect in (cubic, pinched, stop):
        assert cycle(effect, 4e7) == pytest.approx(0.0, abs=1e-6)


def test_a_stop_on_one_side_is_not_felt_on_the_other() -> None:
    for side, sign in (("positive", 1), ("negative", -1)):
        stop = GapContact(gap=0.01, stiffness=1e7, side=side)
        assert resists(stop, sign * 0.015) == pytest.approx(sign * 5e4)
        assert resists(stop, -sign * 0.015) == 0.0


def test_a_storey_loses_a_share_of_its_elastic_force_from_a_moment_on() -> None:
    effect = StiffnessDrop(share=0.3, time=10.5 * DT)
    found = stepped(effect, np.zeros(20), np.full(20, 0.01), np.full(20, 4e5), DT)
    assert found == pytest.approx(-0.3 * 4e5 * np.clip(np.arange(20) - 10.5, 0, 1))
