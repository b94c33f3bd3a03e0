"""A structure beside the closed forms of one and two degrees of freedom."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.diagnosis.components import Structure, StructureData, based
from rths_engine.diagnosis.components.structure import FEW_MODES, FINE, ModeDamping, Release, Zero
from rths_engine.foundation.arrays import Array
from rths_engine.parts.physics.input.scale_error import GroundScaleError
from rths_engine.parts.physics.structure.damping_error import DampingError
from rths_engine.parts.physics.structure.stiffness_error import StiffnessError
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_plan
from tests.engine.plans import building

DT = 0.01
TIME = DT * np.arange(600)
MASS, STIFFNESS, RATIO = 1e4, 4e6, 0.03
OMEGA = np.sqrt(STIFFNESS / MASS)


def plan(masses: list[float] | None = None, stiffnesses: list[float] | None = None, ratio: float = RATIO) -> Plan:
    return read_plan(
        {
            "test": "structure",
            "structure": building(masses or [MASS], stiffnesses or [STIFFNESS], ratio),
            "integrator": {"kind": "cr", "dt": DT, "substeps": 1},
            "controller_rate": 1 / DT,
            "duration": 6.0,
            "motion": {"kind": "inline", "dt": 1.0, "acceleration": [0.0] * 7},
        }
    )


def component(of: Plan, released: bool = False, read: tuple[int, ...] = ()) -> Structure:
    return Structure("structure", based(of, released, read), of)


def free(x0: float, time: Array = TIME) -> Array:
    """Free vibration from x0 at rest of the one-storey building."""
    decay, damped = RATIO * OMEGA, OMEGA * np.sqrt(1 - RATIO**2)
    found: Array = x0 * np.exp(-decay * time) * (np.cos(damped * time) + decay / damped * np.sin(damped * time))
    return found


def let_go(x0: float, kind: str = "x") -> StructureData:
    still = np.zeros(len(TIME))
    return StructureData(DT, 0.0, False, still, {}, ((kind, 1, free(x0)),), ((x0,), (0.0,)), 1)  # type: ignore[arg-type]


def shaken(ground: Array, *floors: Any) -> StructureData:
    return StructureData(DT, 0.0, False, ground, {}, floors, None, 1)


def test_a_building_let_go_vibrates_freely() -> None:
    """Steps of 2 ms at 20 rad/s: a period off by (w h)^2 / 12 = 1.3e-4, over 20 periods 1.7 % of a radian."""
    found = component(plan()).predicted((), let_go(0.02))[0]
    assert component(plan()).finer(let_go(0.02)) == round(DT / FINE)
    assert found == pytest.approx(free(0.02), abs=0.02 * 0.017)


@pytest.mark.parametrize(("kind", "order"), [("v", 1), ("a", 2)])
def test_velocity_and_absolute_acceleration_are_slopes_of_the_motion(kind: str, order: int) -> None:
    data = let_go(0.02, kind)
    expected = free(0.02)
    for _ in range(order):
        expected = np.gradient(expected, DT)
    found = component(plan()).predicted((), data)[0]
    inside = slice(5, -5)
    # central differences here in steps of 10 ms: (w h)^2 / 6 of each order; and the period's 1.7 %
    assert found[inside] == pytest.approx(expected[inside], abs=(0.017 + order * 0.007) * 0.02 * OMEGA**order)


def test_a_stiffer_storey_vibrates_faster() -> None:
    """By sqrt(1 + e), at constant c."""
    found = component(plan()).predicted((StiffnessError(storey=1, share=0.21),), let_go(0.02))[0]
    crossings = np.flatnonzero(np.diff(np.sign(found)) > 0)
    period = (TIME[crossings[-1]] - TIME[crossings[0]]) / (len(crossings) - 1)
    assert period == pytest.approx(2 * np.pi / (1.1 * OMEGA), rel=DT / 5)  # crossings told to a sample in some 6 s


def test_damping_off_by_a_share_decays_by_as_much_more() -> None:
    found = component(plan()).predicted((DampingError(share=0.5),), let_go(0.02))[0]
    peaks = [float(np.max(np.abs(found[a:b]))) for a, b in ((90, 130), (400, 440))]
    assert np.log(peaks[0] / peaks[1]) == pytest.approx(1.5 * RATIO * OMEGA * 3.1, rel=0.05)  # peaks told to a sample


def test_the_damping_of_each_mode_adds_up_to_that_of_the_structure() -> None:
    """Modal matrices of all modes of a proportionally damped building sum to C."""
    of = plan([1e4, 8e3, 5e3], [4e6, 3e6, 2e6])
    one = component(of)
    assert len(one.dampings) == FEW_MODES == 3
    damping = Model(of).built.damping
    assert sum(one.dampings) == pytest.approx(damping, abs=1e-9 * float(np.max(np.abs(damping))))


def test_what_may_be_off_a_little_is_each_storey_the_damping_and_where_it_was_let_go() -> None:
    of = plan([1e4, 8e3], [4e6, 3e6])
    kinds = [type(part) for part in based(of, released=False, read=[])]
    assert kinds == [StiffnessError, StiffnessError, DampingError, ModeDamping]
    more = based(of, released=True, read=[2])
    assert [type(part) for part in more[4:]] == [Release, Release, Zero]
    one = component(of)
    assert (one.spread(StiffnessError()), one.spread(DampingError()), one.spread(ModeDamping())) == (0.03, 0.2, 0.03)
    assert one.spread(Release()) is None


def test_a_release_moves_the_start_and_a_zero_the_reading() -> None:
    one = component(plan(), released=True, read=(1,))
    moved = one.predicted((Release(floor=1, displacement=0.01), Zero(floor=1, displacement=0.003)), let_go(0.02))[0]
    assert moved == pytest.approx(1.5 * one.predicted((), let_go(0.02))[0] + 0.003, abs=1e-9)  # of a linear building


def test_a_larger_ground_motion_is_answered_in_proportion() -> None:
    ground = np.sin(2 * np.pi * 1.5 * TIME)
    data = shaken(ground, ("x", 1, ground))
    one = component(plan())
    assert one.predicted((GroundScaleError(share=0.2),), data) == pytest.approx(1.2 * one.predicted((), data), rel=1e-9)
    assert one.place(GroundScaleError()) == "input" and one.place(StiffnessError(storey=1)) == "structure:1"


def test_the_answer_to_a_steady_ground_motion_is_the_resonance_curve() -> None:
    """|x| = a / |w0^2 - w^2 + 2 i zeta w0 w|, once the start has decayed to e^-3.6."""
    w = 2 * np.pi * 1.5
    data = shaken(np.sin(w * TIME), ("x", 1, TIME))
    found = component(plan()).predicted((), data)[0]
    expected = 1 / abs(OMEGA**2 - w**2 + 2j * RATIO * OMEGA * w)
    last = TIME > 4.6
    assert np.max(np.abs(found[last])) == pytest.approx(expected, rel=0.05)


def test_each_storey_and_the_ground_are_looked_at_with_their_own_sizes() -> None:
    of = plan([1e4, 8e3], [4e6, 3e6])
    ground = np.sin(2 * np.pi * 1.5 * TIME)
    one = component(of)
    data = shaken(ground, ("x", 1, ground), ("x", 2, ground))
    seen = one.seen(data)
    assert [each.storey for each in seen] == [1, 2]
    drifts = one.drifts(data)
    for each, moved, k in zip(seen, drifts, (4e6, 3e6), strict=True):
        assert each.x == pytest.approx(np.max(np.abs(moved)), rel=1e-12) and each.f == pytest.approx(k * each.x, rel=1e-9)
    hypotheses = list(one.hypotheses(data))
    assert {getattr(effect, "storey", None) for effect in hypotheses} == {1, 2, None}
    assert "low_pass" in {effect.id for effect in hypotheses}
    assert "low_pass" not in {effect.id for effect in one.hypotheses(let_go_of_two(of))}


def let_go_of_two(of: Plan) -> StructureData:
    still = np.zeros(len(TIME))
    return StructureData(DT, 0.0, False, still, {}, (("x", 1, free(0.01)),), ((0.01, 0.02), (0.0, 0.0)), 1)


def test_terms_of_an_unknown_law_are_pairs_of_forces_on_a_storey() -> None:
    """A constant force on the drift of the one storey, 1 % of the largest elastic force; its start decays."""
    ground = np.sin(2 * np.pi * 1.5 * TIME)
    data = shaken(ground, ("x", 1, ground))
    one = component(plan())
    term = next(each for each in one.features((), data) if each.formula == "1")
    largest = float(np.max(np.abs(one.drifts(data))))
    assert np.mean(term.response[0][300:]) == pytest.approx(-0.01 * largest, rel=0.02)
    assert term.words.startswith("storey 1: ")
