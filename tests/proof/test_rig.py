"""Rigs, loops and structures against closed forms and other solvers."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.proof.generator import structure as physics
from tests.proof.generator.draw import KINDS, specs
from tests.proof.generator.ground import Ground, passed, shaking
from tests.proof.generator.rig import closed, driven, rig
from tests.proof.generator.structure import Building, Element, Whole, response

STEP = 1 / 512
TIME = np.arange(2048) * STEP
RAMP = 0.05 * TIME
FIRST = {"order": 1.0, "time_constant": 0.02, "speed": 2.0}
BUILDING = Building(np.array([4e4, 3e4]), np.array([8e6, 6e6]), 0.02)


def test_a_first_order_actuator_lags_a_ramp_by_its_time_constant() -> None:
    """Commands that are held up to their tick lag by T / (1 - exp(-dt / T)) dt - dt, which is T - dt/2 for small dt."""
    x, _ = driven(rig(**FIRST), RAMP, STEP)
    decay = np.exp(-STEP / 0.02)
    assert RAMP[-1] - x[-1] == pytest.approx(0.05 * STEP * decay / (1 - decay), rel=1e-6)


def test_a_second_order_actuator_lags_a_ramp_by_damping_and_dead_time() -> None:
    x, _ = driven(rig(order=2, omega=90.0, zeta=0.8, dead_time=0.0071, speed=2.0), RAMP, STEP)
    assert RAMP[-1] - x[-1] == pytest.approx(0.05 * (2 * 0.8 / 90.0 + 0.0071), rel=1e-5)


@pytest.mark.parametrize(
    ("numbers", "behind"),
    [
        ({"delay": 0.006}, 0.05 * 0.006),
        ({"lag": 0.01, "lag_zeta": 0.7}, 0.05 * 2 * 0.7 * 0.01),
        ({"band": 1e-4}, 1e-4),
        ({"play": 1e-4}, 1e-4),
        ({"slope": 0.02, "memory": 1.0}, 0.05 * 0.02 * RAMP[-1]),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_an_effect_of_the_actuator_adds_its_lag_on_a_ramp(numbers: dict[str, float], behind: float) -> None:
    plain, _ = driven(rig(**FIRST), RAMP, STEP)
    changed, _ = driven(rig(**FIRST, **numbers), RAMP, STEP)
    assert plain[-1] - changed[-1] == pytest.approx(behind, rel=0.03)  # the delay of a growing amplitude still grows


def test_a_dashpot_in_the_rig_bears_its_speed() -> None:
    _, f = driven(rig(**FIRST, law=0, k=1e6, c=3e5), RAMP, STEP)
    x, _ = driven(rig(**FIRST), RAMP, STEP)
    assert f[-1] == pytest.approx(1e6 * x[-1] + 3e5 * 0.05, rel=1e-6)


def test_the_loop_is_an_oscillator_where_the_actuator_follows_at_once() -> None:
    """M x'' + c x' + K x = -M a with a linear dashpot as specimen, against an adaptive solver."""
    mass, stiffness, dashpot, long = np.array([[1e5]]), np.array([[6e6]]), 2e5, 1 / 1024
    motion = shaking(np.random.default_rng(1), 2.0, 8.0)
    ground = motion.sample(np.arange(8 * 1024) * long)
    effective = mass + long / 2 * np.array([[dashpot]]) + long**2 / 4 * stiffness
    none = np.zeros(2 * (len(ground) - 1))
    numbers = rig(order=1, time_constant=5e-5, speed=20.0, law=0, c=dashpot)
    found = closed(
        numbers,
        mass,
        np.zeros((1, 1)),
        stiffness,
        effective,
        np.ones(1),
        ground,
        none,
        none,
        2,
        long / 2,
        np.array([1.0, 0, 0]),
    )
    solved = solve_ivp(
        lambda t, s: [s[1], -60.0 * s[0] - 2.0 * s[1] - motion(t)[0]],
        (0, 8),
        [0, 0],
        t_eval=np.arange(8 * 1024) * long,
        rtol=1e-9,
    )
    error = found[1::2, 4] - solved.y[0][1:]
    assert np.std(error) < 0.01 * np.std(solved.y[0])  # the specimen's force is one step of 1 ms late


def test_a_shear_building_vibrates_freely_as_its_modes_do() -> None:
    mass, damping, stiffness = BUILDING.matrices()
    start = (np.array([0.01, 0.02]), np.zeros(2))
    time = np.arange(0, 3, 1 / 256)
    x, _ = response(BUILDING, Whole(), [], lambda t: np.zeros_like(t), time, start)
    inverse = np.linalg.inv(mass)
    solved = solve_ivp(
        lambda t, s: np.concatenate([s[2:], -inverse @ (damping @ s[2:] + stiffness @ s[:2])]),
        (0, 3),
        [0.01, 0.02, 0, 0],
        "DOP853",
        time,
        rtol=1e-11,
        atol=1e-14,
    )
    assert np.max(np.abs(x - solved.y[:2])) < 1e-8 * 0.02


def test_storeys_of_every_kind_take_their_force_and_none_without_strength() -> None:
    motion = shaking(np.random.default_rng(2), 2.0, 8.0)
    time = np.arange(0, 8, 1 / 128)
    plain, _ = response(BUILDING, Whole(), [], Ground(motion, {}), time)
    d = 0.01
    strong = {
        physics.FRICTION: (2e4, 1e-4),
        physics.QUADRATIC: (1e6,),
        physics.CUBIC: (1e9,),
        physics.YIELDING: (5e4, 0.2),
        physics.HYSTERESIS: (2e4, 0.002, 2.0, 0.6),
        physics.PINCHING: (0.3, d),
        physics.GAP: (d / 3, 1e6),
        physics.DROP: (0.3, 3.0),
        physics.MEMORY: (2e4, 0.1, 0.1),
        physics.HEALING: (0.3, 0.1, 1.0),
        physics.COGGING: (2e4, d),
        physics.PARAMETRIC: (0.2, 0.3),
        physics.ONE_SIDED: (1e8,),
        physics.SOFTENING: (0.3, d),
        physics.TURNED: (0.3, 2e3),
        physics.FLAG: (2e4, d / 10, 0.6),
    }
    for kind, numbers in strong.items():
        x, _ = response(BUILDING, Whole(), [Element(2, kind, numbers)], Ground(motion, {}), time)
        assert np.std(x - plain) > 1e-3 * np.std(plain), kind
    weak = [Element(1, kind, (0.0, *strong[kind][1:])) for kind in strong if kind not in (physics.YIELDING, physics.GAP)]
    x, _ = response(BUILDING, Whole(), weak, Ground(motion, {}), time)
    assert x == pytest.approx(plain, abs=1e-12)


def test_a_flexible_base_lengthens_the_period_of_one_storey() -> None:
    """T' = T sqrt(1 + phi k) (Veletsos and Meek 1974)."""
    one = Building(np.array([1e5]), np.array([1e5 * (2 * np.pi) ** 2]), 0.001)
    time = np.arange(0, 5, 1 / 512)
    x, _ = response(
        one, Whole(base=0.21 / one.stiffnesses[0]), [], lambda t: np.zeros_like(t), time, (np.array([0.01]), np.zeros(1))
    )
    crossings = time[1:][np.diff(np.sign(x[0])) != 0]
    assert 2 * np.mean(np.diff(crossings)) == pytest.approx(1.1, rel=2e-3)  # crossings to a sample of 2 ms


def test_a_low_pass_of_the_ground_takes_a_sine_by_its_transfer() -> None:
    from tests.proof.generator.motion import STEP as KNOT
    from tests.proof.generator.motion import Motion

    time = np.arange(0, 6 + KNOT / 2, KNOT)
    filtered = passed(Motion(np.sin(2 * np.pi * 2 * time)), 0.05).sample(time)
    late = filtered[time > 3]
    assert np.max(np.abs(late)) == pytest.approx(1 / np.hypot(1, 2 * np.pi * 2 * 0.05), rel=1e-4)


@pytest.mark.parametrize("kind", KINDS)
def test_a_case_of_every_kind_is_made_and_tells_its_strength(kind: str) -> None:
    spec = next(one for one in specs(40, 5, kind) if one.level not in ("clean", "outside", "two"))
    if kind == "specimen":
        return  # tests/proof/test_protocol.py writes and diagnoses one
    case = spec.case()
    assert case.truth.strength is not None and case.truth.strength > 0.3
    assert all(np.isfinite(values).all() for values in case.fitting.shown.values())
    assert len(case.truth.effects) == 1
